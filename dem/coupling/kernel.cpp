#include "dem/coupling/kernel.hpp"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace polybed::dem
