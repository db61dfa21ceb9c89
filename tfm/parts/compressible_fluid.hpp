// A compressible fluid: its pressure at the start, and the account of its mass.
#pragma once

#include "core/timers.hpp"
#include "fluid/fluid_mass.hpp"
#include "tfm/right_hand_side.hpp"
#include "tfm/step_part.hpp"

namespace polybed::tfm {

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

}  // namespace polybed::tfm
