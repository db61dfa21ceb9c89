#include "core/integrator.hpp"

#include <arkode/arkode_arkstep.h>
#include <fmt/format.h>
#include <ida/ida.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/integrator_vector.hpp"

namespace polybed::core {

namespace {

void check(int flag, const char* call) {
  if (flag < 0) throw NumericsError(fmt::format("{} failed with code {}", call, flag));
}

/// A SUNDIALS context: one per integrator, so that there is no global state.
class Context {
 public:
  Context() { check(SUNContext_Create(nullptr, &context_), "SUNContext_Create"); }
  ~Context() { SUNContext_Free(&context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator SUNContext() const { return context_; }

 private:
  SUNContext context_ = nullptr;
};

/// Runs a callback's work; an exception is kept for the caller, as none may cross the C library.
template <class Work>
int guarded(std::exception_ptr& kept, Work&& work) {
  try {
    return work() == Rate::ok ? 0 : 1;
  } catch (...) {
    kept = std::current_exception();
    return -1;
  }
}

/// The library's own messages are not shown: what it returns is turned into ours.
void silent(int, const char*, const char*, char*, void*) {}

/// Weighted local error of the last step; the norm over all ranks, the worst entry of this one.
void report_error(std::span<const double> error, std::span<const double> weight, const Ranks* ranks,
                  StepReport& report) {
  double sum = 0;
  for (std::size_t n = 0; n < error.size(); ++n) {
    const double weighted = std::abs(error[n] * weight[n]);
    sum += weighted * weighted;
    if (weighted > report.worst_error) {
      report.worst_error = weighted;
      report.worst_entry = n;
    }
  }
  std::array<double, 2> sums{sum, double(error.size())};
  add_over_ranks(ranks, sums);
  report.error_norm = std::sqrt(sums[0] / sums[1]);
}

std::string flag_name(char* (*name)(long int), int flag) {
  char* text = name(flag);
  std::string result = text;
  std::free(text);
  return result;
}

class ExplicitIntegrator : public Integrator {
 public:
  ExplicitIntegrator(OdeProblem& problem, ExplicitOptions options)
      : problem_(problem),
        options_(std::move(options)),
        y_(options_.atol.size(), options_.ranks.get(), context_),
        atol_(options_.atol.size(), options_.ranks.get(), context_),
        error_(options_.atol.size(), options_.ranks.get(), context_),
        weight_(options_.atol.size(), options_.ranks.get(), context_) {
    atol_.assign(options_.atol);
  }
  ~ExplicitIntegrator() override { close(); }

  void restart(double t, std::span<const double> y, std::span<const double>, double h0) override {
    y_.assign(y);
    open(t, h0);
  }

  StepReport step(double t_stop) override {
    for (double shrink = 1;; shrink *= 0.25) {
      if (shrink < 1) retry(shrink);
      check(ARKStepSetStopTime(memory_, t_stop), "ARKStepSetStopTime");
      double t = time_;
      const int flag = ARKStepEvolve(memory_, t_stop, y_, &t, ARK_ONE_STEP);
      if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
      if (flag >= 0) return report(t);
      // ARKODE does not retry a refused explicit stage; a fresh start with a shorter step does.
      const bool refused =
          flag == ARK_UNREC_RHSFUNC_ERR || flag == ARK_FIRST_RHSFUNC_ERR || flag == ARK_REPTD_RHSFUNC_ERR;
      constexpr double least_shrink = 1e-9;
      if (!refused || shrink < least_shrink)
        throw NumericsError(fmt::format("t = {:.9g} s: the explicit integrator cannot go on ({}), last step {:.3g} s",
                                        time_, flag_name(ARKStepGetReturnFlagName, flag), last_step_));
    }
  }

  void interpolate(double t, std::span<double> y) const override {
    check(ARKStepGetDky(memory_, t, 0, error_), "ARKStepGetDky");
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
    if (memory_ != nullptr) check(ARKStepGetWorkSpace(memory_, &reals, &integers), "ARKStepGetWorkSpace");
    return (std::size_t(reals) + own_vectors * atol_.span().size()) * sizeof(double);
  }

 private:
  static int callback(double t, N_Vector y, N_Vector dydt, void* self) {
    auto& me = *static_cast<ExplicitIntegrator*>(self);
    return guarded(me.kept_, [&] { return me.problem_.rates(t, entries(y), entries(dydt)); });
  }

  void open(double t, double h0) {
    close();
    time_ = t;
    memory_ = ARKStepCreate(callback, nullptr, t, y_, context_);
    if (memory_ == nullptr) throw NumericsError("ARKStepCreate failed");
    check(ARKStepSetErrHandlerFn(memory_, silent, nullptr), "ARKStepSetErrHandlerFn");
    check(ARKStepSetUserData(memory_, this), "ARKStepSetUserData");
    check(ARKStepSetTableNum(memory_, ARKODE_DIRK_NONE, ARKODE_BOGACKI_SHAMPINE_4_2_3), "ARKStepSetTableNum");
    check(ARKStepSVtolerances(memory_, options_.rtol, atol_), "ARKStepSVtolerances");
    // Gustafsson's controller for explicit methods: where stability, not accuracy, bounds the step, the default one
    // runs into the bound again and again (a settled bed in water: 297 of 2006 tries rejected, with this one 29 of
    // 1744).
    check(ARKStepSetAdaptivityMethod(memory_, ARK_ADAPT_EXP_GUS, 1, 0, nullptr), "ARKStepSetAdaptivityMethod");
    if (options_.fixed_step > 0)
      check(ARKStepSetFixedStep(memory_, options_.fixed_step), "ARKStepSetFixedStep");
    else if (h0 > 0)
      check(ARKStepSetInitStep(memory_, h0), "ARKStepSetInitStep");
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
    check(ARKStepGetEstLocalErrors(memory_, error_), "ARKStepGetEstLocalErrors");
    check(ARKStepGetErrWeights(memory_, weight_), "ARKStepGetErrWeights");
    report_error(error_.span(), weight_.span(), options_.ranks.get(), r);
    return r;
  }

  OdeProblem& problem_;
  ExplicitOptions options_;
  Context context_;
  Vector y_, atol_, error_, weight_;
  static constexpr std::size_t own_vectors = 5;  // these and the tolerances of the options
  void* memory_ = nullptr;
  double time_ = 0, last_step_ = 0;
  IntegratorStatistics closed_;  ///< of memories closed by restarts, and all steps
  std::exception_ptr kept_;
};

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
    close();
    y_.assign(y);
    dydt_.assign(dydt);
    time_ = t;
    memory_ = IDACreate(context_);
    if (memory_ == nullptr) throw NumericsError("IDACreate failed");
    check(IDAInit(memory_, residual, t, y_, dydt_), "IDAInit");
    check(IDASetErrHandlerFn(memory_, silent, nullptr), "IDASetErrHandlerFn");
    check(IDASetUserData(memory_, this), "IDASetUserData");
    check(IDASVtolerances(memory_, options_.rtol, atol_), "IDASVtolerances");
    check(IDASetMaxOrd(memory_, options_.max_order), "IDASetMaxOrd");
    check(IDASetId(memory_, id_), "IDASetId");
    check(IDASetSuppressAlg(memory_, SUNTRUE), "IDASetSuppressAlg");
    if (h0 > 0) check(IDASetInitStep(memory_, h0), "IDASetInitStep");
    solver_ = SUNLinSol_SPGMR(y_, SUN_PREC_LEFT, options_.krylov_vectors, context_);
    check(IDASetLinearSolver(memory_, solver_, nullptr), "IDASetLinearSolver");
    check(IDASetPreconditioner(memory_, setup, precondition), "IDASetPreconditioner");
    check(IDASetEpsLin(memory_, options_.linear_tolerance), "IDASetEpsLin");
  }

