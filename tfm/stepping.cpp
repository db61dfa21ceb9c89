#include "tfm/stepping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "tfm/compressible_problem.hpp"
#include "tfm/explicit_problem.hpp"
#include "tfm/implicit_problem.hpp"

namespace polybed::tfm {

std::vector<TimeScale> Stepping::time_scales() const {
  const FluidStress* stress = equations_.effects().fluid_stress.get();
  return tfm::time_scales(equations_.constants(), equations_.fields(), stress ? stress->kinematic_viscosity() : 0,
                          split_);
}

void Stepping::count(Work& work) const {
  const core::IntegratorStatistics s = integrator_->statistics();
  work.steps += s.steps;
  work.rejected_steps += s.error_failures;
  work.newton_iterations += s.newton_iterations;
  work.krylov_iterations += s.linear_iterations;
}

void Stepping::clear_pressure(std::span<double> of) const {
  for (const StateLayout::Entry& entry : layout_.entries())
    if (entry.kind == StateLayout::Entry::Kind::pressure)
      std::fill_n(of.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
}

namespace {

core::ExplicitOptions explicit_options(const RightHandSide& equations, const core::Tfm& options,
                                       Tolerances tolerances) {
  return {tolerances.relative, std::move(tolerances.absolute), options.fixed_step.value_or(0),
          equations.constants().grid.ranks, std::move(tolerances.at)};
}

/// Rates of all unknowns, including the pressure; the unknowns take the inlet's flux, which may have jumped.
void find_rates_with_sound(CompressibleProblem problem, RightHandSide& equations, const StateLayout& layout, double t,
                           std::span<double> y, std::span<double> dydt) {
  if (problem.rates(t, y, dydt) != core::Rate::ok) refuse_compressible_start();
  layout.pack(equations.fields().solids, equations.fields().fluid, y);
}

/// For an incompressible fluid: solves for the pressure; the drag can be implicit.
class ExplicitSteps : public Stepping {
 public:
  ExplicitSteps(RightHandSide& equations, const StateLayout& layout, const core::Tfm& options, Tolerances tolerances,
                core::Timers& timers, bool split)
      : Stepping(equations, layout),
        problem_(equations, layout, options.pressure_tolerance.value_or(std::min(1e-4, 0.1 * options.rtol)), timers,
                 split) {
    split_ = split;
    core::ExplicitOptions made = explicit_options(equations, options, std::move(tolerances));
    integrator_ = split ? core::make_split(problem_, std::move(made)) : core::make_explicit(problem_, std::move(made));
  }
  void begin_step(double length) override { problem_.begin_step(length); }
  void count(Work& work) const override {
    Stepping::count(work);
    work.right_hand_sides += problem_.solves();
    work.pressure_solves += problem_.solves();
    work.pressure_iterations += problem_.iterations();
  }
  void find_rates(double, std::span<double>, std::span<double>) override { problem_.begin(); }

 private:
  ExplicitProblem problem_;
};

/// The pressure of a compressible fluid has a rate.
class SoundSteps : public Stepping {
 public:
  SoundSteps(RightHandSide& equations, const StateLayout& layout, const core::Tfm& options, Tolerances tolerances)
      : Stepping(equations, layout), problem_(equations, layout) {
    integrator_ = core::make_explicit(problem_, explicit_options(equations, options, std::move(tolerances)));
  }
  [[nodiscard]] std::vector<TimeScale> time_scales() const override {
    std::vector<TimeScale> scales = Stepping::time_scales();
    const auto [seconds, cell] = equations_.effects().compressible->sound_time(equations_.fields().fluid);
    scales.push_back({"sound", seconds, cell});
    return scales;
  }
  void count(Work& work) const override {
    Stepping::count(work);
    work.right_hand_sides += problem_.evaluations();
  }
  void find_rates(double t, std::span<double> y, std::span<double> dydt) override {
    find_rates_with_sound({equations_, layout_}, equations_, layout_, t, y, dydt);
  }

 private:
  CompressibleProblem problem_;
};

/// Needs consistent rates and pressure, which one projected right-hand side provides.
class ImplicitSteps : public Stepping {
 public:
  ImplicitSteps(RightHandSide& equations, const StateLayout& layout, Tolerances tolerances, core::Timers& timers)
      : Stepping(equations, layout),
        timers_(timers),
        rtol_(tolerances.relative),
        atol_(tolerances.absolute),
        problem_(equations, layout, timers) {
    core::ImplicitOptions made;
    made.rtol = rtol_;
    made.atol = std::move(tolerances.absolute);
    made.ranks = equations.constants().grid.ranks;
    made.atol_at = std::move(tolerances.at);
    made.id.assign(layout.size(), 1.0);
    // p of a compressible fluid is differential, but left out of the error test: sound without consequences must not
    // set the step.
    using Kind = StateLayout::Entry::Kind;
    for (const StateLayout::Entry& entry : layout.entries())
      if (entry.kind == Kind::pressure || entry.kind == Kind::passed)
        std::fill_n(made.id.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
    integrator_ = core::make_implicit(problem_, std::move(made));
  }
  void count(Work& work) const override {
    Stepping::count(work);
    work.right_hand_sides += problem_.residuals();
  }
  /// Longer than the integrator's own first step, 0.5/|dydt| in the norm of the error test, if the round-off of the
  /// fluxes over that would exceed the tolerance of the pressure: Newton then never converges, and shorter steps are
  /// worse.
  [[nodiscard]] double first_step(std::span<const double> y, std::span<const double> dydt) const override {
    const core::Grid& grid = equations_.constants().grid;
    using Kind = StateLayout::Entry::Kind;
    double of_pressure = 0, of_flux = 0;
    std::vector<double> squares;
    for (const StateLayout::Entry& entry : layout_.entries()) {
      if (entry.kind == Kind::pressure || entry.kind == Kind::passed) {
        if (entry.kind == Kind::pressure) of_pressure = atol_[entry.begin];
        continue;
      }
      if (entry.kind == Kind::flux) of_flux = atol_[entry.begin];
      for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n) {
        const double weighted = dydt[n] / (rtol_ * std::abs(y[n]) + atol_[n]);
        squares.push_back(weighted * weighted);
      }
    }
    const double size = core::sum_of_ranks(grid, double(layout_.size()));
    const double own = 0.5 / std::sqrt(core::sum_of_ranks(grid, squares) / size);
    constexpr double margin = 100;  // a safe distance from round-off that fills the tolerance
    const std::vector<double>& density = equations_.constants().density;
    const double heaviest =
        std::max(equations_.constants().fluid.density, *std::max_element(density.begin(), density.end()));
    const double round_off = std::numeric_limits<double>::epsilon() * heaviest * grid.column_height() * of_flux / rtol_;
    const double least = margin * round_off / of_pressure;
    return own < least ? least : 0;
  }
  /// Solves for the pressure from zero, so that the result depends on the other unknowns alone and a resumed run gives
  /// the same bits.
  void find_rates(double t, std::span<double> y, std::span<double> dydt) override {
    clear_pressure(y);
    // As exact as possible: its residual stops the first steps of a tight tolerance.
    const auto found = [&](double tolerance) {
      return ExplicitProblem(equations_, layout_, tolerance, timers_).rates(t, y, dydt) == core::Rate::ok;
    };
    if (!found(1e-12) && !found(1e-8))
      throw core::NumericsError("the state at the start has no rates: check the bed's solids fraction and densities");
    for (const StateLayout::Entry& entry : layout_.entries())
      if (entry.kind == StateLayout::Entry::Kind::pressure) layout_.pack(entry, equations_.fields().fluid.pressure, y);
  }

 private:
  core::Timers& timers_;
  double rtol_;
  std::vector<double> atol_;
  ImplicitProblem problem_;
};

class ImplicitSoundSteps : public ImplicitSteps {
 public:
  using ImplicitSteps::ImplicitSteps;
  /// The residual of (5) over a small kappa is a rate of the pressure without meaning beyond the first instant. The
  /// first implicit step is of order 1 and uses rates only as its first guess; 0 is the better one.
  void find_rates(double t, std::span<double> y, std::span<double> dydt) override {
    find_rates_with_sound({equations_, layout_}, equations_, layout_, t, y, dydt);
    clear_pressure(dydt);
  }
  /// The pressure has a rate, and its round-off does not grow as steps shrink.
  [[nodiscard]] double first_step(std::span<const double>, std::span<const double>) const override { return 0; }
};

}  // namespace

std::unique_ptr<Stepping> make_stepping(core::TfmIntegrator kind, RightHandSide& equations, const StateLayout& layout,
                                        const core::Tfm& options, Tolerances tolerances, core::Timers& timers) {
  const bool implicit = kind == core::TfmIntegrator::implicit_steps,
             sound = equations.effects().compressible != nullptr;
  if (implicit && sound) return std::make_unique<ImplicitSoundSteps>(equations, layout, std::move(tolerances), timers);
  if (implicit) return std::make_unique<ImplicitSteps>(equations, layout, std::move(tolerances), timers);
  if (sound) return std::make_unique<SoundSteps>(equations, layout, options, std::move(tolerances));
  return std::make_unique<ExplicitSteps>(equations, layout, options, std::move(tolerances), timers,
                                         kind == core::TfmIntegrator::split_steps);
}

}  // namespace polybed::tfm
