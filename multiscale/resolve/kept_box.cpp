#include "multiscale/resolve/kept_box.hpp"

#include <fmt/format.h>

#include "core/output/checkpoint.hpp"

namespace polybed::multiscale {

namespace {

const std::string array = "populations";  // a part for each direction

core::Slab all_of(const lattice::Sites& sites) {
  const std::vector<std::size_t> box{std::size_t(sites.box[0]), std::size_t(sites.box[1]), std::size_t(sites.box[2])};
  return {box, {0, 0, 0}, box};
}

}  // namespace

template <class Real>
void KeptBox::write(const lattice::Flow<Real>& flow, const Stand& stand) const {
  core::Checkpoint checkpoint;
  checkpoint.texts["box"] = name;
  checkpoint.integers["steps"] = stand.progress.steps;
  checkpoint.numbers["drag"] = stand.progress.drag;
  checkpoint.numbers["mean_drag"] = stand.progress.mean_drag;
  checkpoint.numbers["change"] = stand.progress.change;
  checkpoint.numbers["seconds"] = stand.seconds;
  const lattice::Point& force = flow.last_force();
  checkpoint.arrays["force"] = {force.begin(), force.end()};
  std::vector<core::BlockData> populations;  // one after the other: no memory for the flow twice
  for (std::size_t way = 0; way < lattice::directions; ++way)
    populations.push_back({fmt::format("{}/{}", array, way),
                           all_of(flow.sites()),
                           core::Packing::plain,
                           [&flow, way] { return flow.populations(way); },
                           {}});
  core::write_checkpoint(path, std::move(checkpoint), nullptr, std::move(populations));
}

template <class Real>
bool KeptBox::restore(lattice::Flow<Real>& flow, Stand& stand) const {
  if (!std::filesystem::exists(path)) return false;
  core::Checkpoint checkpoint = core::read_checkpoint(path);
  const auto box = checkpoint.texts.find("box");
  if (box == checkpoint.texts.end() || box->second != name) return false;
  core::require_numbers(checkpoint);
  stand.progress = {checkpoint.count("steps"), checkpoint.number("drag"), checkpoint.number("mean_drag"),
                    checkpoint.number("change")};
  stand.seconds = checkpoint.time("seconds");
  const std::vector<double>& force = checkpoint.array("force");
  if (force.size() != 3) core::refuse_checkpoint("the force on its fluid is no vector");
  flow.restore_last_force({force[0], force[1], force[2]});
  for (std::size_t way = 0; way < lattice::directions; ++way) {
    core::read_parts(path, {{array, {{fmt::format("{}", way), all_of(flow.sites())}}}}, checkpoint);
    core::require_numbers(checkpoint);
    flow.restore_populations(way, checkpoint.array(array));
  }
  return true;
}

void KeptBox::remove() const {
  std::error_code none;  // a file that stays is of no harm
  std::filesystem::remove(path, none);
  std::filesystem::remove(core::previous_checkpoint(path), none);
}

template void KeptBox::write<float>(const lattice::Flow<float>&, const Stand&) const;
template void KeptBox::write<double>(const lattice::Flow<double>&, const Stand&) const;
template bool KeptBox::restore<float>(lattice::Flow<float>&, Stand&) const;
template bool KeptBox::restore<double>(lattice::Flow<double>&, Stand&) const;

}  // namespace polybed::multiscale
