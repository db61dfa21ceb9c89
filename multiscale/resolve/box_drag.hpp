// Drag on the spheres of one packing, from the resolved flow on one grid.
#pragma once

#include <functional>
#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/resolve/kept_box.hpp"
#include "multiscale/resolve/packing.hpp"
#include "multiscale/resolve/plan.hpp"

namespace polybed::multiscale {

/// Forces over Stokes' at the superficial velocity, means over the spheres of each species. If some species are passed,
/// only the forces from their relative motion.
struct BoxDrag {
  std::vector<double> net, pure;             ///< n_j, f_j; for free spheres each at its own velocity
  std::vector<double> slip, along, across;   ///< free spheres: superficial slip, rms velocities within a species, m/s
  double cells = 0;                          ///< per smallest diameter, after rounding to the edge of the box
  double change = 0, imbalance = 0;          ///< for free spheres: drift of the momentum of fluid and spheres
  double steps = 0, sites = 0, seconds = 0;  ///< of fluid and spheres in the box; wall time of the steps
  std::vector<double> pairs = {};            ///< free spheres: PairDistribution::mean()
};

/// Called at intervals with the number of steps and the relative change of the drag; returns false to stop.
using StillWanted = std::function<bool(double steps, double change)>;

/// The flow stops when its drag changes by less than 1e-5 (single precision: 1e-4) over the memory time of a pore, or
/// after 200 such times: `change` contains the remaining change. Throws core::Stopped once `wanted` returns false,
/// core::NumericsError. \param kept  stores the flow at intervals and at a stop, and restores it
[[nodiscard]] BoxDrag box_drag(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                               const StillWanted& wanted, const KeptBox* kept = nullptr);

/// Spheres of a packing in cells; flow between them.
[[nodiscard]] std::vector<lattice::Sphere> spheres_of(const core::Scene& scene, const SpherePacking& packing,
                                                      double scale);
[[nodiscard]] lattice::FlowSetup flow_setup(const BoxPlan& box, bool inertia);

/// Sites per second on this machine in the box of a point, measured for about a second.
[[nodiscard]] double measured_rate(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing);

}  // namespace polybed::multiscale
