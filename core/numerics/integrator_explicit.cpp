// Explicit Runge-Kutta with error control, or an additive pair whose one method is implicit, from ARKODE.
#include <arkode/arkode_arkstep.h>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.hpp"
#include "core/numerics/integrator.hpp"
#include "core/numerics/integrator_sundials.hpp"
#include "core/numerics/integrator_vector.hpp"

namespace polybed::core {

namespace {

class ExplicitIntegrator : public Integrator {
 public:
  /// \param split  the same problem if a part of it is implicit; else null
  ExplicitIntegrator(OdeProblem& problem, SplitProblem* split, ExplicitOptions options)
      : problem_(problem),
        split_(split),
        options_(std::move(options)),
        y_(options_.atol.size(), options_.ranks.get(), context_),
        atol_(options_.atol.size(), options_.ranks.get(), context_),
        error_(options_.atol.size(), options_.ranks.get(), context_),
        weight_(options_.atol.size(), options_.ranks.get(), context_) {
    atol_.assign(options_.atol);
  }
  ~ExplicitIntegrator() override {
    close();
    if (solver_ != nullptr) SUNNonlinSolFreeEmpty(solver_);
  }

  void restart(double t, std::span<const double> y, std::span<const double>, double h0) override {
    y_.assign(y);
    open(t, h0);
  }

  StepReport step(double t_stop) override {
    hold();
    for (double shrink = 1;; shrink *= 0.25) {
      if (shrink < 1) retry(shrink);
      require_success(ARKStepSetStopTime(memory_, t_stop), "ARKStepSetStopTime");
      double t = time_;
      const int flag = ARKStepEvolve(memory_, t_stop, y_, &t, ARK_ONE_STEP);
      if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
      if (flag >= 0) {
        // The library accepts steps that are too short to make progress or are lost in the round-off of time.
        constexpr double least_step = 1e-18;  // s
        if (t <= time_ || (t - time_ < least_step && t < t_stop))
          throw NumericsError(
              fmt::format("t = {:.9g} s: the {} integrator stands still, its steps have shrunk to {:.3g} s", time_,
                          name(), t - time_));
        return report(t);
      }
      // ARKODE does not retry a refused explicit stage; a fresh start with a shorter step does.
      const bool refused =
          flag == ARK_UNREC_RHSFUNC_ERR || flag == ARK_FIRST_RHSFUNC_ERR || flag == ARK_REPTD_RHSFUNC_ERR;
      constexpr double least_shrink = 1e-9;
      if (!refused || shrink < least_shrink)
        throw NumericsError(fmt::format("t = {:.9g} s: the {} integrator cannot go on ({}), last step {:.3g} s", time_,
                                        name(), flag_name(ARKStepGetReturnFlagName, flag), last_step_));
    }
  }

  void interpolate(double t, std::span<double> y) const override {
    require_success(ARKStepGetDky(memory_, t, 0, error_), "ARKStepGetDky");
    std::copy(error_.span().begin(), error_.span().end(), y.begin());
  }
  [[nodiscard]] std::span<const double> state() const override { return y_.span(); }
  [[nodiscard]] std::span<const double> derivative() const override { return {}; }
  [[nodiscard]] IntegratorStatistics statistics() const override {
    IntegratorStatistics s = closed_;
    s.error_failures += failures();
    return s;
  }

  [[nodiscard]] std::size_t workspace() const override {
    long reals = 0, integers = 0;
    if (memory_ != nullptr) require_success(ARKStepGetWorkSpace(memory_, &reals, &integers), "ARKStepGetWorkSpace");
    return (std::size_t(reals) + own_vectors * atol_.span().size() + kept_rates_.size()) * sizeof(double);
  }

 private:
  [[nodiscard]] const char* name() const { return split_ == nullptr ? "explicit" : "imex"; }
  static int callback(double t, N_Vector y, N_Vector dydt, void* self) {
    auto& me = *static_cast<ExplicitIntegrator*>(self);
    return guarded(me.kept_, [&] {
      if (me.split_ == nullptr) return me.problem_.rates(t, entries(y), entries(dydt));
      const Rate rate = me.whole_rates(t, entries(y), entries(dydt));
      if (rate == Rate::ok) me.split_->add_fast(-1, entries(y), entries(dydt));
      return rate;
    });
  }

