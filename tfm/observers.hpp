// Output of a continuum run while it runs: history, profiles, fields, the step log, its invariants.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>

#include "core/output/output.hpp"
#include "measures/bed.hpp"
#include "measures/bed_table.hpp"
#include "measures/invariants.hpp"
#include "tfm/history_table.hpp"
#include "tfm/model.hpp"
#include "tfm/well_posedness.hpp"

namespace polybed::tfm {

/// The smallest margin to ill-posedness in the rows of a run's history, and the share of cells below 1 in the last.
struct LeastWellPosed {
  WellPosedness cell;
  double time = 0, share_below_now = 0;
};

/// All ranks measure, the first one writes: every function is collective.
class Observers {
 public:
  /// Starts the files in a run directory, or continues them from a time.
  /// \param initial_mass  of each species, kg, as the reference for mass
  Observers(const Model& model, const std::filesystem::path& directory, double rtol, std::vector<double> initial_mass,
            std::optional<double> resume_time);

  /// One row of history.csv; also measures the invariants.
  void write_history(double time);
  /// One row of profiles.h5 and one step of fields.h5.
  void write_fields(double time);
  /// Makes the rows of history.csv survive a power cut.
  void flush();
  /// Data that a continued run cannot measure again, for its checkpoint, and their restoration.
  [[nodiscard]] core::Json past() const;
  void recall(const core::Json& past);
  /// One row of steps.csv, passed to the operating system at once and complete.
  void log_step();

  /// The last logged steps, the newest at the end: ten, or as many as this process has made.
  [[nodiscard]] const std::deque<StepLine>& last_steps() const { return last_steps_; }
  [[nodiscard]] const measures::Invariants& invariants() const { return invariants_; }
  /// Bed height of the last row of the history, m.
  [[nodiscard]] std::optional<double> bed_height() const { return bed_height_; }
  /// Pressure drop over buoyant weight in the last row of the history.
  [[nodiscard]] double force_balance() const { return force_balance_; }
  [[nodiscard]] const LeastWellPosed& least_well_posed() const { return least_well_posed_; }

 private:
  /// Files that the first rank has open.
  struct Files {
    core::HistoryWriter history;
    core::ProfileWriter profiles;
    core::LineFile steps;
  };

  /// Whether the ends are joined: there is no bottom and no top.
  [[nodiscard]] bool around() const { return model_.constants().grid.periodic[1]; }
  /// Monitors well-posedness, which is not part of a row.
  void watch(double time, const WellPosedness& now);
  /// The invariants and the model's own values.
  Told told(const measures::Watched& column, double time);

  const Model& model_;
  const core::Ranks* ranks_;
  measures::Invariants invariants_;
  measures::History<Told> history_;
  LeastWellPosed least_well_posed_;
  std::unique_ptr<Files> files_;
  std::optional<core::FieldWriter> fields_;  ///< every rank writes its block
  std::optional<double> bed_height_;
  double force_balance_ = 0;
  std::deque<StepLine> last_steps_;
};

/// theta_j for files, m2/s2: 0 where the species is absent (phi_j below 1e-6) and its value has no meaning.
[[nodiscard]] core::Field shown_temperature(const core::Field& fraction, const core::Field& temperature);
/// Mean of the shown theta_j over the solids in each layer of the column, m2/s2; 0 without solids. Collective.
[[nodiscard]] std::vector<double> mean_temperature(const core::Grid& grid, const core::Field& fraction,
                                                   const core::Field& shown);

/// Mass of each species in the column, kg. Collective.
[[nodiscard]] std::vector<double> masses(const Model& model);

}  // namespace polybed::tfm
