// Averaged fluid between particles, step by step: T(1.10) with T(1.16), the same terms as in fluid/momentum.hpp,
// two-way coupled with the particles, implicitly in their drag.
//
//   (m + K) dU = dt [m a - eps G - I/dt - C (U.grad)U] - dt (eps + S) dG,   m = eps rho_f
//   J = eps (U + dU) + F + Y dU + D dt (U.grad)U - dt Q dG,   div J = 0  (or -kappa dP/dt of a compressible fluid)
//
// a = -(U.grad)U + div(eps tau)/(eps rho_f), with (U.grad)U in the conservative form of fluid/convection.hpp. G the
// gradient of the net pressure, dG its change. Of ParticlePhase: F flux, I impulse, K drag, Y follow, S slide, Q yield,
// C carry, D carry_flux. The pressure's change follows from the constraint, with the mobility
//
//   B = (eps + Y)(eps + S)/(m + K) + Q.
//
// Otherwise particles that had responded only to the old pressure would be pushed apart by the new one: the ratio of
// displaced to particle mass, phi rho_f/(eps rho_p), would multiply the error at every step, whatever its length.
#pragma once

#include <optional>

#include "core/case/scene.hpp"
#include "core/numerics/linear_solver.hpp"
#include "fluid/boundaries.hpp"
#include "fluid/compressible.hpp"
#include "fluid/inlet.hpp"
#include "fluid/particle_phase.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::fluid {

/// Report of a step of the fluid.
struct FlowStep {
  int iterations = 0;   ///< of the linear solver
  double residual = 0;  ///< its true relative residual
  double courant = 0;   ///< greatest |U| dt/h, and for the viscous stress 2 nu dt sum(1/h^2)
  double mass_in = 0;   ///< kg of a compressible fluid that entered through the distributor
  double mass_out = 0;  ///< the same for the outlet
};

class Flow {
 public:
  /// Collective, as are all functions that change it.
  /// \param grid  the column or this rank's block of it  \param tolerance  relative residual of the pressure
  Flow(const core::Scene& scene, const core::Grid& grid, double tolerance);

  /// Starts the fluid at time t, s, between particles that do not respond: an impulse of the pressure, which is then
  /// discarded, fits its velocity to the inlet and the particles' flux.
  void begin(double t, const ParticlePhase& particles);
  /// One step from t to t + dt, s. Throws core::NumericsError with a remedy if the equations cannot be solved, or dt is
  /// too long for explicit convection and stress.
  FlowStep advance(double t, double dt, const ParticlePhase& particles);

  [[nodiscard]] const FluidState& state() const { return fluid_; }
  [[nodiscard]] FluidState& state() { return fluid_; }
  [[nodiscard]] const core::Grid& grid() const { return grid_; }
  [[nodiscard]] const Boundaries& boundaries() const { return boundaries_; }
  [[nodiscard]] const Inlet& inlet() const { return inlet_; }
  [[nodiscard]] const relevance::FluidConstants& constants() const { return constants_; }
  /// G, Pa/m, on all faces; held faces have the value of their neighbour inside.
  [[nodiscard]] const core::FaceField& gradient() const { return gradient_; }
  /// dG and dU of the last step, and dt (U.grad)U in it, m/s.
  [[nodiscard]] const core::FaceField& gradient_change() const { return gradient_change_; }
  [[nodiscard]] const core::FaceField& velocity_change() const { return velocity_change_; }
  [[nodiscard]] const core::FaceField& convected() const { return convected_; }
  /// Whether a discharge has a pressure, and the flow out through the open faces of the sides, m3/s.
  [[nodiscard]] bool has_open_sides() const { return has_open_sides_; }
  [[nodiscard]] double overflow() const {
    return has_open_sides_ ? outflow(grid_, boundaries_.open_faces(), fluid_.velocity) : 0;
  }
  /// Null for an incompressible fluid.
  [[nodiscard]] const Compressible* compressible() const { return compressible_ ? &*compressible_ : nullptr; }
  /// Drives the fluid and the particles between joined ends by a mean gradient of the net pressure, Pa/m, from the next
  /// set_gradient() on.
  void drive(double mean_gradient) { mean_gradient_ = mean_gradient; }
  [[nodiscard]] double mean_gradient() const { return mean_gradient_; }
  /// Adds a velocity, m/s, to the whole fluid: the solids get the same, and nothing moves relative to anything else.
  void shift(const std::array<double, 3>& velocity);
  /// Recomputes the pressure's gradient from the pressure, after the state was set from outside.
  void set_gradient();
  /// Starts anew: further solves do not depend on earlier ones.
  void forget() { solver_.forget(); }

 private:
  void set_voidage(const ParticlePhase& particles);
  void set_density();
  void finish_compression(double dt, FlowStep& step);
  void set_inlet(double t);
  void find_acceleration(double dt, const ParticlePhase& particles);
  void find_own_flux(const ParticlePhase& particles);
  template <class Density>
  void push(const Density& density, double dt, const ParticlePhase& particles);
  void begin_pressure(double t);
  void add_compression(double dt);
  void hold();
  const core::FaceField& open_mobility();
  void close_pressure(double t, double dt, FlowStep& step);
  void correct(double dt);
  [[nodiscard]] double courant(double dt) const;
  [[nodiscard]] double viscous_courant(double dt) const;
  void gradient_of(const core::Field& p, core::FaceField& out);
  void gradient_on_closed(core::FaceField& out);
  /// Calls body(open face, axis, face) for the faces in the sides with a pressure outside. U is their whole flux.
  template <class Body>
  void for_each_open_face(Body&& body) const {
    for (const OpenFace& f : boundaries_.open_faces()) body(f, f.axis(), std::size_t(f.face));
  }

  core::Grid grid_;
  Boundaries boundaries_;
  Inlet inlet_;
  relevance::FluidConstants constants_;
  double mean_gradient_ = 0;                     ///< along the height, between joined ends, Pa/m
  double gravity_, solids_density_, tolerance_;  ///< m/s2; mean, kg/m3; of the pressure's residual
  bool viscous_;                                 ///< with a viscous stress
  bool has_open_sides_;
  bool driven_;   ///< by a pressure outside a discharge
  bool held_;     ///< the particles do not move
  bool limited_;  ///< convection is second order, with a limiter
  std::optional<Compressible> compressible_;
  core::PoissonSolver solver_;
  FluidState fluid_;
  core::FaceField convected_, acceleration_, velocity_change_, gradient_, gradient_change_;
  core::FaceField per_inertia_;    ///< (eps + S)/(m + K), 1/(kg/m3): factor of -dt dG in dU
  core::FaceField mobility_;       ///< B, m3/kg
  core::FaceField open_mobility_;  ///< for a round column, times the open share of faces
  core::FaceField own_flux_;       ///< eps U, m/s
  core::Field source_, change_;    ///< right-hand side, 1/s2, and solution, Pa, of the pressure equation
  core::Field shift_;              ///< kappa/dt^2; empty without compression
  core::Field with_ghosts_;        ///< a pressure during computation of its gradient
  double per_square_;              ///< for the viscous stress, see viscous_rate, 1/m2
};

}  // namespace polybed::fluid
