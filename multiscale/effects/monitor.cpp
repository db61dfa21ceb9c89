#include "multiscale/effects/monitor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/numerics/metric.hpp"
#include "core/output/fields.hpp"
#include "dem/model.hpp"
#include "fluid/vorticity.hpp"
#include "multiscale/roles.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {

namespace {

using closures::Vec3;

constexpr int samples_before_warning = 3;

/// The cell that contains a place, m, in a grid that owns its whole column; for a place outside the nearest cell,
/// beyond joined faces the image's.
std::size_t cell_at(const core::Grid& column, const std::array<double, 3>& place) {
  std::array<int, 3> cell{0, 0, 0};
  for (std::size_t a = 0; a < std::size_t(column.dimensions); ++a) {
    const int n = column.cells[a];
    cell[a] = int(std::floor(place[a] / column.spacing[a]));
    if (column.periodic[a]) cell[a] += cell[a] < 0 ? n : cell[a] >= n ? -n : 0;
    cell[a] = std::clamp(cell[a], 0, n - 1);
  }
  for (int axis = 0; axis < column.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    while (column.graded(axis) && cell[a] > 0 && column.low(axis, cell[a]) > place[a]) --cell[a];
  }
  return std::size_t(column.index(cell[0], cell[1], cell[2]));
}

}  // namespace

bool in_sample(std::int64_t number, int sample) {
  auto z = std::uint64_t(number) + 0x9e3779b97f4a7c15ULL;  // SplitMix64 (Steele, Lea and Flood 2014)
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return (z ^ (z >> 31)) % std::uint64_t(sample) == 0;
}

std::unique_ptr<Monitor> Monitor::of(const core::Scene& scene, const std::string& model) {
  const core::MonitorMode wish = scene.chooser.monitor;
  if (wish == core::MonitorMode::off || wish == core::MonitorMode::automatic || !scene.fluid.present()) return nullptr;
  if (scene.column.shear_rate != 0) return nullptr;  // there are no cells of a fluid
  return std::make_unique<Monitor>(scene, model);
}

Monitor::Monitor(const core::Scene& scene, const std::string& model)
    : scene_(scene),
      seen_(scene, model),
      latest_(seen_),
      empty_(seen_),
      samples_above_(seen_.observed().size(), 0),
      since_(seen_.observed().size(), 0.0),
      model_(model) {}

std::vector<std::string> Monitor::look(const dem::Model& model) {
  latest_ = empty_;
  const dem::Particles& particles = model.particles();
  const auto& load = model.coupling()->motion().load;
  const auto [column, vorticity] = model.coupling()->vorticity();
  for (std::size_t i = 0; i < particles.owned; ++i) {
    if (!in_sample(particles.id[i], scene_.chooser.monitor_sample)) continue;
    const auto& u = load[i].velocity;
    const dem::Motion& m = particles.motion[i];
    const std::size_t cell = cell_at(column, particles.place[i].x);
    const Encounter met{std::size_t(particles.species[i]),
                        Vec3{u[0] - m.v[0], u[1] - m.v[1], u[2] - m.v[2]},
                        Vec3{vorticity[0][cell], vorticity[1][cell], vorticity[2][cell]},
                        Vec3{m.w[0], m.w[1], m.w[2]},
                        particles.place[i].x,
                        model.time()};
    latest_.see(met);
    seen_.see(met);
  }
  return judge(model.ranks(), model.time());
}

std::vector<std::string> Monitor::look(const tfm::Model& model) {
  latest_ = empty_;
  const tfm::Fields& fields = model.fields();
  const core::Grid& grid = model.constants().grid;
  std::array<core::Field, 3> vorticity;
  fluid::find_vorticity(grid, fields.fluid.velocity, vorticity);
  const auto component = [&](const core::FaceField& u, std::size_t a, std::size_t c) {
    if (a >= std::size_t(grid.dimensions)) return 0.0;
    return 0.5 * (u[a][c] + u[a][c + std::size_t(grid.stride(int(a)))]);
  };
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const std::int64_t row = grid.before[1] + j + std::int64_t(grid.column_cells(1)) * (grid.before[2] + k);
        if (!in_sample(grid.before[0] + i + grid.column_cells(0) * row, scene_.chooser.monitor_sample)) continue;
        const auto c = std::size_t(grid.index(i, j, k));
        for (std::size_t s = 0; s < scene_.species.size(); ++s) {
          if (!(fields.solids.fraction[s][c] > least_fraction_met)) continue;
          std::array<double, 3> slip{};
          for (std::size_t a = 0; a < 3; ++a)
            slip[a] = component(fields.fluid.velocity, a, c) - component(fields.solids.velocity[s], a, c);
          const Encounter met{s,
                              Vec3{slip[0], slip[1], slip[2]},
                              Vec3{vorticity[0][c], vorticity[1][c], vorticity[2][c]},
                              {},
                              {grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)},
                              model.time(),
                              grid.metric ? std::uint64_t(std::llround(1000 * grid.metric->volume[c])) : 1};
          latest_.see(met);
          seen_.see(met);
        }
      }
  return judge(grid.ranks.get(), model.time());
}

