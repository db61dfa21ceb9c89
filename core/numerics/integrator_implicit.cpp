// Backward differences with Newton and GMRES, from IDA.
#include <fmt/format.h>
#include <ida/ida.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "core/error.hpp"
#include "core/numerics/integrator.hpp"
#include "core/numerics/integrator_sundials.hpp"
#include "core/numerics/integrator_vector.hpp"

namespace polybed::core {

namespace {

class ImplicitIntegrator : public Integrator {
 public:
  ImplicitIntegrator(DaeProblem& problem, ImplicitOptions options)
      : problem_(problem),
        options_(std::move(options)),
        y_(options_.atol.size(), options_.ranks.get(), context_),
        dydt_(options_.atol.size(), options_.ranks.get(), context_),
        atol_(options_.atol.size(), options_.ranks.get(), context_),
        id_(options_.atol.size(), options_.ranks.get(), context_),
        error_(options_.atol.size(), options_.ranks.get(), context_),
        weight_(options_.atol.size(), options_.ranks.get(), context_) {
    atol_.assign(options_.atol);
    id_.assign(options_.id);
  }
  ~ImplicitIntegrator() override { close(); }

  void restart(double t, std::span<const double> y, std::span<const double> dydt, double h0) override {
    start_.assign(y.begin(), y.end());
    start_rates_.assign(dydt.begin(), dydt.end());
    open(t, h0);
  }

  StepReport step(double t_stop) override {
    const double stop = t_stop - origin_;
    double t = since_origin_;
    const long failed = newton_failures();
    let_steps_grow();
    int flag = try_step(stop, t);
    // Fast relaxation rates carry the round-off of their velocities, so the first guess after a long step is far off.
    // The library gives up after ten error test failures; its own first step is short enough.
    if ((flag == IDA_ERR_FAIL || flag == IDA_CONV_FAIL) && since_origin_ == 0 && first_step_ > 0) {
      open(origin_, 0);
      flag = try_step(stop, t);
    }
    if (flag < 0)
      throw NumericsError(fmt::format("t = {:.9g} s: the implicit integrator cannot go on ({}), last step {:.3g} s",
                                      time_, flag_name(IDAGetReturnFlagName, flag), last_step_));
    // The library accepts steps that are lost in the round-off of time.
    if (t <= since_origin_)
      throw NumericsError(fmt::format(
          "t = {:.9g} s: the implicit integrator stands still, its steps have shrunk to {:.3g} s", time_, last_step_));
    StepReport r;
    since_origin_ = t;
    r.time = time_ = t == stop ? t_stop : origin_ + t;
    IDAGetLastStep(memory_, &r.step);
    IDAGetCurrentStep(memory_, &r.next_step);
    IDAGetLastOrder(memory_, &r.order);
    hold_steps(r.step, newton_failures() - failed);
    last_step_ = r.step;
    ++closed_.steps;
    require_success(IDAGetEstLocalErrors(memory_, error_), "IDAGetEstLocalErrors");
    require_success(IDAGetErrWeights(memory_, weight_), "IDAGetErrWeights");
    const auto error = error_.span(), id = id_.span();
    for (std::size_t n = 0; n < error.size(); ++n) error[n] *= id[n];
    report_error(error, weight_.span(), options_.ranks.get(), r);
    return r;
  }

  void interpolate(double t, std::span<double> y) const override {
    const double at = t == time_ ? since_origin_ : std::clamp(t - origin_, since_origin_ - last_step_, since_origin_);
    require_success(IDAGetDky(memory_, at, 0, error_), "IDAGetDky");
    std::copy(error_.span().begin(), error_.span().end(), y.begin());
  }
  [[nodiscard]] std::span<const double> state() const override { return y_.span(); }
  [[nodiscard]] std::span<const double> derivative() const override { return dydt_.span(); }

  [[nodiscard]] IntegratorStatistics statistics() const override {
    IntegratorStatistics s = closed_;
    if (memory_ != nullptr) add_counts(s);
    return s;
  }

  [[nodiscard]] std::size_t workspace() const override {
    long reals = 0, integers = 0;
    if (memory_ != nullptr) require_success(IDAGetWorkSpace(memory_, &reals, &integers), "IDAGetWorkSpace");
    return (std::size_t(reals) + own_vectors * atol_.span().size()) * sizeof(double);
  }

