// Parts of a model's steps that only some scenes need.
#pragma once

#include "core/timers.hpp"
#include "fluid/fluid_mass.hpp"
#include "tfm/first_order_fallback.hpp"
#include "tfm/packing_limit.hpp"
#include "tfm/right_hand_side.hpp"
#include "tfm/step_part.hpp"

namespace polybed::tfm {

/// Restricts the solids' equations to the solids instead of the whole column. They are evaluated below the highest row
/// with solids, and in some rows above it, so that velocities there can adjust to the flow before solids arrive. The
/// choice depends on the state alone, as a restart requires.
class FollowBed : public StepPart {
 public:
  FollowBed(RightHandSide& equations, const StateLayout& layout) : equations_(equations), layout_(layout) {}
  void prepare(std::span<const double> y) override;

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
};

/// A compressible fluid: its pressure at the start, and the account for its mass.
class CompressibleFluid : public StepPart {
 public:
  CompressibleFluid(RightHandSide& equations, const StateLayout& layout, core::Timers& timers)
      : equations_(equations), layout_(layout), timers_(timers) {}
  void start(double time, std::span<double> y) override;
  void begin_from_other(double time, std::span<const double> y) override;
  void begin(double time) override;
  void accept(double time, std::span<const double> y) override;
  void write(core::Checkpoint& checkpoint, double time) const override;
  void read(const core::Checkpoint& checkpoint, double time) override;

  /// Inflow and outflow up to a time within the last step, s.
  [[nodiscard]] fluid::MassAccount account(double time) const { return ledger_.at(time); }

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
  core::Timers& timers_;
  fluid::FluidLedger ledger_;
};

/// At a jump of the inlet at a time, s, from `before`, an impulse brings fluxes and velocities to the new value at
/// once, with the operator for the pressure. Ignores a jump below 1e-9 of a velocity scale, m/s. Collective.
/// \param before  the inlet's velocity on the faces where it is given, as a field that is 0 elsewhere, m/s
void project_jump(RightHandSide& equations, const StateLayout& layout, double velocity_scale, double time,
                  const core::FaceField& before, std::span<double> y);

/// For an incompressible fluid: a compressible one receives a jump as sound.
class InletJump : public StepPart {
 public:
  InletJump(RightHandSide& equations, const StateLayout& layout, double velocity_scale)
      : equations_(equations), layout_(layout), velocity_scale_(velocity_scale) {}
  void restart(double time, std::span<double> y) override;

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
  double velocity_scale_;
};

/// Ends a run if the bed exceeds its maximum packing.
class PackingCheck : public StepPart {
 public:
  PackingCheck(const Constants& constants, const StateLayout& layout, const StressEffect* stress)
      : constants_(constants), layout_(layout), stress_(stress) {}
  void accept(double time, std::span<const double> y) override {
    if (!permissive_) require_packing(constants_, layout_, y, time, stress_);
  }
  /// Accept steps beyond maximum packing; otherwise throw.
  void go_on_above_packing(bool go_on) { permissive_ = go_on; }

 private:
  const Constants& constants_;
  const StateLayout& layout_;
  const StressEffect* stress_;
  bool permissive_ = false;
};

/// The fallback to first-order fluxes, if the solids have limited ones.
class FirstOrder : public StepPart {
 public:
  /// \param atol_fraction  absolute tolerance of the fractions in the time integration
  FirstOrder(RightHandSide& equations, const StateLayout& layout, double atol_fraction)
      : equations_(equations),
        layout_(layout),
        fallback_(equations.constants(), equations.boundaries(), atol_fraction) {}
  void end_step(std::span<const double> y) override;
  void begin_from_other(double time, std::span<const double> y) override;
  void count(Work& work) const override { work.first_order_cells = fallback_.count(); }
  void write(core::Checkpoint& checkpoint, double time) const override;
  void read(const core::Checkpoint& checkpoint, double time) override;

 private:
  void use();

  RightHandSide& equations_;
  const StateLayout& layout_;
  FirstOrderFallback fallback_;
};

}  // namespace polybed::tfm