  StepReport step(double t_stop) override {
    check(IDASetStopTime(memory_, t_stop), "IDASetStopTime");
    double t = time_;
    const int flag = IDASolve(memory_, t_stop, &t, y_, dydt_, IDA_ONE_STEP);
    if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
    if (flag < 0)
      throw NumericsError(fmt::format("t = {:.9g} s: the implicit integrator cannot go on ({}), last step {:.3g} s",
                                      time_, flag_name(IDAGetReturnFlagName, flag), last_step_));
    // The library goes on with steps that are lost in the round-off of time.
    if (t <= time_)
      throw NumericsError(fmt::format(
          "t = {:.9g} s: the implicit integrator stands still, its steps have shrunk to {:.3g} s", time_, last_step_));
    StepReport r;
    r.time = time_ = t;
    IDAGetLastStep(memory_, &r.step);
    IDAGetCurrentStep(memory_, &r.next_step);
    IDAGetLastOrder(memory_, &r.order);
    last_step_ = r.step;
    ++closed_.steps;
    check(IDAGetEstLocalErrors(memory_, error_), "IDAGetEstLocalErrors");
    check(IDAGetErrWeights(memory_, weight_), "IDAGetErrWeights");
    const auto error = error_.span(), id = id_.span();
    for (std::size_t n = 0; n < error.size(); ++n) error[n] *= id[n];
    report_error(error, weight_.span(), options_.ranks.get(), r);
    return r;
  }

  void interpolate(double t, std::span<double> y) const override {
    check(IDAGetDky(memory_, t, 0, error_), "IDAGetDky");
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
    if (memory_ != nullptr) check(IDAGetWorkSpace(memory_, &reals, &integers), "IDAGetWorkSpace");
    return (std::size_t(reals) + own_vectors * atol_.span().size()) * sizeof(double);
  }

 private:
  static ImplicitIntegrator& me(void* self) { return *static_cast<ImplicitIntegrator*>(self); }
  static int residual(double t, N_Vector y, N_Vector dydt, N_Vector r, void* self) {
    return guarded(me(self).kept_,
                   [&] { return me(self).problem_.residual(t, entries(y), entries(dydt), entries(r)); });
  }
  static int setup(double t, N_Vector y, N_Vector dydt, N_Vector r, double cj, void* self) {
    return guarded(me(self).kept_,
                   [&] { return me(self).problem_.setup(t, entries(y), entries(dydt), entries(r), cj); });
  }
  static int precondition(double t, N_Vector, N_Vector, N_Vector, N_Vector r, N_Vector z, double cj, double delta,
                          void* self) {
    return guarded(me(self).kept_,
                   [&] { return me(self).problem_.precondition(t, entries(r), entries(z), cj, delta); });
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
  static constexpr std::size_t own_vectors = 8;  // these, and two of the options
  void* memory_ = nullptr;
  SUNLinearSolver solver_ = nullptr;
  double time_ = 0, last_step_ = 0;
  IntegratorStatistics closed_;
  std::exception_ptr kept_;
};

}  // namespace

std::unique_ptr<Integrator> make_explicit(OdeProblem& problem, ExplicitOptions options) {
  return std::make_unique<ExplicitIntegrator>(problem, std::move(options));
}

std::unique_ptr<Integrator> make_implicit(DaeProblem& problem, ImplicitOptions options) {
  return std::make_unique<ImplicitIntegrator>(problem, std::move(options));
}

}  // namespace polybed::core
