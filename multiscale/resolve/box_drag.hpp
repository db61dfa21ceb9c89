// Drag on the spheres of one packing from the flow resolved on one grid.
#pragma once

#include <functional>
#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "multiscale/resolve/kept_box.hpp"
#include "multiscale/resolve/packing.hpp"

namespace polybed::multiscale {

/// A point of the data, and one box of it.
struct ResolvePoint {
  double voidage = 0, reynolds = 0;
  int packing = 0, grid = 0;  ///< from 0; grid 0 is the finest
};

/// Forces over those of Stokes at the superficial velocity, means over the spheres of each species.
struct BoxDrag {
  std::vector<double> net, pure;  ///< n_j, f_j
  double cells = 0;               ///< of the smallest diameter, as the edge of the box allows
  double change = 0, imbalance = 0;
  double steps = 0, sites = 0, seconds = 0;  ///< of fluid and spheres in the box; wall time of the steps
};

/// What the keys of [resolve] require of each other: grids that resolve the pores and the Reynolds number, spheres of
/// every species.
[[nodiscard]] std::vector<core::Rule> resolve_rules();

/// Cells of the smallest diameter on a grid.
[[nodiscard]] double cells_of(const core::Resolve& resolve, int grid);

/// What a box will need. Steps as most boxes took that were measured, within a factor of 2; unsteady flow takes up to
/// twenty times as many.
struct BoxNeed {
  double sites = 0, steps = 0, bytes = 0;
};
[[nodiscard]] BoxNeed box_need(const core::Scene& scene, const ResolvePoint& point);

/// Called now and then with the steps taken and the relative change of the drag; returns false to stop.
using StillWanted = std::function<bool(double steps, double change)>;

/// The flow stops when its drag changes by less than 1e-5 (single precision: 1e-4) while a pore forgets its
/// past, or after 200 such times: `change` tells what is left. Throws core::Stopped once `wanted` returns false,
/// core::NumericsError. \param kept  where the flow is kept from time to time, when it is stopped, and taken up again
[[nodiscard]] BoxDrag box_drag(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                               const StillWanted& wanted, const KeptBox* kept = nullptr);

/// Sites a second of this machine in the box of a point, measured for about a second.
[[nodiscard]] double measured_rate(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing);

}  // namespace polybed::multiscale
