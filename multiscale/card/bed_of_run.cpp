#include "multiscale/card/bed_of_run.hpp"

#include <algorithm>
#include <cmath>

#include "closures/sphere.hpp"
#include "closures/terminal_velocity.hpp"
#include "fluid/exits.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using measures::TimeMean;
using Series = std::vector<double>;

/// The rows of a run for the means.
struct Window {
  const core::History& history;
  const Series& time;
  measures::Rows rows;

  [[nodiscard]] std::optional<TimeMean> mean(const Series& all) const {
    return all.empty() ? std::nullopt : measures::time_mean(rows.of(all));
  }
  [[nodiscard]] std::optional<TimeMean> mean(const std::string& name) const {
    const Series* all = history.find(name);
    return all == nullptr ? std::nullopt : mean(*all);
  }
};

double last(const Series& series) { return series.back(); }

double particles_of(const core::Species& species, double mass) {
  return mass / (species.density * closures::sphere_volume(species.diameter / 2));
}

/// Inventory of all solids: mass in the column and particles at the first row, mass at the last, mean height at the
/// end.
struct Inventory {
  double first = 0, particles = 0, last = 0, height = 0;
};

Inventory inventory_of(const core::Scene& scene, const Window& window) {
  Inventory all;
  double moment = 0;
  for (const core::Species& species : scene.species) {
    const std::optional<TimeMean> centre = window.mean("centre_" + species.name + "_m");
    const Series* mass = window.history.find("mass_" + species.name + "_kg");
    if (mass == nullptr) continue;
    all.first += mass->front();
    all.particles += particles_of(species, mass->front());
    all.last += last(*mass);
    moment += last(*mass) * centre.value_or(TimeMean{}).mean;
  }
  all.height = all.last > 0 ? moment / all.last : 0;
  return all;
}

/// Whether the solids are lighter than the fluid.
bool is_light(const Window& window) {
  const Series* weight = window.history.find("buoyant_weight_Pa");
  return weight != nullptr && last(*weight) < 0;
}

Fluidisation state_of(const core::Scene& scene, const Window& window, const Inventory& all, const BedOfRun& bed) {
  using enum Fluidisation;
  if (!scene.fluid.present() || scene.column.closed || scene.bed.start.kind == core::StartKind::list) return unknown;
  if (all.last < 0.01 * all.first) return carried_out;
  if (!bed.hangs && all.height > 0.75 * scene.column.size[1]) return carried(scene);
  if (is_light(window) && !bed.hangs) return packed;  // a stream presses it onto the bottom
  if (bed.drop) return bed.drop->mean >= 0.95 ? fluidised : packed;
  return unknown;
}

/// Whether a downward stream presses solids lighter than the fluid onto the bottom: its drag exceeds their buoyancy.
bool is_pressed_down(const core::Scene& scene, const Inventory& all, const BedOfRun& bed) {
  constexpr double more = 1.05;
  return bed.drop && bed.drop->mean > more && all.height < 0.5 * scene.column.size[1];
}

/// Whether a species would be below another one if each found its place by weight. Of several sizes the middle counts.
bool belongs_below(const core::Scene& scene, const measures::Kind& one, const measures::Kind& other) {
  const core::Species &a = scene.species[one.members[one.members.size() / 2]],
                      &b = scene.species[other.members[other.members.size() / 2]];
  return a.density != b.density ? a.density > b.density : a.diameter > b.diameter;
}

/// Nearly all of a species: what remains of it says nothing about the bed.
bool has_left(const BedOfRun& bed, const std::string& species) {
  constexpr double most = 0.95;
  const auto left = bed.recovery.find(species);
  return left != bed.recovery.end() && left->second > most;
}

Layers layers_of(const core::Scene& scene, const std::vector<measures::Kind>& kinds, const Window& window,
                 const BedOfRun& bed) {
  if (!bed.height || !(bed.height->mean > 0)) return Layers::unknown;
  const measures::Kind *lowest = nullptr, *highest = nullptr;
  double low = 0, high = 0;
  for (const measures::Kind& kind : kinds) {
    const std::optional<TimeMean> mean = window.mean("centre_" + kind.name + "_m");
    if (kind.is_class || !mean || has_left(bed, kind.name)) continue;
    const double centre = mean->mean;
    if (lowest == nullptr || centre < low) low = centre, lowest = &kind;
    if (highest == nullptr || centre > high) high = centre, highest = &kind;
  }
  if (lowest == highest) return Layers::unknown;
  if (high - low < 0.1 * bed.height->mean) return Layers::mixed;
  return belongs_below(scene, *lowest, *highest) ? Layers::layered : Layers::inverted;
}

