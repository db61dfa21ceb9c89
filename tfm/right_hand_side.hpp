// The equations of the continuum model, one line per term: from a state to the rates of all phases before the
// pressure acts. Both integrators use this one operator.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "core/timers.hpp"
#include "fluid/fluid_mass.hpp"
#include "fluid/inlet.hpp"
#include "tfm/conservative_convection.hpp"
#include "tfm/effects.hpp"
#include "tfm/solids.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

struct Discretisation {
  Scheme flux = Scheme::limited;     ///< for the solids fractions
  Scheme momentum = Scheme::upwind;  ///< for the velocities
  fluid::WallSlip solids_wall = fluid::WallSlip::free_slip;
};

class RightHandSide {
 public:
  RightHandSide(const core::Scene& scene, Constants constants, fluid::Boundaries boundaries, fluid::Inlet inlet,
                Discretisation discretisation, core::Timers& timers);
  RightHandSide(const RightHandSide&) = delete;
  RightHandSide& operator=(const RightHandSide&) = delete;

  /// Evaluates every term at (t, y); the result is in fields(). Returns false if closures cannot be evaluated for the
  /// state (not finite, or a cell with more than its volume of solids): the step must shrink.
  [[nodiscard]] bool evaluate(double t, const StateLayout& layout, std::span<const double> y);

  /// Flow of a compressible fluid in and out for a state; nothing if its pressure has no density. The unknowns of that
  /// state are then in fields().
  [[nodiscard]] std::optional<fluid::MassFlow> mass_flow(double t, const StateLayout& layout,
                                                         std::span<const double> y);

  [[nodiscard]] const Constants& constants() const { return constants_; }
  [[nodiscard]] const fluid::Boundaries& boundaries() const { return boundaries_; }
  [[nodiscard]] const fluid::Inlet& inlet() const { return inlet_; }
  /// Starts an integration at a time, s: a jump of the inlet at that time has happened; later ones have not.
  void begin(double t) { begin_ = t; }
  /// Between joined ends: the mean gradient of the pressure carries the weight of this state from now on, which stays
  /// the same. Collective.
  void drive(const StateLayout& layout, std::span<const double> y);
  /// That gradient, Pa/m; 0 between other ends.
  [[nodiscard]] double mean_gradient() const { return mean_gradient_; }
  /// Sets faces with first-order flux of the solids from now on; null: none. The list must outlive its use.
  void take_first_order_on(const FaceList* faces) { first_order_ = faces; }
  /// Solves the solids' equations only below a row of cells of the column; solids above it stay unchanged.
  void hold_solids_above(int row);
  [[nodiscard]] const Effects& effects() const { return effects_; }
  [[nodiscard]] Fields& fields() { return fields_; }
  [[nodiscard]] const Fields& fields() const { return fields_; }

 private:
  void fill_ghosts(double t);
  [[nodiscard]] bool equation_of_state();
  [[nodiscard]] double side_of(double t) const;
  void set_inlet_velocity(double t);
  void set_inlet_rate(double t);
  void add_solids_stress();
  void add_particle_forces();
  void set_flux_rate(double t);
  [[nodiscard]] bool admissible() const;

  Constants constants_;
  fluid::Boundaries boundaries_;
  fluid::Inlet inlet_;
  double begin_ = 0, mean_gradient_ = 0;
  Discretisation discretisation_;
  core::Timers& timers_;
  Fields fields_;
  Effects effects_;
  ConservativeConvection convection_;
  int solids_rows_ = std::numeric_limits<int>::max();
  const FaceList* first_order_ = nullptr;
  std::vector<fluid::Ghosts> state_ghosts_;  ///< the unknowns, whose ghosts share messages
  core::Field viscous_weight_;               ///< work space for the solids' viscosity; empty without
};

}  // namespace polybed::tfm
