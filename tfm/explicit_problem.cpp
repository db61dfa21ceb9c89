#include "tfm/explicit_problem.hpp"

#include "tfm/step_limits.hpp"

namespace polybed::tfm {

ExplicitProblem::ExplicitProblem(RightHandSide& equations, const StateLayout& layout, double pressure_tolerance,
                                 core::Timers& timers, bool split)
    : equations_(equations),
      layout_(layout),
      timers_(timers),
      pressure_(equations.constants().grid, pressure_tolerance) {
  if (split) fast_.emplace(equations.constants(), equations.boundaries(), layout);
}

void ExplicitProblem::hold() {
  const auto scope = timers_.scope("drag");
  fast_->hold(equations_.fields());
  longest_step_ = longest_split_step(equations_.constants(), equations_.fields());
}

core::Rate ExplicitProblem::rates(double t, std::span<const double> y, std::span<double> dydt) {
  if (!equations_.evaluate(t, layout_, y)) return core::Rate::recoverable;
  Fields& fields = equations_.fields();
  {
    const auto scope = timers_.scope("pressure");
    const core::PoissonResult result =
        pressure_.solve(fields.flux_rate, fields.fluid.flux, correction_rate_, fields.fluid.pressure);
    ++solves_;
    iterations_ += std::uint64_t(result.iterations);
    if (!result.converged) return core::Rate::recoverable;
    subtract_pressure_gradient(equations_.constants(), equations_.boundaries(), fields);
  }
  pack_rates(layout_, fields, dydt);
  return core::Rate::ok;
}

}  // namespace polybed::tfm