/// Computes the outflow, also as a share of the possible outflow.
void find_outflow(const std::vector<measures::Kind>& kinds, const Window& window, BedOfRun& bed) {
  for (const measures::Kind& kind : kinds) {
    const Series *out = window.history.find("out_" + kind.name + "_kg"),
                 *fed = window.history.find("in_" + kind.name + "_kg"),
                 *mass = window.history.find("mass_" + kind.name + "_kg");
    if (out == nullptr || mass == nullptr) continue;
    const double supplied = mass->front() + (fed != nullptr ? last(*fed) : 0);
    bed.out[kind.name] = last(*out);
    if (supplied > 0) bed.recovery[kind.name] = last(*out) / supplied;
  }
}

void find_exits(const core::Scene& scene, const std::vector<measures::Kind>& kinds, const Window& window,
                BedOfRun& bed) {
  for (const std::string& name : fluid::names_of_exits(scene)) {
    BedOfRun::Exit& exit = bed.exits.emplace_back(BedOfRun::Exit{name, window.mean(name + "_m3_s"), {}});
    for (const measures::Kind& kind : kinds)
      if (const Series* out = window.history.find(name + "_" + kind.name + "_kg")) exit.out[kind.name] = last(*out);
  }
  if (bed.exits.empty() && scene.discharges.size() == 1)  // all that leaves
    if (const std::optional<TimeMean> flow = window.mean("overflow_m3_s"))
      bed.exits.push_back({"discharge1", flow, bed.out});
}

void find_tops(const std::vector<measures::Kind>& kinds, const Window& window, BedOfRun& bed) {
  for (const measures::Kind& kind : kinds) {
    if (kind.is_class || has_left(bed, kind.name)) continue;
    if (const std::optional<TimeMean> top = window.mean("top_" + kind.name + "_m"))
      bed.tops.emplace_back(kind.name, *top);
  }
}

/// A few particles do not define a rate, and flow before the opening was blocked is not a hopper's discharge.
void find_discharge(const core::Scene& scene, const Window& window, const Inventory& all, BedOfRun& bed) {
  constexpr double least_particles = 10, most_left = 0.5;
  if (!scene.dem.opening) return;
  Series out(window.time.size(), 0);
  double number = 0;
  for (const core::Species& species : scene.species)
    if (const Series* one = window.history.find("out_" + species.name + "_kg")) {
      for (std::size_t n = 0; n < out.size(); ++n) out[n] += (*one)[n];
      number += particles_of(species, one->back());
    }
  // A slot lets some grains through in the time in which they fall by its width.
  const auto last = std::size_t(std::lower_bound(out.begin(), out.end(), out.back()) - out.begin());
  const double falls = 5 * std::sqrt(*scene.dem.opening / std::max(scene.column.gravity, 1e-3));
  const bool long_enough = window.time.back() - window.time[last] > falls;
  bed.blocked =
      long_enough && window.rows.begin > 0 && out[window.rows.begin] == out.back() && all.last > most_left * all.first;
  if (bed.blocked || number < least_particles) return;
  const auto reached = [&](double share) {
    return std::size_t(std::lower_bound(out.begin(), out.end(), share * out.back()) - out.begin());
  };
  const std::size_t from = reached(0.1), to = reached(0.9);
  if (to > from) bed.discharge = (out[to] - out[from]) / (window.time[to] - window.time[from]);
}

/// Time, s, in which particles of a species settle alone through a height: 0 without a fluid, or if they do not settle.
double settling_time(const core::Scene& scene, const core::Species& species, double height) {
  if (!scene.fluid.present()) return 0;
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const double excess = std::abs(species.density - fluid.density);
  if (!(excess > 0 && scene.column.gravity > 0)) return 0;
  return height / closures::settling_velocity(species.diameter, excess, fluid.density, fluid.viscosity,
                                              scene.column.gravity, relevance::shape_of(scene, species));
}

