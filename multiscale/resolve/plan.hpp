// Computation of a resolved box: its grid, its units, its duration.
#pragma once

#include <cstdint>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// A point of the data, and one box of it.
struct ResolvePoint {
  double voidage = 0, reynolds = 0;
  int packing = 0, grid = 0;   ///< from 0; grid 0 is the finest
  std::vector<int> past = {};  ///< species at rest that the fluid and all others pass; held spheres: empty
};

/// Boxes for one packing, by the species that are passed: for held and free spheres one without. Moving spheres: each
/// species alone in Stokes flow, otherwise all sets of species, the last of which is the held box.
[[nodiscard]] std::vector<std::vector<int>> passed(const core::Scene& scene, double reynolds);
[[nodiscard]] bool is_passed(const ResolvePoint& point, std::size_t species);

/// Factor of a box in the force by the motion of a species k. In Stokes flow that force is the box past k. Otherwise it
/// is the mean, over all orders in which species stop one after the other, of the change when k stops (Shapley, in:
/// Contributions to the Theory of Games II, 1953): the parts of all species add up to the held drag, and a force that
/// is linear and quadratic in velocities is split as by its derivative along the way from rest.
[[nodiscard]] double factor_of(const std::vector<int>& past, int species, const core::Scene& scene, double reynolds);

/// Whether species move past each other at new places all the time.
[[nodiscard]] bool places_move(const core::Scene& scene, const ResolvePoint& point);

/// Gap in cells above which the flow is resolved (Nguyen and Ladd, Phys. Rev. E 66 (2002) 046708): below it the missing
/// part is the film's, within 8 % in docs/record/resolved-flow.md.
inline constexpr double resolved_gap = 2.0 / 3;

/// Cells per smallest diameter on a grid.
[[nodiscard]] double cells_of(const core::Resolve& resolve, int grid);

/// The smallest diameter of all species, m.
[[nodiscard]] double least_diameter(const core::Scene& scene);

/// Hydraulic diameter of the pores over the Sauter diameter.
[[nodiscard]] double pore_of(double voidage);

/// Cells per Sauter diameter of the case, for its rules.
[[nodiscard]] double sauter_cells(const core::Scene& scene, int grid);

/// Viscosity and superficial velocity, in cells and steps.
struct Units {
  double viscosity = 0, speed = 0;
};
[[nodiscard]] Units units_of(double voidage, double reynolds, double sauter_in_cells);

/// The same for free spheres, at the fall speed of the fastest species alone.
[[nodiscard]] Units units_of_fall(const core::Scene& scene, double cells);

/// In cells and steps: below it the collision hardly damps scales that the grid cannot resolve.
[[nodiscard]] double least_viscosity(double pore_cells);

/// Lengths in cells, times in steps.
struct BoxPlan {
  int edge = 0;
  double scale = 0;  ///< cells per m
  double sauter = 0;
  Units units;
  double window = 0;         ///< memory time of a pore; if spheres travel, time between two checks
  double step = 0;           ///< s, for free spheres
  std::int64_t steps = 0;    ///< length of a run whose spheres travel; 0: until the flow is steady
  std::int64_t dropped = 0;  ///< of them, before the means
  std::int64_t still = 0;    ///< of them, before moving spheres start to travel
};
[[nodiscard]] BoxPlan plan_of(const core::Scene& scene, const ResolvePoint& point);

/// Requirements of a box. The steps of steady flow are from most measured boxes, within a factor of 2; unsteady flow
/// takes up to twenty times as many.
struct BoxNeed {
  double sites = 0, steps = 0, bytes = 0;
};
[[nodiscard]] BoxNeed box_need(const core::Scene& scene, const ResolvePoint& point);

}  // namespace polybed::multiscale