 private:
  static ImplicitIntegrator& me(void* self) { return *static_cast<ImplicitIntegrator*>(self); }
  static int residual(double t, N_Vector y, N_Vector dydt, N_Vector r, void* self) {
    return guarded(me(self).kept_, [&] {
      return me(self).problem_.residual(me(self).origin_ + t, entries(y), entries(dydt), entries(r));
    });
  }
  static int weigh(N_Vector y, N_Vector weight, void* self) {
    return guarded(me(self).kept_, [&] {
      const ImplicitOptions& options = me(self).options_;
      weigh_errors(options.rtol, options.atol_at, entries(y), me(self).dydt_.span(), entries(weight));
      return Rate::ok;
    });
  }
  static int setup(double t, N_Vector y, N_Vector dydt, N_Vector residual, double cj, void* self) {
    return guarded(me(self).kept_, [&] { return me(self).make_preconditioner(t, y, dydt, residual, cj); });
  }
  static int precondition(double t, N_Vector y, N_Vector dydt, N_Vector residual, N_Vector r, N_Vector z, double cj,
                          double delta, void* self) {
    ImplicitIntegrator& own = me(self);
    return guarded(own.kept_, [&] {
      if (own.has_aged()) {
        ++own.closed_.preconditioner_setups;
        if (const Rate made = own.make_preconditioner(t, y, dydt, residual, cj); made != Rate::ok) return made;
      }
      return own.problem_.precondition(own.origin_ + t, entries(r), entries(z), cj, delta);
    });
  }

  Rate make_preconditioner(double t, N_Vector y, N_Vector dydt, N_Vector residual, double cj) {
    IDAGetNumLinIters(memory_, &iterations_);
    fewest_ = excess_ = 0;
    return problem_.setup(origin_ + t, entries(y), entries(dydt), entries(residual), cj);
  }

  /// Counts the iterations of the last solve and returns whether a new preconditioner pays. The library requests one
  /// only when the step length changes; with equal steps it ages. Returns true only at the first application in a
  /// solve, since the preconditioner must not change within one.
  bool has_aged() {
    long iterations = 0;
    IDAGetNumLinIters(memory_, &iterations);
    const long last = iterations - std::exchange(iterations_, iterations);
    if (last == 0) return false;  // within a solve
    fewest_ = fewest_ == 0 ? last : std::min(fewest_, last);
    excess_ += last - fewest_;
    constexpr long price = 3;  // of a new one, in iterations: 2.6 measured in a gas bed
    return excess_ > price;
  }

  [[nodiscard]] long newton_failures() const {
    long failures = 0;
    IDAGetNumNonlinSolvConvFails(memory_, &failures);
    return failures;
  }

  /// The library doubles steps with small errors until Newton's method fails, takes a quarter, and doubles again, which
  /// wastes most of the work. After a failure on a step longer than the last, no step exceeds that one for a while,
  /// which doubles with each such failure. Steps are equal meanwhile; otherwise the order would stay 1.
  /// \param failures  of Newton's method in this step, each of which quarters it
  void hold_steps(double step, long failures) {
    constexpr long least = 25, most = 400;  // steps
    if (held_ > 0) --held_;
    if (failures > 0 && last_step_ > 0 && std::ldexp(step, 2 * int(failures)) > 1.5 * last_step_) {
      longest_ = last_step_;
      holds_ = std::clamp(2 * holds_, least, most);
      held_ = holds_;
    } else if (step > 1.5 * longest_) {
      holds_ = 0;
    }
  }

  /// Called at the end of the next step.
  void let_steps_grow() {
    double step = 0;
    IDAGetCurrentStep(memory_, &step);
    constexpr double by_doubling = 2, never = 1e9;  // required of the error test, times this step
    const bool free = held_ == 0 || 2 * step <= 1.01 * longest_;
    require_success(IDASetEtaFixedStepBounds(memory_, 1, free ? by_doubling : never), "IDASetEtaFixedStepBounds");
  }

