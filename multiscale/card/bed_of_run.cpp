#include "multiscale/card/bed_of_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "closures/sphere.hpp"

namespace polybed::multiscale {

namespace {

constexpr double judged_share = 0.25;  // of the time covered, as measures::Drifts has it

using Series = std::vector<double>;

/// A column, or null.
const Series* column(const core::History& history, const std::string& name) {
  const auto found = std::find(history.columns.begin(), history.columns.end(), name);
  return found == history.columns.end() ? nullptr : &history.values[std::size_t(found - history.columns.begin())];
}

/// The rows of a run from which means are taken.
struct Window {
  const core::History& history;
  const Series& time;
  std::ptrdiff_t first;

  [[nodiscard]] Series of(const Series& all) const { return {all.begin() + first, all.end()}; }
  [[nodiscard]] std::optional<Mean> mean(const std::string& name) const {
    const Series* all = column(history, name);
    return all == nullptr ? std::nullopt : mean_of_parts(of(time), of(*all));
  }
};

double last(const Series& series) { return series.back(); }

std::optional<Mean> drop_over_weight(const Window& window) {
  const Series *drop = column(window.history, "pressure_drop_Pa"),
               *weight = column(window.history, "buoyant_weight_Pa");
  if (drop == nullptr || weight == nullptr) return {};
  Series ratio = window.of(*drop);
  const Series weights = window.of(*weight);
  for (std::size_t n = 0; n < ratio.size(); ++n) {
    if (weights[n] == 0) return {};  // an empty column, or solids as dense as the fluid
    ratio[n] /= weights[n];
  }
  return mean_of_parts(window.of(window.time), ratio);
}

/// Mass in the column at the first row and at the last, and the mean height of all solids at the end.
struct Inventory {
  double first = 0, last = 0, centre = 0;
};

Inventory inventory_of(const core::Scene& scene, const Window& window) {
  Inventory all;
  double moment = 0;
  for (const core::Species& species : scene.species) {
    const Series* mass = column(window.history, "mass_" + species.name + "_kg");
    if (mass == nullptr) continue;
    all.first += mass->front();
    all.last += last(*mass);
    moment += last(*mass) * window.mean("centre_" + species.name + "_m").value_or(Mean{}).value;
  }
  all.centre = all.last > 0 ? moment / all.last : 0;
  return all;
}

/// How many particles there were at the first row.
double particles_in(const core::Scene& scene, const Window& window) {
  double count = 0;
  for (const core::Species& species : scene.species)
    if (const Series* mass = column(window.history, "mass_" + species.name + "_kg"))
      count += mass->front() / (species.density * closures::sphere_volume(species.diameter / 2));
  return count;
}

/// Whether the solids are lighter than the fluid.
bool is_light(const Window& window) {
  const Series* weight = column(window.history, "buoyant_weight_Pa");
  return weight != nullptr && last(*weight) < 0;
}

Fluidisation state_of(const core::Scene& scene, const Window& window, const BedOfRun& bed) {
  using enum Fluidisation;
  if (!scene.fluid.present() || scene.column.closed || scene.bed.start.kind == core::StartKind::list) return unknown;
  const Inventory all = inventory_of(scene, window);
  if (all.last < 0.01 * all.first) return carried_out;
  if (!bed.hangs && all.centre > 0.75 * scene.column.size[1]) return carried(scene);
  if (is_light(window) && !bed.hangs) return packed;  // a stream presses it onto the bottom
  if (bed.drop) return bed.drop->value >= 0.95 ? fluidised : packed;
  return unknown;
}

/// Whether a downward stream presses solids lighter than the fluid onto the bottom: its drag exceeds their buoyancy.
bool is_pressed_down(const core::Scene& scene, const Window& window, const BedOfRun& bed) {
  constexpr double more = 1.05;
  return bed.drop && bed.drop->value > more && inventory_of(scene, window).centre < 0.5 * scene.column.size[1];
}

/// Whether a species belongs below another one where each finds its place by weight.
bool belongs_below(const core::Species& one, const core::Species& other) {
  return one.density != other.density ? one.density > other.density : one.diameter > other.diameter;
}

std::string layers_of(const core::Scene& scene, const Window& window, const BedOfRun& bed) {
  if (!bed.height || !(bed.height->value > 0)) return "";
  const core::Species *lowest = nullptr, *highest = nullptr;
  double low = 0, high = 0;
  for (const core::Species& species : scene.species) {
    const std::optional<Mean> centre = window.mean("centre_" + species.name + "_m");
    if (!centre) continue;
    if (lowest == nullptr || centre->value < low) low = centre->value, lowest = &species;
    if (highest == nullptr || centre->value > high) high = centre->value, highest = &species;
  }
  if (lowest == highest) return "";
  if (high - low < 0.1 * bed.height->value) return "mixed";
  return belongs_below(*lowest, *highest) ? "layered" : "inverted";
}

/// What has left, and as a share of what could have.
void find_outflow(const core::Scene& scene, const Window& window, BedOfRun& bed) {
  for (const core::Species& species : scene.species) {
    const Series *out = column(window.history, "out_" + species.name + "_kg"),
                 *fed = column(window.history, "in_" + species.name + "_kg"),
                 *mass = column(window.history, "mass_" + species.name + "_kg");
    if (out == nullptr || mass == nullptr) continue;
    const double supplied = mass->front() + (fed != nullptr ? last(*fed) : 0);
    bed.out[species.name] = last(*out);
    if (supplied > 0) bed.recovery[species.name] = last(*out) / supplied;
  }
}

/// A few particles make no rate, and what ran before the opening was blocked is not one of the hopper.
void find_discharge(const core::Scene& scene, const Window& window, BedOfRun& bed) {
  constexpr double least_particles = 10, most_left = 0.5;
  if (!scene.dem.opening) return;
  Series out(window.time.size(), 0);
  double number = 0;
  for (const core::Species& species : scene.species)
    if (const Series* one = column(window.history, "out_" + species.name + "_kg")) {
      for (std::size_t n = 0; n < out.size(); ++n) out[n] += (*one)[n];
      number += one->back() / (species.density * closures::sphere_volume(species.diameter / 2));
    }
  const Inventory all = inventory_of(scene, window);
  // A slot lets some grains through in each time in which they fall by its width.
  const auto last = std::size_t(std::lower_bound(out.begin(), out.end(), out.back()) - out.begin());
  const double falls = 5 * std::sqrt(*scene.dem.opening / std::max(scene.column.gravity, 1e-3));
  const bool long_enough = window.time.back() - window.time[last] > falls;
  bed.blocked = long_enough && window.first > 0 && out[std::size_t(window.first)] == out.back() &&
                all.last > most_left * all.first;
  if (bed.blocked || number < least_particles) return;
  const auto reached = [&](double share) {
    return std::size_t(std::lower_bound(out.begin(), out.end(), share * out.back()) - out.begin());
  };
  const std::size_t from = reached(0.1), to = reached(0.9);
  if (to > from) bed.discharge = (out[to] - out[from]) / (window.time[to] - window.time[from]);
}

void judge_drift(const core::Scene& scene, const Window& window, BedOfRun& bed) {
  std::vector<std::string> names{"bed_height"};
  for (const core::Species& species : scene.species) names.push_back("centre_" + species.name);
  measures::Drifts drifts(names);
  for (std::size_t n = 0; n < window.time.size(); ++n) {
    std::vector<std::optional<double>> row;
    for (const std::string& name : names) {
      const Series* all = column(window.history, name + "_m");
      row.push_back(all != nullptr && std::isfinite((*all)[n]) ? std::optional((*all)[n]) : std::nullopt);
    }
    drifts.see(window.time[n], row);
  }
  bed.drifts = drifts.judge();
  for (const measures::DriftOfMeasure& drift : bed.drifts) bed.steady = bed.steady.value_or(true) && drift.steady;
}

}  // namespace

std::optional<Mean> mean_of_parts(const std::vector<double>& time, const std::vector<double>& value) {
  constexpr std::size_t parts = 10;
  constexpr double student = 2.262;  // 97.5 % quantile, nine degrees of freedom
  std::array<double, parts> sum{}, count{};
  double all = 0, number = 0;
  const double length = time.empty() ? 0 : time.back() - time.front();
  for (std::size_t n = 0; n < value.size(); ++n) {
    if (!std::isfinite(value[n])) continue;
    const double place = length > 0 ? (time[n] - time.front()) / length : 0;
    const auto part = std::min(std::size_t(double(parts) * place), parts - 1);
    sum[part] += value[n];
    ++count[part];
    all += value[n];
    ++number;
  }
  if (!(number > 0)) return {};
  Mean mean{all / number, {}};
  if (std::any_of(count.begin(), count.end(), [](double c) { return c == 0; })) return mean;
  double of_parts = 0, squares = 0;
  for (std::size_t n = 0; n < parts; ++n) of_parts += sum[n] / count[n] / parts;
  for (std::size_t n = 0; n < parts; ++n) squares += std::pow(sum[n] / count[n] - of_parts, 2);
  mean.value = of_parts;
  mean.interval = student * std::sqrt(squares / (parts - 1) / parts);
  return mean;
}

BedOfRun bed_of_run(const core::Scene& scene, const core::History& history) {
  BedOfRun bed;
  const Series* time = column(history, "time_s");
  if (time == nullptr || time->empty()) return bed;
  bed.window = judged_share * (time->back() - time->front());
  const auto first = std::lower_bound(time->begin(), time->end(), time->back() - bed.window);
  const Window window{history, *time, first - time->begin()};
  constexpr double least_particles = 10;  // placed one by one, fewer are no bed
  if (scene.bed.start.kind == core::StartKind::list && particles_in(scene, window) < least_particles) return bed;
  bed.height = window.mean("bed_height_m");
  bed.drop = drop_over_weight(window);
  if (scene.species.size() > 1)
    if (const std::optional<Mean> mixing = window.mean("mixing")) bed.mixing = mixing->value;
  bed.hangs = is_light(window) && !is_pressed_down(scene, window, bed);
  bed.state = state_of(scene, window, bed);
  bed.layers = layers_of(scene, window, bed);
  if (bed.hangs) bed.height.reset();  // that of its top is the column's
  find_outflow(scene, window, bed);
  find_discharge(scene, window, bed);
  judge_drift(scene, window, bed);
  return bed;
}

}  // namespace polybed::multiscale
