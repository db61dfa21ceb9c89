// How a box of resolved flow is computed: its grid, its units, how long it runs.
#pragma once

#include <cstdint>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// A point of the data, and one box of it.
struct ResolvePoint {
  double voidage = 0, reynolds = 0;
  int packing = 0, grid = 0;  ///< from 0; grid 0 is the finest
  int past = -1;              ///< the species that the fluid and all others move past; -1: none
};

/// The species that are passed, each in a box of its own; -1 where none is.
[[nodiscard]] std::vector<int> passed(const core::Scene& scene);

/// Cells from which on the flow in a gap is resolved (Nguyen and Ladd, Phys. Rev. E 66 (2002) 046708): what it lacks
/// below is that of the film, within 8 % in docs/record/resolved-flow.md.
inline constexpr double resolved_gap = 2.0 / 3;

/// Cells of the smallest diameter on a grid.
[[nodiscard]] double cells_of(const core::Resolve& resolve, int grid);

/// The smallest of all species, m.
[[nodiscard]] double least_diameter(const core::Scene& scene);

/// Hydraulic diameter of the pores over the Sauter diameter.
[[nodiscard]] double pore_of(double voidage);

/// Cells of the Sauter diameter of the case, as its rules see it.
[[nodiscard]] double sauter_cells(const core::Scene& scene, int grid);

/// Viscosity and superficial velocity, in cells and steps.
struct Units {
  double viscosity = 0, speed = 0;
};
[[nodiscard]] Units units_of(double voidage, double reynolds, double sauter_in_cells);

/// The same for free spheres, at the speed at which the fastest species falls alone.
[[nodiscard]] Units units_of_fall(const core::Scene& scene, double cells);

/// In cells and steps: below it the collision barely damps what the grid cannot resolve.
[[nodiscard]] double least_viscosity(double pore_cells);

/// Lengths in cells, times in steps.
struct BoxPlan {
  int edge = 0;
  double scale = 0;  ///< cells per m
  double sauter = 0;
  Units units;
  double window = 0;       ///< in which a pore forgets its past; of free spheres, between two looks
  double step = 0;         ///< s, of free spheres
  std::int64_t steps = 0;  ///< until a box of free spheres ends
};
[[nodiscard]] BoxPlan plan_of(const core::Scene& scene, const ResolvePoint& point);

/// What a box will need. Steps of steady flow as most boxes took that were measured, within a factor of 2; unsteady
/// flow takes up to twenty times as many.
struct BoxNeed {
  double sites = 0, steps = 0, bytes = 0;
};
[[nodiscard]] BoxNeed box_need(const core::Scene& scene, const ResolvePoint& point);

}  // namespace polybed::multiscale