std::vector<std::string> Monitor::judge(const core::Ranks* ranks, double time) {
  latest_.gather(ranks);
  std::vector<std::string> lines;
  for (std::size_t n = 0; n < latest_.observed().size(); ++n) {
    const Observed& o = latest_.observed()[n];
    if (o.above == 0) continue;
    if (samples_above_[n] == 0) since_[n] = time;
    if (++samples_above_[n] != samples_before_warning) continue;
    lines.push_back(fmt::format(
        "{} neglected (bound {}) reaches {} for {} of the particles near x = {:.3g} m, y "
        "= {:.3g} m since "
        "t = {:.4g} s",
        o.of_all ? "the sum of all forces" : o.effect, relevance::percent(o.bound), relevance::percent(o.greatest),
        relevance::percent(double(o.above) / double(o.count)), o.place[0], o.place[1], since_[n]));
    find_setting(o);
  }
  warnings_.insert(warnings_.end(), lines.begin(), lines.end());
  stopped_ = !lines.empty() && scene_.chooser.monitor == core::MonitorMode::stop;
  if (stopped_) throw core::NumericsError(lines.front() + "; chooser.monitor = \"stop\"");
  return lines;
}

core::Json Monitor::past(const core::Ranks* ranks) const {
  return {{"steps", steps_},   {"warnings", warnings_},   {"settings", settings_},
          {"since_s", since_}, {"above", samples_above_}, {"seen", result(ranks).past()}};
}

void Monitor::recall(const core::Json& past, const core::Ranks* ranks) {
  const auto texts = [&](const char* name) {
    std::vector<std::string> found;
    for (const core::Json& text : core::array_of(core::member_of(past, name))) found.push_back(core::text_of(text));
    return found;
  };
  steps_ = std::int64_t(core::count_of(core::member_of(past, "steps")));
  warnings_ = texts("warnings");
  Neglected seen = seen_;
  if (!seen.recall(core::member_of(past, "seen"))) return;
  if (core::is_first(ranks)) seen_ = seen;
  settings_ = texts("settings");
  const auto& above = core::array_of(core::member_of(past, "above"));
  const auto& since = core::array_of(core::member_of(past, "since_s"));
  // A monitor that stops runs does so again at the next sample beyond the limit.
  const bool stops = scene_.chooser.monitor == core::MonitorMode::stop;
  const int most = stops ? samples_before_warning - 1 : std::numeric_limits<int>::max();
  for (std::size_t n = 0; n < std::min({above.size(), since.size(), since_.size()}); ++n) {
    samples_above_[n] = int(std::min<std::uint64_t>(core::count_of(above[n]), std::uint64_t(most)));
    since_[n] = core::number_of(since[n]);
  }
}

void Monitor::find_setting(const Observed& exceeded) {
  const relevance::MenuEntry* most = nullptr;
  double greatest = 0;
  for (const Observed& o : latest_.observed()) {
    const relevance::MenuEntry* entry = find_entry(o.effect);
    if (entry == nullptr || !can_be_added(*entry, model_) || (!exceeded.of_all && exceeded.effect != o.effect))
      continue;
    if (most == nullptr || o.greatest > greatest) most = entry, greatest = o.greatest;
  }
  if (most == nullptr) return;
  const std::string setting = fmt::format("effects.{}={}", most->effect->role, most->effect->laws.front().name);
  if (std::find(settings_.begin(), settings_.end(), setting) == settings_.end()) settings_.push_back(setting);
}

Neglected Monitor::result(const core::Ranks* ranks) const {
  Neglected all = seen_;
  all.gather(ranks);
  return all;
}

}  // namespace polybed::multiscale
