#include "dem/coupling/kernel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "closures/mixture.hpp"
#include "dem/scene.hpp"
#include "fluid/smoothing.hpp"

namespace polybed::dem {

namespace {

/// Sauter's diameter of the bed, m; the largest where the case does not say of what the bed is made.
double mean_diameter(const core::Scene& scene, double largest) {
  std::vector<double> diameter;
  for (const core::Species& species : scene.species) diameter.push_back(species.diameter);
  const bool known = !diameter.empty() && scene.bed.volume_share.size() == diameter.size();
  return known ? std::min(closures::sauter_diameter(scene.bed.volume_share, diameter), largest) : largest;
}

}  // namespace

Kernel kernel_of(const core::Scene& scene, double smallest_cell, double largest_diameter, std::int64_t particles) {
  const core::Kernel asked = scene.dem.kernel;
  if (asked == core::Kernel::bilinear) return {0, "the case asks for it"};
  if (scene.dem.kernel_width) return {*scene.dem.kernel_width, "the case gives the width"};
  const auto number = std::max(std::size_t(particles), is_fed(scene) ? fluid::fewest_of_a_bed : 0);
  const bool wide = asked == core::Kernel::diffusion;
  const double width = fluid::smoothing_width(wide ? 0 : smallest_cell, largest_diameter,
                                              mean_diameter(scene, largest_diameter), number);
  const double ratio = smallest_cell / largest_diameter;
  if (width == 0) return {0, fmt::format("the smallest cell has {:.3g} of the largest diameters", ratio)};
  const std::string of = fmt::format("{:.2g} of the largest diameters", width / largest_diameter);
  return {width, wide ? fmt::format("the case asks for it: {}", of)
                      : fmt::format("{}, as the smallest cell has only {:.3g} of them", of, ratio)};
}

std::string smearing_warning(const core::Scene& scene, double width) {
  // Pressure drop of a held bed of 27 diameters, over that with bilinear weights: 0.97, 0.955, 0.92 and 0.81 at widths
  // of 0.11, 0.15, 0.22 and 0.44 of its height (docs/record/validation.md).
  constexpr double lost_by_width = 0.4, noticeable = 0.1;
  const double height = scene.bed.static_height, lost = height > 0 ? lost_by_width * width / height : 0;
  if (scene.dem.kernel_width || scene.flows_around() || lost < noticeable) return "";
  return fmt::format(
      "the fluid sees the particles averaged over {:.3g} mm, in a bed of {:.3g} mm: near the top it sees a thinner "
      "bed, and its drag is some {:.0f} % too small; a higher bed suffers less",
      1e3 * width, 1e3 * height, 100 * lost);
}

}  // namespace polybed::dem
