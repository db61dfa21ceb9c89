// Slot Exchange, fluid with solids: the drag on every species, by any law of the menu, one closure pass per cell.
#pragma once

#include "closures/drag.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// b_j = 18 mu eps f_j / D_j^2, T(1.49), with f_j from the polydisperse law at the cell's voidage,
/// composition and the superficial slip of species j.
class Drag : public FluidExchange {
 public:
  /// \param divisors  of the drag on each species by the slip of a gas; 1 without it
  Drag(const Constants& constants, const fluid::Boundaries& boundaries, const std::string& name,
       const closures::DragLaw& law, std::vector<double> divisors);
  void evaluate(Fields& fields) override;
  [[nodiscard]] ClosureUse use() const override;

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  std::string name_;
  closures::DragLaw law_;
  closures::GuardCount count_;
  std::vector<double> divisors_;
  std::vector<const double*> share_, slip_;
  std::vector<double*> result_;
};

}  // namespace polybed::tfm
