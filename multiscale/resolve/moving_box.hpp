// A box of spheres whose species move at given velocities through resolved flow with inertia: their places move along.
#pragma once

#include <vector>

#include "multiscale/resolve/box_drag.hpp"
#include "multiscale/resolve/guided_spheres.hpp"
#include "multiscale/resolve/lattice/flow.hpp"

namespace polybed::multiscale {

/// The passed species rest, fluid and all others move past them along x at the velocity of the point's Reynolds number.
template <class Real>
class MovingBox {
 public:
  /// \param common  velocity that fluid and all spheres have in addition, cells a step
  MovingBox(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing, double common = 0);

  /// Two steps of the fluid. Spheres stay at first, until the flow has developed, with moving walls; then they travel.
  void step();
  /// Resets the mean density and measures the momentum, as a resumed box does: both then have the same bits.
  void begin_window();
  /// Velocities are known in each step.
  void sample() {}
  /// Mean forces since forget(), on the spheres of each species.
  [[nodiscard]] BoxDrag means() const;
  void forget() { sums_ = Sums(sums_.force.size()); }

  [[nodiscard]] core::Checkpoint state() const;
  void restore(const core::Checkpoint& state);

  [[nodiscard]] const BoxPlan& plan() const { return plan_; }
  [[nodiscard]] lattice::Flow<Real>& flow() { return flow_; }
  [[nodiscard]] const GuidedSpheres& spheres() const { return spheres_; }

 private:
  struct Sums {
    double steps = 0, push = 0, gradient = 0;  ///< forces on the fluid, on one of its sites
    double drag = 0, slip = 0;                 ///< slip: superficial, past the passed species
    std::vector<double> force;                 ///< on all spheres of each species
    explicit Sums(std::size_t species) : force(species, 0) {}
  };

  void let_walls_follow();
  /// Of the fluid along x, without the half force of its velocity.
  [[nodiscard]] double measured_momentum() const;

  double common_, fluid_velocity_, roughness_;
  BoxPlan plan_;
  std::vector<std::size_t> species_;
  std::vector<double> radius_, count_;  ///< of each species
  GuidedSpheres spheres_;
  lattice::Flow<Real> flow_;
  std::int64_t still_;              ///< steps left before the spheres travel
  double momentum_ = 0, drag_ = 0;  ///< as measured_momentum(); on all spheres, in the last two steps
  Sums sums_;
};

/// Means over the last two thirds of the way. Throws as box_drag().
[[nodiscard]] BoxDrag moving_box(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                                 const StillWanted& wanted, const KeptBox* kept);

}  // namespace polybed::multiscale
