// Writes the files of a particle run: history.csv, profiles.h5, particles.h5, and with a fluid fields.h5.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "core/case/scene.hpp"
#include "core/output/history.hpp"
#include "core/output/particles.hpp"
#include "core/output/profiles.hpp"
#include "dem/coupling/fluid_output.hpp"
#include "dem/coupling/fluid_record.hpp"
#include "dem/history_table.hpp"
#include "dem/invariants.hpp"
#include "dem/measures.hpp"
#include "dem/model.hpp"
#include "fluid/exits.hpp"
#include "measures/bed_table.hpp"
#include "measures/particle_profile.hpp"

namespace polybed::dem {

// All of these are collective.
class Observers {
 public:
  /// Starts the files in a run directory, or continues them from a time.
  /// \param start  reference for the laws; empty: the present state
  /// \param fluid  totals of a continued run's fluid; the first rank's count
  Observers(const Model& model, const core::Scene& scene, const std::filesystem::path& directory,
            std::optional<RunStart> start, const FluidTotals& fluid, std::optional<double> resume_time);

  /// Call it after each step.
  void see_step();

  /// One row of history.csv; also measures the invariants.
  void write_history(double time);
  /// Makes the rows of history.csv survive a power cut.
  void flush();
  /// Restores the worst values of the run that this one continues.
  void recall(const core::Json& past) { invariants_.recall(past); }
  /// One row of profiles.h5, one step of particles.h5 and, with a fluid, of fields.h5.
  void write_particles(double time);

  /// From the last row of the history.
  [[nodiscard]] const Totals& totals() const { return totals_; }
  [[nodiscard]] std::optional<double> bed_height() const { return bed_height_; }
  [[nodiscard]] const Invariants& invariants() const { return invariants_; }
  /// Null without a fluid.
  [[nodiscard]] const FluidRecord* fluid() const { return fluid_ ? &*fluid_ : nullptr; }

 private:
  /// Files that the first rank has open.
  struct Files {
    core::HistoryWriter history;
    core::ProfileWriter profiles;
    std::unique_ptr<FluidOutput> fluid;  ///< null without one
  };
  /// On the first rank.
  [[nodiscard]] Told told(double most_solids, double overflow, std::vector<double> exit_flow) const;
  void write_all_particles(double time);
  /// Whether a fluid flows through joined ends.
  [[nodiscard]] bool is_around() const;
  [[nodiscard]] measures::BoxFlow box_flow(const measures::ParticleProfile& profile, double fluid_flux) const;

  const Model& model_;
  measures::Slabs slabs_;
  fluid::Exits exits_;  ///< for the fluid
  measures::History<Told> history_;
  std::optional<FluidRecord> fluid_;  ///< absent without a fluid
  std::unique_ptr<Files> files_;
  core::ParticleWriter particles_;
  Totals totals_;
  Invariants invariants_;
  std::optional<double> bed_height_;
};

}  // namespace polybed::dem