  /// If the residual cannot be computed at y + sigma v, the library accepts the present solution, often 0, and so the
  /// guess of the step. Report a failure that shortens the step, as other failures do.
  static int solve(SUNLinearSolver solver, SUNMatrix none, N_Vector x, N_Vector b, sunrealtype tolerance) {
    const int flag = SUNLinSolSolve_SPGMR(solver, none, x, b, tolerance);
    return flag == SUNLS_ATIMES_FAIL_REC ? SUNLS_CONV_FAIL : flag;
  }

  void open(double t, double h0) {
    close();
    y_.assign(start_);
    dydt_.assign(start_rates_);
    first_step_ = h0;
    last_step_ = longest_ = 0;
    held_ = holds_ = 0;
    time_ = origin_ = t;
    since_origin_ = 0;
    memory_ = IDACreate(context_);
    if (memory_ == nullptr) throw NumericsError("IDACreate failed");
    require_success(IDAInit(memory_, residual, 0.0, y_, dydt_), "IDAInit");
    require_success(IDASetErrHandlerFn(memory_, keep_silent, nullptr), "IDASetErrHandlerFn");
    require_success(IDASetUserData(memory_, this), "IDASetUserData");
    if (options_.atol_at)
      require_success(IDAWFtolerances(memory_, weigh), "IDAWFtolerances");
    else
      require_success(IDASVtolerances(memory_, options_.rtol, atol_), "IDASVtolerances");
    require_success(IDASetMaxOrd(memory_, options_.max_order), "IDASetMaxOrd");
    require_success(IDASetId(memory_, id_), "IDASetId");
    require_success(IDASetSuppressAlg(memory_, SUNTRUE), "IDASetSuppressAlg");
    if (h0 > 0) require_success(IDASetInitStep(memory_, h0), "IDASetInitStep");
    solver_ = SUNLinSol_SPGMR(y_, SUN_PREC_LEFT, options_.krylov_vectors, context_);
    solver_->ops->solve = solve;
    require_success(IDASetLinearSolver(memory_, solver_, nullptr), "IDASetLinearSolver");
    require_success(IDASetPreconditioner(memory_, setup, precondition), "IDASetPreconditioner");
    require_success(IDASetEpsLin(memory_, options_.linear_tolerance), "IDASetEpsLin");
  }

  int try_step(double stop, double& t) {
    require_success(IDASetStopTime(memory_, stop), "IDASetStopTime");
    const int flag = IDASolve(memory_, stop, &t, y_, dydt_, IDA_ONE_STEP);
    if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
    return flag;
  }

  void add_counts(IntegratorStatistics& s) const {
    const auto add = [&](std::uint64_t& sum, int (*get)(void*, long*)) {
      long count = 0;
      get(memory_, &count);
      sum += std::uint64_t(count);
    };
    add(s.error_failures, IDAGetNumErrTestFails);
    add(s.newton_iterations, IDAGetNumNonlinSolvIters);
    add(s.newton_failures, IDAGetNumNonlinSolvConvFails);
    add(s.linear_iterations, IDAGetNumLinIters);
    add(s.preconditioner_setups, IDAGetNumPrecEvals);
  }

  void close() {
    if (memory_ == nullptr) return;
    add_counts(closed_);
    IDAFree(&memory_);
    SUNLinSolFree(solver_);
  }

  DaeProblem& problem_;
  ImplicitOptions options_;
  Context context_;
  Vector y_, dydt_, atol_, id_, error_, weight_;
  std::vector<double> start_, start_rates_;       ///< of the last restart
  static constexpr std::size_t own_vectors = 10;  // these, and two of the options
  void* memory_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  // The library counts time from the last restart: a first step must not be lost in the round-off of a late time.
  double origin_ = 0, since_origin_ = 0, time_ = 0, last_step_ = 0, first_step_ = 0;
  long iterations_ = 0, fewest_ = 0, excess_ = 0;  ///< of the linear solves since the preconditioner was made
  double longest_ = 0;                             ///< limit of a step while steps are held, s
  long held_ = 0, holds_ = 0;                      ///< steps for which they are held, now and after the last failure
  IntegratorStatistics closed_;
  std::exception_ptr kept_;
};

}  // namespace

std::unique_ptr<Integrator> make_implicit(DaeProblem& problem, ImplicitOptions options) {
  return std::make_unique<ImplicitIntegrator>(problem, std::move(options));
}

}  // namespace polybed::core
