// Drag on the spheres of one packing from the flow resolved on one grid.
#pragma once

#include <functional>
#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/resolve/kept_box.hpp"
#include "multiscale/resolve/packing.hpp"
#include "multiscale/resolve/plan.hpp"

namespace polybed::multiscale {

/// Forces over those of Stokes at the superficial velocity, means over the spheres of each species. Where one species
/// is passed, those by its relative motion alone.
struct BoxDrag {
  std::vector<double> net, pure;             ///< n_j, f_j; of free spheres each at its own velocity
  std::vector<double> slip, along, across;   ///< free spheres: superficial slip, rms velocities within a species, m/s
  double cells = 0;                          ///< of the smallest diameter, as the edge of the box allows
  double change = 0, imbalance = 0;          ///< of free spheres: drift of the momentum of fluid and spheres
  double steps = 0, sites = 0, seconds = 0;  ///< of fluid and spheres in the box; wall time of the steps
};

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
