// Absolute tolerances of the unknowns, from the one relative tolerance in a case.
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

/// Relative tolerance of the integrator. Implicit steps use a fifth of the case's: at the full tolerance the residuals
/// of their linear solves disturb stresses that grow with shear, steps become no longer, and each takes several times
/// as many iterations.
[[nodiscard]] inline double kept_tolerance(core::TfmIntegrator integrator, double rtol) {
  constexpr double share = 0.2;
  return integrator == core::TfmIntegrator::implicit_steps ? std::max(share * rtol, least_implicit_tolerance) : rtol;
}

struct Tolerances {
  double relative = 0;
  std::vector<double> absolute;  ///< by entry in the state
  core::TolerancesAt at;         ///< replace them if the inflow is zero at times; else empty
};

/// Absolute tolerance of the fractions.
[[nodiscard]] inline double fraction_tolerance(double rtol) { return 0.1 * rtol; }

/// \param rtol  relative  \param velocity_scale  m/s  \param pressure_scale  Pa: rtol times these is the tolerance of
/// velocities and pressure
/// \param equations  must outlive the result
[[nodiscard]] Tolerances tolerances_of(const RightHandSide& equations, const StateLayout& layout, double rtol,
                                       double velocity_scale, double pressure_scale);

/// For a bed that can come to rest, as core::TolerancesAt requires: the tolerances of its velocities depend on its
/// speed. With constant ones a settled bed creeps within them forever.
class RestingTolerances {
 public:
  /// \param moving  absolute tolerances for a moving bed  \param scale  its velocity, m/s
  /// \param gravity  m/s2  \param boundaries  must outlive this
  RestingTolerances(const core::Grid& grid, const fluid::Boundaries& boundaries, const StateLayout& layout,
                    std::vector<double> moving, double scale, double gravity);
  /// Tolerances of the fluxes, and of the solids' velocities on faces next to solids, times the greatest speed between
  /// cells that both contain solids over the scale, from 1e-7 to 1. If rates are known, their change over the time in
  /// which gravity accelerates a body to that scale counts as speed: a released bed is not at rest. Solids that fall
  /// through an empty column keep their tolerances: they still fall when the bed is at rest.
  void operator()(std::span<const double> y, std::span<const double> dydt, std::span<double> atol);

 private:
  /// Calls body(n, value) with the place in the state of each relevant velocity and its entry in `values`; including
  /// the bed's surface, or without it.
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
