#include "dem/coupling/kernel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "closures/mixture.hpp"
#include "dem/scene.hpp"
#include "fluid/smoothing.hpp"

namespace polybed::dem {

Kernel kernel_of(const core::Scene& scene, double smallest_cell, double largest_diameter, std::int64_t particles) {
  const core::Kernel asked = scene.dem.kernel;
  if (asked == core::Kernel::bilinear) return {0, "the case asks for it"};
  if (scene.dem.kernel_width) return {*scene.dem.kernel_width, "the case gives the width"};
  const auto number = std::max(std::size_t(particles), is_fed(scene) ? fluid::fewest_of_a_bed : 0);
  const double automatic = fluid::smoothing_width(smallest_cell, largest_diameter, number);
  const double ratio = smallest_cell / largest_diameter;
  if (automatic > 0)
    return {automatic, fmt::format("{:.2g} of the largest diameters, as the smallest cell has only {:.3g} of them",
                                   automatic / largest_diameter, ratio)};
  constexpr double in_beds = 4;
  if (asked == core::Kernel::diffusion)
    return {in_beds * largest_diameter, "the case asks for it: 4 of the largest diameters"};
  return {0, fmt::format("the smallest cell has {:.3g} of the largest diameters", ratio)};
}

std::string smearing_warning(const core::Scene& scene, double width) {
  // Pressure drop of a held bed of 27 diameters, over that with bilinear weights: 0.97, 0.955, 0.92 and 0.81 at widths
  // of 0.11, 0.15, 0.22 and 0.44 of its height (docs/record/validation.md).
  constexpr double lost_by_width = 0.4, noticeable = 0.1;
  const double height = scene.bed.static_height, lost = height > 0 ? lost_by_width * width / height : 0;
  if (scene.dem.kernel_width || lost < noticeable) return "";
  std::vector<double> diameter;
  for (const core::Species& species : scene.species) diameter.push_back(species.diameter);
  std::string advice = "a higher bed suffers less";
  if (scene.bed.volume_share.size() == diameter.size()) {
    const double fitting = 4 * closures::sauter_diameter(scene.bed.volume_share, diameter);
    if (fitting < 0.8 * width)
      advice = fmt::format("dem.kernel_width = \"{:.3g} mm\" is four of the mean diameter", 1e3 * fitting);
  }
  return fmt::format(
      "the fluid sees the particles averaged over {:.3g} mm, in a bed of {:.3g} mm: near the top it sees a thinner "
      "bed, and its drag is some {:.0f} % too small; {}",
      1e3 * width, 1e3 * height, 100 * lost, advice);
}

}  // namespace polybed::dem
