#include "multiscale/card/first_steady.hpp"

#include <algorithm>

#include "closures/bed_expansion.hpp"

namespace polybed::multiscale {

namespace {

/// Slice by slice; empty if the fluid is too slow somewhere on the way up, or too fast on the way down.
std::optional<double> moving_time(const Slices& slices, double from, double to, double velocity, double carried) {
  const auto time = [&](double distance, double here) -> std::optional<double> {
    if (!(distance * (here - carried) > 0)) return {};
    return closures::rising_time(distance, here, carried);
  };
  if (slices.empty()) return time(to - from, velocity);
  double sum = 0, low = 0;
  for (std::size_t n = 0; n < slices.height.size(); low += slices.height[n++]) {
    const double high = low + slices.height[n];
    const double part = std::clamp(to, low, high) - std::clamp(from, low, high);
    if (part == 0) continue;
    const std::optional<double> one = time(part, velocity * slices.height[n] / slices.even[n]);
    if (!one) return {};
    sum += *one;
  }
  return sum;
}

}  // namespace

FirstSteady first_steady(const core::Scene& scene, const Slices& slices, const BedOfCase& bed, double start,
                         double carried) {
  const auto& inlet = scene.inlet.superficial_velocity;
  const bool loose = scene.bed.start_solids_fraction < scene.bed.solids_fraction;
  const bool gas = !bed.species.front().geldart.empty();
  if (std::any_of(inlet.begin(), inlet.end(), [&](const auto& one) { return one.second != inlet.front().second; }))
    return {inlet.back().first, "the inlet changes until then"};
  if (!scene.jets.empty()) return {{}, "a jet moves only the solids on its path"};
  if (scene.bed.held) return {0.0, "the particles are held"};
  if (bed.state == Fluidisation::packed && !loose) return {0.0, "the bed stays packed"};
  if (gas) return {{}, "the height swings as bubbles form and burst"};
  if (overflows(scene, bed)) return {{}, "solids leave over the top"};
  if (!bed.discharges.empty()) return {{}, "solids leave through a discharge"};
  if (bed.no_balance) return {{}, "by its drag law the fluid carries all solids to the top"};
  if (scene.bed.start.kind == core::StartKind::list || scene.bed.start.kind == core::StartKind::checkpoint)
    return {{}, "the start is read from a file"};
  if (loose && !bed.leaving.empty()) return {{}, "the solids that are lifted leave first"};
  if (!scene.layers.empty() && loose) return {{}, "the layers start loose"};
  if (!bed.own.height) return {};
  const double end = std::min(*bed.own.height, scene.column.size[1]);
  const std::optional<double> least = moving_time(slices, start, end, *bed.velocity, carried);
  if (!least) return {{}, "the fluid is too slow near the top to lift the settled bed"};
  if (end < start) return {least, "the top falls as the bed settles through the fluid"};
  const std::string even = bed.top_heavy ? "if each level were even, " : "",
                    by = loose ? "u less the velocity that carries the bed at its start" : "u - u_mf";
  return {least, even + "the top rises no faster than " + by};
}

}  // namespace polybed::multiscale
