#include "tfm/implicit_problem.hpp"

#include "core/numerics/operators.hpp"

namespace polybed::tfm {

using Kind = StateLayout::Entry::Kind;

ImplicitProblem::ImplicitProblem(RightHandSide& equations, const StateLayout& layout, core::Timers& timers)
    : equations_(equations),
      layout_(layout),
      timers_(timers),
      preconditioner_(equations.constants(), equations.boundaries()),
      divergence_(core::make_field(equations.constants().grid)) {}

core::Rate ImplicitProblem::residual(double t, std::span<const double> y, std::span<const double> dydt,
                                     std::span<double> r) {
  ++residuals_;
  if (!equations_.evaluate(t, layout_, y)) return core::Rate::recoverable;
  const auto scope = timers_.scope("residual");
  Fields& fields = equations_.fields();
  core::divergence(equations_.constants().grid, fields.fluid.flux, divergence_);
  subtract_pressure_gradient(equations_.constants(), equations_.boundaries(), fields);
  pack_rates(layout_, fields, r);
  for (const StateLayout::Entry& entry : layout_.entries()) {
    if (entry.kind == Kind::pressure)
      pack_continuity(entry, dydt, r);
    else
      for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n) r[n] = dydt[n] - r[n];
  }
  return core::Rate::ok;
}

/// Row (5): div J = 0, or kappa (dp/dt minus its rate) = 0.
void ImplicitProblem::pack_continuity(const StateLayout::Entry& entry, std::span<const double> dydt,
                                      std::span<double> r) {
  const fluid::Compression& own = equations_.fields().fluid.compression;
  if (own.present()) {
    layout_.unpack(entry, dydt, divergence_);
    core::for_each_row(equations_.constants().grid, [&](core::Index begin, core::Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        divergence_[c] = own.kappa[c] * (divergence_[c] - own.pressure_rate[c]);
    });
  }
  layout_.pack(entry, divergence_, r);
}

core::Rate ImplicitProblem::setup(double t, std::span<const double> y, std::span<const double>, std::span<const double>,
                                  double cj) {
  if (!equations_.evaluate(t, layout_, y)) return core::Rate::recoverable;
  const auto scope = timers_.scope("preconditioner set-up");
  return preconditioner_.setup(equations_.fields(), cj) ? core::Rate::ok : core::Rate::recoverable;
}

core::Rate ImplicitProblem::precondition(double, std::span<const double> r, std::span<double> z, double, double) {
  const auto scope = timers_.scope("preconditioner");
  preconditioner_.apply(layout_, r, z);
  return core::Rate::ok;
}

}  // namespace polybed::tfm