/// A bed in a very viscous fluid creeps for longer than most runs last: its drift is compared with its settling.
void judge_drift(const core::Scene& scene, const Window& window, BedOfRun& bed) {
  std::vector<measures::HeightSeries> heights;
  const auto add = [&](const std::string& name, double settling) {
    if (const Series* all = window.history.find(name + "_m")) heights.push_back({name, *all, settling});
  };
  const Series* top = window.history.find("bed_height_m");
  std::vector<double> settling;
  for (const core::Species& species : scene.species)
    settling.push_back(top == nullptr ? 0 : settling_time(scene, species, last(*top)));
  add("bed_height", settling.empty() ? 0 : *std::min_element(settling.begin(), settling.end()));
  for (std::size_t j = 0; j < settling.size(); ++j)
    if (const std::string& name = scene.species[j].name; !has_left(bed, name)) add("centre_" + name, settling[j]);
  bed.drifts = measures::drifts_of(window.time, heights, scene.column.size[1] / scene.column.cells[1]);
  for (const measures::DriftOfMeasure& drift : bed.drifts) bed.steady = bed.steady.value_or(true) && drift.steady;
}

/// A box with joined ends: nothing is read along its height.
BedOfRun::Joined joined_of(const std::vector<measures::Kind>& kinds, const Window& window) {
  BedOfRun::Joined joined;
  for (const measures::Kind& kind : kinds)
    if (const std::optional<TimeMean> slip = window.mean("slip_" + kind.name + "_m_s"))
      joined.slips.emplace_back(kind.name, *slip);
  joined.superficial_slip = window.mean("superficial_slip_m_s");
  if (const Series* gradient = window.history.find("pressure_gradient_Pa_m")) joined.gradient = last(*gradient);
  if (const Series* velocity = window.history.find("mass_velocity_m_s")) joined.mass_velocity = last(*velocity);
  return joined;
}

}  // namespace

std::string name_of(Layers layers) {
  const char* names[] = {"", "mixed", "layered", "inverted"};
  return names[std::size_t(layers)];
}

BedOfRun bed_of_run(const core::Scene& scene, const core::History& history) {
  BedOfRun bed;
  const Series* time = history.find("time_s");
  if (time == nullptr || time->empty()) return bed;
  const measures::Window quarter = measures::last_quarter(*time);
  bed.window = quarter.end - quarter.begin;
  const Window window{history, *time, quarter.rows(*time)};
  const Inventory all = inventory_of(scene, window);
  if (scene.flows_around()) {
    std::vector<std::string> names;
    for (const core::Species& species : scene.species) names.push_back(species.name);
    bed.joined = joined_of(measures::kinds_of(names), window);
    for (const measures::Kind& kind : measures::named_species(names))
      if (const Series* mass = history.find("mass_" + kind.name + "_kg"))
        bed.masses.emplace_back(kind.name, last(*mass));
    return bed;
  }
  constexpr double least_particles = 10;  // listed particles: fewer are not a bed
  if (scene.bed.start.kind == core::StartKind::list && all.particles < least_particles) return bed;
  bed.height = window.mean("bed_height_m");
  bed.dense = window.mean("dense_height_m");
  bed.pressure = window.mean("pressure_drop_Pa");
  bed.drop = window.mean(measures::drop_over_weight(history));
  std::vector<std::string> names;
  for (const core::Species& species : scene.species) names.push_back(species.name);
  const std::vector<measures::Kind> kinds = measures::kinds_of(names);
  if (const std::optional<TimeMean> mixing = window.mean("mixing")) bed.mixing = mixing->mean;
  bed.hangs = is_light(window) && !is_pressed_down(scene, all, bed);
  bed.state = state_of(scene, window, all, bed);
  find_outflow(kinds, window, bed);
  bed.layers = layers_of(scene, kinds, window, bed);
  bed.cell = scene.fluid.present() ? scene.column.size[1] / scene.column.cells[1] : 0;
  for (const measures::Kind& kind : measures::named_species(names))
    if (const Series* mass = history.find("mass_" + kind.name + "_kg")) bed.masses.emplace_back(kind.name, last(*mass));
  find_exits(scene, kinds, window, bed);
  if (!bed.hangs) find_tops(kinds, window, bed);
  if (bed.hangs) bed.height.reset(), bed.dense.reset();  // its top is the column's
  find_discharge(scene, window, all, bed);
  judge_drift(scene, window, bed);
  return bed;
}

}  // namespace polybed::multiscale
