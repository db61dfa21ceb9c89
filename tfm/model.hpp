// The continuum model, ready to run: it owns the state, the equations and the integrator.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/run.hpp"
#include "core/output/checkpoint.hpp"
#include "core/timers.hpp"
#include "fluid/exits.hpp"
#include "fluid/fluid_mass.hpp"
#include "tfm/right_hand_side.hpp"
#include "tfm/step_part.hpp"
#include "tfm/stepping.hpp"

namespace polybed::tfm {

class CompressibleFluid;
class PackingCheck;

/// One line of the step log.
struct StepLine {
  double time = 0, step = 0, error_norm = 0;
  std::string limited_by;
};

class Model : public core::Simulation {
 public:
  /// Creates everything that the scene needs, at rest; throws core::CaseError for parts that cannot be created.
  /// \param ranks  that share the column, each with a model of its block; null: the column is all here. With ranks this
  /// and all functions that step, show, restart, keep or resume are collective.
  Model(const core::Scene& scene, core::Timers& timers, const std::shared_ptr<const core::Ranks>& ranks = nullptr);
  ~Model() override;

  [[nodiscard]] double time() const override { return time_; }
  void step(double stop) override;
  void show(double t) override;
  void restart() override;

  /// The state of this rank's block, to the bit; valid right after restart(). A file with it does not depend on the
  /// number of ranks.
  [[nodiscard]] core::Checkpoint checkpoint() const;
  /// How the ranks' arrays in a checkpoint lie in the arrays of the column.
  [[nodiscard]] core::CheckpointParts checkpoint_parts() const;
  /// Makes checkpoint() return the state last accepted, after a failed step.
  void keep_last_state();
  /// Accept steps beyond maximum packing; otherwise, and by default, the model throws core::ConservationError.
  void go_on_above_packing(bool go_on);
  /// Starts at time 0 from the state in a checkpoint with the same species and grid.
  void start_from(const core::Checkpoint& checkpoint);
  /// Resumes a run from a checkpoint written by any number of ranks: each rank's own parts, the rest from the first.
  /// Throws core::FileError if it is for another scene.
  void resume(const core::Checkpoint& checkpoint);

  [[nodiscard]] const Constants& constants() const { return equations_.constants(); }
  [[nodiscard]] const Effects& effects() const { return equations_.effects(); }
  /// Fields at the time last shown (or reached by a step).
  [[nodiscard]] const Fields& fields() const { return equations_.fields(); }
  [[nodiscard]] const fluid::Boundaries& boundaries() const { return equations_.boundaries(); }
  [[nodiscard]] const fluid::Inlet& inlet() const { return equations_.inlet(); }
  /// Times at which the inflow changes its rate or jumps: a run must stop there.
  [[nodiscard]] std::vector<double> breakpoints() const;
  /// Whether a discharge has a pressure, and the volume flow out through those that have, m3/s. Collective.
  [[nodiscard]] bool has_open_sides() const { return has_open_sides_; }
  [[nodiscard]] double overflow() const {
    return has_open_sides_ ? fluid::outflow(constants().grid, boundaries().open_faces(), fields().fluid.flux) : 0;
  }
  /// Volume of each species that has entered and left since the start, m3, for the fields last shown.
  [[nodiscard]] std::vector<fluid::Passed> passed() const { return constants().openings.passed(fields().solids); }
  /// The ways out, if there are several, for the fields last shown.
  [[nodiscard]] const fluid::Exits& exits() const { return exits_; }
  /// Between joined ends, Pa/m.
  [[nodiscard]] double mean_gradient() const { return equations_.mean_gradient(); }
  /// Explicit or implicit steps.
  [[nodiscard]] core::TfmIntegrator integrator_kind() const { return integrator_.kind; }
  [[nodiscard]] const std::string& integrator_reason() const { return integrator_.reason; }
  /// Convection of momentum; never automatic.
  [[nodiscard]] core::Momentum momentum() const { return momentum_; }
  [[nodiscard]] const StepLine& last_step() const { return last_step_; }
  [[nodiscard]] Work work() const;
  /// Number in the whole column.
  [[nodiscard]] std::size_t unknowns() const { return column_size_; }
  /// The same unknowns on another grid.
  [[nodiscard]] StateLayout layout_on(const core::Grid& grid) const;
  /// Flow of a compressible fluid in and out up to a time within the last step; nothing for other fluids.
  [[nodiscard]] std::optional<fluid::MassAccount> fluid_account(double t) const;
  /// Memory of the state and of the integrator's vectors, bytes.
  [[nodiscard]] std::size_t state_bytes() const {
    return integrator().workspace() + (y_.size() + dydt_.size()) * sizeof(double);
  }
  /// Velocity scale for errors and divergences, m/s.
  [[nodiscard]] double velocity_scale() const { return velocity_scale_; }
  /// Pressure, Pa, as the base of rtol in Newton's iterations: 1/1013.25 of the outlet's, 100 Pa for an atmosphere.
  [[nodiscard]] double pressure_scale() const { return pressure_scale_; }

 private:
  template <class Made, class... Args>
  Made* add_part(Args&&... args);
  void make_parts();
  void fill_state(const core::Scene& scene);
  void begin_integration();
  void prepare(std::span<const double> y);
  void accept(const core::StepReport& report);
  [[nodiscard]] std::string what_limited(const core::StepReport& report) const;
  void check_fits(const core::Checkpoint& checkpoint) const;
  void restore_counts(const core::Checkpoint& checkpoint);
  [[nodiscard]] StateLayout layout_of_column() const { return layout_on(core::whole_column(constants().grid)); }
  [[nodiscard]] core::Integrator& integrator() const { return stepping_->integrator(); }
  [[nodiscard]] bool compressible() const { return effects().compressible != nullptr; }
  /// Whether theta_j is an unknown, instead of the result of a local balance.
  [[nodiscard]] bool transports_temperature() const { return !fields().solids.temperature_rate.empty(); }

  core::Timers& timers_;
  core::Tfm options_;
  core::Momentum momentum_;
  bool has_open_sides_;
  RightHandSide equations_;
  fluid::Exits exits_;
  IntegratorChoice integrator_;
  StateLayout layout_;
  double time_ = 0, step_ = 0, velocity_scale_ = 1, pressure_scale_ = 100;
  std::vector<double> y_, dydt_;
  std::size_t column_size_ = 0;                      ///< entries of the whole column's state
  std::vector<std::unique_ptr<StepPart>> parts_;     ///< those needed by the scene, in the order in which they act
  CompressibleFluid* compressible_fluid_ = nullptr;  ///< one of the parts, or null; likewise the next
  PackingCheck* packing_check_ = nullptr;
  std::unique_ptr<Stepping> stepping_;
  StepLine last_step_;
  Work before_;  ///< by integrators that a restart has closed
};

}  // namespace polybed::tfm
