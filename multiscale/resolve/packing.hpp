// Random boxes of spheres for resolved flow.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// Spheres in a periodic cube, SI.
struct SpherePacking {
  double length = 0;  ///< of an edge, m
  std::vector<std::array<double, 3>> centre;
  std::vector<std::size_t> species;
  core::Scene scene;  ///< the particle model starts from it at these places
};

/// Numbers of spheres of each species for the bed's shares, about resolve.spheres in total; a species can get none.
[[nodiscard]] std::vector<std::int64_t> sphere_numbers(const core::Scene& scene);

/// Shares of the volume for these numbers.
[[nodiscard]] std::vector<double> shares_of(const core::Scene& scene, const std::vector<std::int64_t>& numbers);

/// Edge of a cube with that voidage and these numbers of spheres, m.
[[nodiscard]] double box_length(const core::Scene& scene, double voidage);

/// A line for shares that whole numbers of spheres miss by more than 1 %, and one for a box of held spheres that is
/// less than two of the largest diameters wide; empty without.
[[nodiscard]] std::vector<std::string> packing_notes(const core::Scene& scene);

/// A cube with that voidage and these numbers of spheres, without overlap beyond a thousandth of a radius. Throws
/// core::StartError for spheres that do not fit. \param seed  of this packing
[[nodiscard]] SpherePacking sphere_packing(const core::Scene& scene, double voidage, std::uint64_t seed);

}  // namespace polybed::multiscale
