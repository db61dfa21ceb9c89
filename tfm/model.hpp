// The continuum model as something that can be run: it owns the state, the equations and the integrator.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/checkpoint.hpp"
#include "core/run.hpp"
#include "core/scene.hpp"
#include "core/timers.hpp"
#include "tfm/explicit_problem.hpp"
#include "tfm/implicit_problem.hpp"
#include "tfm/step_limits.hpp"

namespace polybed::tfm {

/// What the model has done so far; repeats exactly from run to run.
struct Work {
  std::uint64_t steps = 0, rejected_steps = 0, right_hand_sides = 0, pressure_solves = 0, pressure_iterations = 0,
                newton_iterations = 0, krylov_iterations = 0, first_order_cells = 0;
};

/// One line of the step log.
struct StepLine {
  double time = 0, step = 0, error_norm = 0;
  std::string limited_by;
};

class Model : public core::Simulation {
 public:
  /// Everything the scene calls for, at rest at its start; throws core::CaseError for what cannot be built.
  Model(const core::Scene& scene, core::Timers& timers);
  ~Model() override;

  [[nodiscard]] double time() const override { return time_; }
  void step(double stop) override;
  void show(double t) override;
  void restart() override;

  /// The whole state, to the bit; valid right after restart().
  [[nodiscard]] core::Checkpoint checkpoint() const;
  /// Keeps the state last accepted as the one that checkpoint() returns, after a step has failed.
  void keep_last_state();
  /// Begins at time 0 from the state of a checkpoint of the same species and grid.
  void start_from(const core::Checkpoint& checkpoint);
  /// Takes a run up again; throws core::FileError if the checkpoint is of another scene.
  void resume(const core::Checkpoint& checkpoint);

  [[nodiscard]] const Constants& constants() const { return equations_.constants(); }
  [[nodiscard]] const Effects& effects() const { return equations_.effects(); }
  /// Fields at the time last shown (or stepped to).
  [[nodiscard]] const Fields& fields() const { return equations_.fields(); }
  [[nodiscard]] const fluid::Boundaries& boundaries() const { return equations_.boundaries(); }
  [[nodiscard]] const fluid::Inlet& inlet() const { return equations_.inlet(); }
  [[nodiscard]] const std::string& integrator_name() const { return integrator_name_; }
  [[nodiscard]] const std::string& integrator_reason() const { return integrator_reason_; }
  [[nodiscard]] const StepLine& last_step() const { return last_step_; }
  [[nodiscard]] Work work() const;
  [[nodiscard]] std::size_t unknowns() const { return layout_.size(); }
  /// Velocity that errors and divergences are measured against, m/s.
  [[nodiscard]] double velocity_scale() const { return velocity_scale_; }

 private:
  void choose_integrator(const core::Scene& scene);
  void make_integrator();
  [[nodiscard]] core::Field inlet_velocity(double t) const;
  void project_jump(const core::Field& before);
  [[nodiscard]] std::vector<double> absolute_tolerances() const;
  void begin_integration();
  void use_fallback();
  void restore_fallback(const core::Checkpoint& checkpoint);

  core::Timers& timers_;
  core::Tfm options_;
  RightHandSide equations_;
  std::string integrator_name_, integrator_reason_;
  StateLayout layout_;
  std::unique_ptr<ExplicitProblem> explicit_;
  std::unique_ptr<ImplicitProblem> implicit_;
  std::unique_ptr<core::Integrator> integrator_;
  double time_ = 0, step_ = 0, velocity_scale_ = 1;
  std::vector<double> y_, dydt_;
  StepLine last_step_;
  std::optional<FirstOrderFallback> fallback_;  ///< absent where all fluxes are of first order anyway
  Work before_;                                 ///< of the integrators that a restart has closed
};

}  // namespace polybed::tfm