  /// The rates without the split. They are already known where a step begins.
  Rate whole_rates(double t, std::span<const double> y, std::span<double> dydt) {
    const std::span<const double> begin = y_.span();
    if (t != time_ || kept_rates_.empty() || !std::equal(y.begin(), y.end(), begin.begin()))
      return problem_.rates(t, y, dydt);
    std::copy(kept_rates_.begin(), kept_rates_.end(), dydt.begin());
    return Rate::ok;
  }

  /// Takes the coefficients of the fast part for a step that begins at the present state.
  void hold() {
    if (split_ == nullptr) return;
    kept_rates_.resize(y_.span().size());
    if (problem_.rates(time_, y_.span(), kept_rates_) != Rate::ok)
      throw NumericsError(fmt::format("t = {:.9g} s: the state has no rates", time_));
    split_->hold();
    longest_step_ = split_->longest_step();
  }

  static int fast_callback(double, N_Vector y, N_Vector dydt, void* self) {
    auto& me = *static_cast<ExplicitIntegrator*>(self);
    return guarded(me.kept_, [&] {
      std::fill(entries(dydt).begin(), entries(dydt).end(), 0.0);
      me.split_->add_fast(1, entries(y), entries(dydt));
      return Rate::ok;
    });
  }

  /// The library uses half of the stated step.
  static int longest_step(N_Vector, double, double* stated, void* self) {
    constexpr double share_taken = 0.5;
    *stated = static_cast<ExplicitIntegrator*>(self)->longest_step_ / share_taken;
    return 0;
  }

  /// A stage z = p + c, c = gamma A z + s, solved for the correction c at once: c - gamma A c = s + gamma A p.
  static int solve_stage(SUNNonlinearSolver solver, N_Vector predicted, N_Vector correction, N_Vector, double, int,
                         void*) {
    auto& me = *static_cast<ExplicitIntegrator*>(solver->content);
    return guarded(me.kept_, [&] {
      double t = 0, gamma = 0;
      N_Vector p = nullptr, z = nullptr, rates = nullptr, known = nullptr;
      void* user = nullptr;
      require_success(ARKStepGetNonlinearSystemData(me.memory_, &t, &p, &z, &rates, &gamma, &known, &user),
                      "ARKStepGetNonlinearSystemData");
      const std::span<double> c = entries(correction);
      std::copy(entries(known).begin(), entries(known).end(), c.begin());
      me.split_->add_fast(gamma, entries(predicted), c);
      me.split_->solve_fast(gamma, c);
      return Rate::ok;
    });
  }

  static int weigh(N_Vector y, N_Vector weight, void* self) {
    auto& me = *static_cast<ExplicitIntegrator*>(self);
    return guarded(me.kept_, [&] {
      weigh_errors(me.options_.rtol, me.options_.atol_at, entries(y), {}, entries(weight));
      return Rate::ok;
    });
  }

  void open(double t, double h0) {
    close();
    time_ = t;
    kept_rates_.clear();
    memory_ = ARKStepCreate(callback, split_ != nullptr ? fast_callback : nullptr, t, y_, context_);
    if (memory_ == nullptr) throw NumericsError("ARKStepCreate failed");
    require_success(ARKStepSetErrHandlerFn(memory_, keep_silent, nullptr), "ARKStepSetErrHandlerFn");
    require_success(ARKStepSetUserData(memory_, this), "ARKStepSetUserData");
    if (split_ != nullptr)
      set_split();
    else
      require_success(ARKStepSetTableNum(memory_, ARKODE_DIRK_NONE, ARKODE_BOGACKI_SHAMPINE_4_2_3),
                      "ARKStepSetTableNum");
    if (options_.atol_at)
      require_success(ARKStepWFtolerances(memory_, weigh), "ARKStepWFtolerances");
    else
      require_success(ARKStepSVtolerances(memory_, options_.rtol, atol_), "ARKStepSVtolerances");
    // Gustafsson's controller for explicit methods. Where stability limits the step, the default one exceeds the limit
    // again and again (a settled bed in water: 297 of 2006 tries rejected, with this one 29 of 1744).
    require_success(ARKStepSetAdaptivityMethod(memory_, ARK_ADAPT_EXP_GUS, 1, 0, nullptr),
                    "ARKStepSetAdaptivityMethod");
    if (options_.fixed_step > 0)
      require_success(ARKStepSetFixedStep(memory_, options_.fixed_step), "ARKStepSetFixedStep");
    else if (h0 > 0)
      require_success(ARKStepSetInitStep(memory_, h0), "ARKStepSetInitStep");
  }

