// The fallback to fluxes of first order, where those of the solids are limited ones.
#pragma once

#include "tfm/first_order_fallback.hpp"
#include "tfm/right_hand_side.hpp"
#include "tfm/step_part.hpp"

namespace polybed::tfm {

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
