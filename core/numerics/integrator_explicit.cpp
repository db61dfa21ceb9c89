// Explicit Runge-Kutta with error control, by ARKODE.
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
      require_success(ARKStepSetStopTime(memory_, t_stop), "ARKStepSetStopTime");
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
    return (std::size_t(reals) + own_vectors * atol_.span().size()) * sizeof(double);
  }

 private:
  static int callback(double t, N_Vector y, N_Vector dydt, void* self) {
    auto& me = *static_cast<ExplicitIntegrator*>(self);
    return guarded(me.kept_, [&] { return me.problem_.rates(t, entries(y), entries(dydt)); });
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
    memory_ = ARKStepCreate(callback, nullptr, t, y_, context_);
    if (memory_ == nullptr) throw NumericsError("ARKStepCreate failed");
    require_success(ARKStepSetErrHandlerFn(memory_, keep_silent, nullptr), "ARKStepSetErrHandlerFn");
    require_success(ARKStepSetUserData(memory_, this), "ARKStepSetUserData");
    require_success(ARKStepSetTableNum(memory_, ARKODE_DIRK_NONE, ARKODE_BOGACKI_SHAMPINE_4_2_3), "ARKStepSetTableNum");
    if (options_.atol_at)
      require_success(ARKStepWFtolerances(memory_, weigh), "ARKStepWFtolerances");
    else
      require_success(ARKStepSVtolerances(memory_, options_.rtol, atol_), "ARKStepSVtolerances");
    // Gustafsson's controller for explicit methods: where stability, not accuracy, bounds the step, the default one
    // runs into the bound again and again (a settled bed in water: 297 of 2006 tries rejected, with this one 29 of
    // 1744).
    require_success(ARKStepSetAdaptivityMethod(memory_, ARK_ADAPT_EXP_GUS, 1, 0, nullptr),
                    "ARKStepSetAdaptivityMethod");
    if (options_.fixed_step > 0)
      require_success(ARKStepSetFixedStep(memory_, options_.fixed_step), "ARKStepSetFixedStep");
    else if (h0 > 0)
      require_success(ARKStepSetInitStep(memory_, h0), "ARKStepSetInitStep");
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
  ExplicitOptions options_;
  Context context_;
  Vector y_, atol_, error_, weight_;
  static constexpr std::size_t own_vectors = 5;  // these and the tolerances of the options
  void* memory_ = nullptr;
  double time_ = 0, last_step_ = 0;
  IntegratorStatistics closed_;  ///< of memories closed by restarts, and all steps
  std::exception_ptr kept_;
};

}  // namespace

std::unique_ptr<Integrator> make_explicit(OdeProblem& problem, ExplicitOptions options) {
  return std::make_unique<ExplicitIntegrator>(problem, std::move(options));
}

}  // namespace polybed::core
