// The model of a compressible fluid as ordinary differential equations: the pressure is one of the unknowns.
#pragma once

#include <cstdint>

#include "core/error.hpp"
#include "core/numerics/integrator.hpp"
#include "tfm/pressure_coupling.hpp"
#include "tfm/right_hand_side.hpp"

namespace polybed::tfm {

[[noreturn]] inline void refuse_compressible_start() {
  throw core::NumericsError(
      "the state at the start has no rates: check the bed's solids fraction, densities, fluid.outlet_pressure and the "
      "velocities of inlet and jets");
}

class CompressibleProblem : public core::OdeProblem {
 public:
  CompressibleProblem(RightHandSide& equations, const StateLayout& layout) : equations_(equations), layout_(layout) {}

  core::Rate rates(double t, std::span<const double> y, std::span<double> dydt) override {
    ++evaluations_;
    if (!equations_.evaluate(t, layout_, y)) return core::Rate::recoverable;
    subtract_pressure_gradient(equations_.constants(), equations_.boundaries(), equations_.fields());
    pack_rates(layout_, equations_.fields(), dydt);
    return core::Rate::ok;
  }

  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  RightHandSide& equations_;
  const StateLayout& layout_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace polybed::tfm