  /// Sets the pair of methods and the problem's own solver for the implicit one. It is exact: nothing is iterated, and
  /// the rates follow from the solution.
  void set_split() {
    require_success(ARKStepSetTableNum(memory_, ARKODE_ARK324L2SA_DIRK_4_2_3, ARKODE_ARK324L2SA_ERK_4_2_3),
                    "ARKStepSetTableNum");
    if (solver_ == nullptr) {
      solver_ = SUNNonlinSolNewEmpty(context_);
      if (solver_ == nullptr) throw NumericsError("SUNNonlinSolNewEmpty failed");
      solver_->content = this;
      solver_->ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_FIXEDPOINT; };
      solver_->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) { return 0; };
      solver_->ops->solve = solve_stage;
    }
    require_success(ARKStepSetNonlinearSolver(memory_, solver_), "ARKStepSetNonlinearSolver");
    // A new step length costs nothing here, so no range of lengths keeps the present one.
    require_success(ARKStepSetFixedStepBounds(memory_, 1.0, 1.0), "ARKStepSetFixedStepBounds");
    require_success(ARKStepSetDeduceImplicitRhs(memory_, 1), "ARKStepSetDeduceImplicitRhs");
    require_success(ARKStepSetStabilityFn(memory_, longest_step, this), "ARKStepSetStabilityFn");
  }

  void close() {
    if (memory_ == nullptr) return;
    closed_.error_failures += failures();
    ARKStepFree(&memory_);
  }

  void retry(double shrink) {
    ++closed_.recoverable_failures;
    const double tried = last_step_ > 0 ? last_step_ : 1e-6;
    open(time_, tried * shrink);
  }

  [[nodiscard]] std::uint64_t failures() const {
    long count = 0;
    if (memory_ != nullptr) ARKStepGetNumErrTestFails(memory_, &count);
    return std::uint64_t(count);
  }

  StepReport report(double t) {
    StepReport r;
    r.time = time_ = t;
    r.order = 3;
    ARKStepGetLastStep(memory_, &r.step);
    ARKStepGetCurrentStep(memory_, &r.next_step);
    last_step_ = r.step;
    ++closed_.steps;
    if (options_.fixed_step > 0) return r;
    require_success(ARKStepGetEstLocalErrors(memory_, error_), "ARKStepGetEstLocalErrors");
    require_success(ARKStepGetErrWeights(memory_, weight_), "ARKStepGetErrWeights");
    report_error(error_.span(), weight_.span(), options_.ranks.get(), r);
    return r;
  }

  OdeProblem& problem_;
  SplitProblem* split_;  ///< null: everything is explicit
  ExplicitOptions options_;
  Context context_;
  Vector y_, atol_, error_, weight_;
  static constexpr std::size_t own_vectors = 5;  // these and the tolerances of the options
  void* memory_ = nullptr;
  SUNNonlinearSolver solver_ = nullptr;  ///< for the split; it owns nothing
  std::vector<double> kept_rates_;       ///< for the split: the complete rates where the step begins
  double longest_step_ = 0;
  double time_ = 0, last_step_ = 0;
  IntegratorStatistics closed_;  ///< sums over memories that restarts closed, and all steps
  std::exception_ptr kept_;
};

}  // namespace

std::unique_ptr<Integrator> make_explicit(OdeProblem& problem, ExplicitOptions options) {
  return std::make_unique<ExplicitIntegrator>(problem, nullptr, std::move(options));
}

std::unique_ptr<Integrator> make_split(SplitProblem& problem, ExplicitOptions options) {
  return std::make_unique<ExplicitIntegrator>(problem, &problem, std::move(options));
}

}  // namespace polybed::core
