#include "hard/naive/treatments.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "hard/naive/equations.hpp"
#include "hard/naive/unknowns.hpp"
#include "tfm/explicit_problem.hpp"
#include "tfm/implicit_problem.hpp"

namespace polybed::hard::naive {

namespace {

using Kind = tfm::StateLayout::Entry::Kind;
using Start = std::function<void(tfm::Model&)>;

std::vector<double> tolerances(const tfm::StateLayout& layout, double rtol, const tfm::Model& model) {
  std::vector<double> atol(layout.size());
  for (const auto& entry : layout.entries())
    std::fill_n(atol.begin() + std::ptrdiff_t(entry.begin), entry.size,
                entry.kind == Kind::fraction   ? 0.1 * rtol
                : entry.kind == Kind::pressure ? model.pressure_scale() * rtol
                                               : rtol * model.velocity_scale());
  return atol;
}

/// What all naive runs share: the product's model as it stands at the start, and an integrator of another problem.
class NaiveRun : public hard::Run {
 public:
  NaiveRun(const core::Scene& scene, core::Timers& timers, const Start& start)
      : scene_(scene),
        timers_(timers),
        model_(scene, timers),
        layout_(model_.constants().grid, int(model_.constants().species()),
                scene.tfm.integrator == core::TfmIntegrator::implicit_steps) {
    if (start) start(model_);
  }
  [[nodiscard]] double time() const override { return time_; }
  tfm::StepLine step(double stop) override {
    before_step(next_step_);
    const core::StepReport report = integrator_->step(stop);
    time_ = report.time;
    const bool event = report.time >= stop && report.step < 0.99 * report.next_step;
    next_step_ = report.next_step;
    return {report.time, report.step, report.error_norm, event ? "event" : ""};
  }
  [[nodiscard]] tfm::Work work() const override {
    const core::IntegratorStatistics s = integrator_->statistics();
    return {s.steps, s.error_failures + s.recoverable_failures, 0, 0, 0, s.newton_iterations, s.linear_iterations};
  }
  [[nodiscard]] tfm::Model& model() override { return model_; }

 protected:
  virtual void before_step(double) {}
  /// A state after a jump of the inlet at the present time, by the product's projection.
  std::vector<double> projected(std::vector<double> y) {
    core::Checkpoint now = model_.checkpoint();
    now.arrays.at("state") = std::move(y);
    now.numbers.at("time_s") = time_;
    model_.resume(now);
    model_.restart();
    return model_.checkpoint().arrays.at("state");
  }
  core::Scene scene_;
  core::Timers& timers_;
  tfm::Model model_;
  tfm::StateLayout layout_;
  std::unique_ptr<core::Integrator> integrator_;
  double time_ = 0, next_step_ = 0;
};

/// Explicit steps of the equations with other terms.
class ExplicitRun : public NaiveRun {
 public:
  /// \param without  effects that `terms` replaces
  ExplicitRun(const core::Scene& scene, core::Timers& timers, const Start& start,
              const std::vector<std::string>& without, const std::function<Terms(const tfm::Model&)>& terms)
      : NaiveRun(scene, timers, start) {
    for (const std::string& role : without) scene_.effects.erase(role);
    equations_ = std::make_unique<Equations>(scene_, model_, layout_, terms ? terms(model_) : Terms(), timers_);
    core::ExplicitOptions options{scene.tfm.rtol, tolerances(layout_, scene.tfm.rtol, model_),
                                  scene.tfm.fixed_step.value_or(0)};
    integrator_ = core::make_explicit(*equations_, std::move(options));
    integrator_->restart(0, model_.checkpoint().arrays.at("state"), {}, 0);
  }
  void restart() override {
    const auto state = integrator_->state();
    equations_->right_hand_side().begin(time_);
    integrator_->restart(time_, projected({state.begin(), state.end()}), {}, next_step_);
  }
  const tfm::Fields& fields() override {
    const core::Field pressure = equations_->fields().fluid.pressure;
    (void)equations_->evaluate(time_,
                               integrator_->state());  // a state that cannot be evaluated is shown as far as it goes
    equations_->fields().fluid.pressure = pressure;
    return equations_->fields();
  }

 protected:
  void before_step(double h) override { equations_->begin_step(h); }

