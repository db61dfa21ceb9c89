// What takes part in the steps of a model where its scene has it.
#pragma once

#include "core/timers.hpp"
#include "fluid/fluid_mass.hpp"
#include "tfm/first_order_fallback.hpp"
#include "tfm/packing_limit.hpp"
#include "tfm/right_hand_side.hpp"
#include "tfm/step_part.hpp"

namespace polybed::tfm {

/// The solids' equations where the solids are, not in the whole column.
/// They are evaluated below the highest row that contains solids, and in some rows above, where their velocities have
/// time to become those of the flow before solids arrive. It depends on the state alone, as a restart needs.
class FollowBed : public StepPart {
 public:
  FollowBed(RightHandSide& equations, const StateLayout& layout) : equations_(equations), layout_(layout) {}
  void prepare(std::span<const double> y) override;

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
};

/// A compressible fluid: its pressure at the start, and the account of its mass.
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

  /// What has flowed in and out by a time within the last step, s.
  [[nodiscard]] fluid::MassAccount account(double time) const { return ledger_.at(time); }

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
  core::Timers& timers_;
  fluid::FluidLedger ledger_;
};

/// Where the inlet jumps at a time, s, from `before`, an impulse brings fluxes and velocities to the new value at once,
/// with the operator that the pressure uses. Nothing happens to a jump below 1e-9 of a velocity scale, m/s. Collective.
/// \param before  the inlet's velocity on the faces where it is given, of a field that is 0 elsewhere, m/s
void project_jump(RightHandSide& equations, const StateLayout& layout, double velocity_scale, double time,
                  const core::FaceField& before, std::span<double> y);

/// Of an incompressible fluid: one that is compressible learns of a jump by sound.
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

/// A bed that is denser than its solids can be ends the run.
class PackingCheck : public StepPart {
 public:
  PackingCheck(const Constants& constants, const StateLayout& layout, const StressEffect* stress)
      : constants_(constants), layout_(layout), stress_(stress) {}
  void accept(double time, std::span<const double> y) override {
    if (!permissive_) require_packing(constants_, layout_, y, time, stress_);
  }
  /// Whether steps that leave solids far above their packing are taken.
  void go_on_above_packing(bool go_on) { permissive_ = go_on; }

 private:
  const Constants& constants_;
  const StateLayout& layout_;
  const StressEffect* stress_;
  bool permissive_ = false;
};

/// The fallback to fluxes of first order, where those of the solids are limited ones.
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
