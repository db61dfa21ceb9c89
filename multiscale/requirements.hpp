// Requirements of a case, before its run: memory, steps and time. They are measured on a narrow part of the same bed,
// so that the cost of a new effect is included automatically.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/memory.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {

/// Memory, bytes. The total is measured; the state and the fields are counted; the remainder is for the linear solvers
/// and libraries.
struct MemoryNeed {
  double state = 0, fields = 0, solver = 0;
  double program = 0;  ///< the program itself with its libraries: the same for every case
  [[nodiscard]] double total() const { return state + fields + solver + program; }
};

/// Memory for walls inside a column, which the sample leaves out, bytes; 0 without any in the fluid. Measured on runs
/// with walls.
[[nodiscard]] double bytes_of_walls(const core::Scene& scene);

/// Duration of step timing, on a part of a bed before a run and on the run itself, CPU s.
inline constexpr double sample_seconds = 0.25;

/// Computing time of the whole run: its steps, and the cost of one, CPU s.
struct TimeNeed {
  double steps = 0, seconds_per_step = 0;
  [[nodiscard]] double computing() const { return steps * seconds_per_step; }
};

/// A uniform bed with its time scales, without cells, and its expected step.
struct BedState {
  double solids_fraction = 0;
  std::vector<tfm::TimeScale> scales;
  double step = 0;  ///< s
};

struct Requirements {
  std::size_t unknowns = 0, cells = 0;
  core::TfmIntegrator integrator{};
  std::string reason;
  core::Momentum momentum{};
  MemoryNeed memory;
  BedState rest;                 ///< settled, at bed.solids_fraction
  BedState lifted;               ///< packed but suspended by the fluid, as in a bed that starts packed
  BedState expanded;             ///< expanded at the inlet's greatest velocity; at rest if that is too low
  std::optional<TimeNeed> time;  ///< empty if the computation failed in the sample
};

/// Height, m, of a uniform bed as a run measures it, on slabs of one cell; empty if the bed is carried away.
[[nodiscard]] std::optional<double> measured_height(const core::Scene& scene, double solids_fraction);

/// The case on fewer cells of the same size: sides are reduced first, to no less than eight cells, then the height,
/// with the bed. Cell size, velocities and composition, which determine the steps, stay.
[[nodiscard]] core::Scene narrow_part(const core::Scene& scene, std::size_t most_cells);

/// Position of a round column on its grid, what walls inside leave open, and graded layers, in words; else empty.
[[nodiscard]] std::string shape_text(const core::Scene& scene);

/// Builds and steps a narrow part of the case for at most about a second.
/// \param model  receives the model of the part, for further results from a case
[[nodiscard]] Requirements requirements_of(const core::Scene& scene, core::Timers& timers,
                                           std::unique_ptr<tfm::Model>& model);

/// The same for an existing model, without memory and without a step: the cost of a step is given.
/// \param seconds_per_step  CPU time
[[nodiscard]] Requirements expected_of(const core::Scene& scene, const tfm::Model& model, double seconds_per_step);

/// Throws core::CaseError with both numbers if a case needs more memory than is available.
/// \param bytes  needed by a run   \param particles  the number of particles that need most of it; 0: cells do
void refuse_beyond_memory(const core::Scene& scene, double bytes, const core::AvailableMemory& available,
                          std::int64_t particles = 0);

/// The same before a run, from a separate sample. A case that is small relative to the memory passes unmeasured.
void require_memory(const core::Scene& scene);

}  // namespace polybed::multiscale