 private:
  std::unique_ptr<Equations> equations_;
};

/// Implicit steps of the product's system inside a wrapper.
class ImplicitRun : public NaiveRun {
 public:
  ImplicitRun(const core::Scene& scene, core::Timers& timers, const Start& start, const std::string& name)
      : NaiveRun(scene, timers, start), equations_(scene, model_, layout_, {}, timers) {
    problem_ = std::make_unique<tfm::ImplicitProblem>(equations_.right_hand_side(), layout_, timers);
    if (name == "clip_rhs") wrapper_ = std::make_unique<ClippedRates>(*problem_, layout_);
    if (name == "jacobi_preconditioner")
      wrapper_ = std::make_unique<JacobiContinuity>(*problem_, equations_.right_hand_side(), layout_);
    if (name == "divide_by_phi") {
      auto momenta = std::make_unique<MomentumUnknowns>(*problem_, model_, layout_);
      momenta_ = momenta.get();
      wrapper_ = std::move(momenta);
    }
    core::DaeProblem& problem = wrapper_ ? *wrapper_ : *problem_;
    core::ImplicitOptions options;
    options.rtol = scene.tfm.rtol;
    options.atol = tolerances(layout_, scene.tfm.rtol, model_);
    options.id.assign(layout_.size(), 1.0);
    for (const auto& entry : layout_.entries())
      if (entry.kind == Kind::pressure) std::fill_n(options.id.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
    integrator_ = core::make_implicit(problem, std::move(options));
    begin(model_.checkpoint().arrays.at("state"));
  }
  const tfm::Fields& fields() override {
    (void)equations_.evaluate(time_, velocities());
    return equations_.fields();
  }
  void restart() override { begin(projected(velocities())); }

 private:
  /// Consistent rates and pressure from one projected evaluation, as the product does.
  void begin(std::vector<double> y) {
    std::vector<double> dydt(y.size(), 0.0);
    equations_.right_hand_side().begin(time_);
    for (const auto& entry : layout_.entries())
      if (entry.kind == Kind::pressure) std::fill_n(y.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
    tfm::ExplicitProblem solved(equations_.right_hand_side(), layout_, 1e-8, timers_);
    if (solved.rates(time_, y, dydt) != core::Rate::ok) throw std::runtime_error("no rates at the start");
    for (const auto& entry : layout_.entries())
      if (entry.kind == Kind::pressure) layout_.pack(entry, equations_.fields().fluid.pressure, y);
    if (momenta_ != nullptr) {
      momenta_->to_momentum(y, y);
      momenta_->change_to_momentum(dydt, dydt);
    }
    integrator_->restart(time_, y, dydt, next_step_);
  }
  [[nodiscard]] std::vector<double> velocities() const {
    std::vector<double> y(integrator_->state().begin(), integrator_->state().end());
    if (momenta_ != nullptr) momenta_->to_velocity(y, y);
    return y;
  }
  Equations equations_;
  std::unique_ptr<tfm::ImplicitProblem> problem_;
  std::unique_ptr<core::DaeProblem> wrapper_;
  MomentumUnknowns* momenta_ = nullptr;  ///< the wrapper, where it is one
};

/// A step of which the fastest inlet crosses half a cell.
double courant_step(const core::Scene& scene) {
  double fastest = 0;
  for (const auto& point : scene.inlet.superficial_velocity) fastest = std::max(fastest, std::abs(point.second));
  return 0.5 * scene.column.size[1] / scene.column.cells[1] / fastest;
}

}  // namespace

std::unique_ptr<hard::Run> make_run(const std::string& name, core::Scene scene, core::Timers& timers,
                                    const Start& start) {
  if (name == "cold_restart") return nullptr;
  const bool implicit =
      name == "clip_rhs" || name == "jacobi_preconditioner" || name == "divide_by_phi" || name == "nothing implicit";
  scene.tfm.integrator = implicit ? core::TfmIntegrator::implicit_steps : core::TfmIntegrator::explicit_steps;
  if (implicit) {
    scene.tfm.fixed_step.reset();
    return std::make_unique<ImplicitRun>(scene, timers, start, name);
  }
  const auto explicit_run = [&](const std::vector<std::string>& without,
                                const std::function<Terms(const tfm::Model&)>& terms) {
    return std::make_unique<ExplicitRun>(scene, timers, start, without, terms);
  };
  if (name == "nothing explicit") return explicit_run({}, {});
  if (name == "divide_by_phi composition")
    return explicit_run({"drag"}, [&](const tfm::Model& model) { return raw_drag(scene, model, true); });
  if (name == "raw_drag" || name == "unguarded_alpha")
    return explicit_run({"drag"}, [&](const tfm::Model& model) { return raw_drag(scene, model, false); });
  if (name == "hard_packing") return explicit_run({"solids_stress"}, hard_packing);
  if (name == "central_flux") return explicit_run({}, central_flux);
  if (name == "unbalanced_gravity") return explicit_run({}, unbalanced_gravity);
  if (name == "advective_momentum")
    return explicit_run({}, [&](const tfm::Model& model) { return advective_momentum(scene, model); });
  if (name == "hidden_unit") return explicit_run({}, hidden_unit);
  if (name == "added_mass_lagged") return explicit_run({"added_mass"}, added_mass_lagged);
  if (name == "drag_explicit") {
    scene.tfm.fixed_step = courant_step(scene);
    return explicit_run({}, {});
  }
  throw std::invalid_argument("no naive treatment '" + name + "'");
}

}  // namespace polybed::hard::naive
