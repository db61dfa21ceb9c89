// Absolute tolerances of the unknowns, from the one relative tolerance of a case.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "core/numerics/integrator.hpp"
#include "fluid/boundaries.hpp"
#include "tfm/right_hand_side.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

/// Below this relative tolerance round-off stops the Newton iteration of implicit steps.
inline constexpr double least_implicit_tolerance = 1e-10;

/// Relative tolerance of the integrator. Implicit steps use a fifth of that of the case: at the full tolerance the
/// residuals of their linear solves disturb stresses that grow with shear, steps get no longer, and each takes several
/// times as many iterations.
[[nodiscard]] inline double kept_tolerance(core::TfmIntegrator integrator, double rtol) {
  constexpr double share = 0.2;
  return integrator == core::TfmIntegrator::implicit_steps ? std::max(share * rtol, least_implicit_tolerance) : rtol;
}

struct Tolerances {
  double relative = 0;
  std::vector<double> absolute;  ///< by entry of the state
  core::TolerancesAt at;         ///< in their place where nothing flows in at times; empty elsewhere
};

/// Absolute tolerance of the fractions.
[[nodiscard]] inline double fraction_tolerance(double rtol) { return 0.1 * rtol; }

/// \param rtol  relative  \param velocity_scale  m/s  \param pressure_scale  Pa: rtol times these is the tolerance of
/// velocities and pressure
/// \param equations  outlive what is returned
[[nodiscard]] Tolerances tolerances_of(const RightHandSide& equations, const StateLayout& layout, double rtol,
                                       double velocity_scale, double pressure_scale);

/// Of a bed that may come to rest, as core::TolerancesAt asks: those of its velocities follow how fast it moves. With
/// ones that stay, a settled bed creeps within them for ever.
class RestingTolerances {
 public:
  /// \param moving  absolute tolerances of a bed that moves  \param scale  its velocity, m/s
  /// \param gravity  m/s2  \param boundaries  outlive this
  RestingTolerances(const core::Grid& grid, const fluid::Boundaries& boundaries, const StateLayout& layout,
                    std::vector<double> moving, double scale, double gravity);
  /// Tolerances of the fluxes, and of velocities of solids on faces beside some, times the greatest speed between cells
  /// that both hold some over the scale, from 1e-7 to 1. Where rates are known, what they add in the time in which the
  /// weight gives a body that scale counts as speed: a bed that is let go is not at rest. What falls through an empty
  /// column falls on when the bed has long come to rest, and keeps its tolerances.
  void operator()(std::span<const double> y, std::span<const double> dydt, std::span<double> atol);

 private:
  /// Calls body(n, value) with the place in the state of each velocity that is meant and what `values` has there; with
  /// those of the bed's surface, or without.
  template <class Body>
  void for_each_velocity(std::span<const double> values, bool surface, Body&& body) const;
  void find_solids(std::span<const double> y);

  core::Grid grid_;
  const fluid::Boundaries* boundaries_;
  StateLayout layout_;
  std::vector<double> moving_;
  double scale_, falling_time_;
  core::Field solids_fraction_, entry_;  ///< work space
};

}  // namespace polybed::tfm
