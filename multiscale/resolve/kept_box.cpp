#include "multiscale/resolve/kept_box.hpp"

#include <fmt/format.h>

namespace polybed::multiscale {

namespace {

const std::string array = "populations";  // one part per direction

core::Slab all_of(const lattice::Sites& sites) {
  const std::vector<std::size_t> box{std::size_t(sites.box[0]), std::size_t(sites.box[1]), std::size_t(sites.box[2])};
  return {box, {0, 0, 0}, box};
}

}  // namespace

template <class Real>
void KeptBox::write(const lattice::Flow<Real>& flow, core::Checkpoint state) const {
  state.texts["box"] = name;
  const lattice::Point& force = flow.last_force();
  state.arrays["force"] = {force.begin(), force.end()};
  std::vector<core::BlockData> populations;  // one after the other: memory may not suffice for the flow twice
  for (std::size_t way = 0; way < lattice::directions; ++way)
    populations.push_back({fmt::format("{}/{}", array, way),
                           all_of(flow.sites()),
                           core::Packing::plain,
                           [&flow, way] { return flow.populations(way); },
                           {}});
  core::write_checkpoint(path, std::move(state), nullptr, std::move(populations));
}

std::optional<core::Checkpoint> KeptBox::read() const {
  if (!std::filesystem::exists(path)) return {};
  core::Checkpoint state = core::read_checkpoint(path);
  const auto box = state.texts.find("box");
  if (box == state.texts.end() || box->second != name) return {};
  core::name_checkpoint(path, [&] { core::require_numbers(state); });
  return state;
}

template <class Real>
void KeptBox::restore(lattice::Flow<Real>& flow, core::Checkpoint state) const {
  const std::vector<double>& force = state.array("force");
  if (force.size() != 3) core::refuse_checkpoint("the force on its fluid is no vector");
  flow.restore_last_force({force[0], force[1], force[2]});
  for (std::size_t way = 0; way < lattice::directions; ++way) {
    core::read_parts(path, {{array, {{fmt::format("{}", way), all_of(flow.sites())}}}}, state);
    core::require_numbers(state);
    flow.restore_populations(way, state.array(array));
  }
}

void KeptBox::remove() const {
  std::error_code none;  // a file that stays does no harm
  std::filesystem::remove(path, none);
  std::filesystem::remove(core::previous_checkpoint(path), none);
}

void keep_impulses(const std::vector<lattice::Impulse>& impulses, core::Checkpoint& state) {
  std::vector<double>& kept = state.arrays["impulses"];
  for (const lattice::Impulse& impulse : impulses) {
    kept.insert(kept.end(), impulse.force.begin(), impulse.force.end());
    kept.insert(kept.end(), impulse.torque.begin(), impulse.torque.end());
  }
}

std::vector<lattice::Impulse> kept_impulses(const core::Checkpoint& state) {
  const std::vector<double>& kept = state.array("impulses");
  std::vector<lattice::Impulse> impulses(kept.size() / 6);
  for (std::size_t n = 0; n < 6 * impulses.size(); ++n)
    (n % 6 < 3 ? impulses[n / 6].force[n % 3] : impulses[n / 6].torque[n % 3]) = kept[n];
  return impulses;
}

template void KeptBox::write<float>(const lattice::Flow<float>&, core::Checkpoint) const;
template void KeptBox::write<double>(const lattice::Flow<double>&, core::Checkpoint) const;
template void KeptBox::restore<float>(lattice::Flow<float>&, core::Checkpoint) const;
template void KeptBox::restore<double>(lattice::Flow<double>&, core::Checkpoint) const;

}  // namespace polybed::multiscale
