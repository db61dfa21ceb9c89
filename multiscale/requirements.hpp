// What a case will need, before it is run: memory, steps and time. Measured on a narrow part of the same bed, so that
// what a new effect takes is counted without anybody counting it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/memory.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {

/// Memory, bytes. What is measured is the whole; the state and the fields are counted, the rest is what remains: the
/// linear solvers and the work of the library below them.
struct MemoryNeed {
  double state = 0, fields = 0, solver = 0;
  double program = 0;  ///< the program itself with its libraries: the same for every case
  [[nodiscard]] double total() const { return state + fields + solver + program; }
};

/// For which steps are timed, on a part of a bed before a run and on the run itself, CPU s.
inline constexpr double sample_seconds = 0.25;

/// Computing of the whole run: its steps, and what one takes, CPU s.
struct TimeNeed {
  double steps = 0, seconds_per_step = 0;
  [[nodiscard]] double computing() const { return steps * seconds_per_step; }
};

/// A uniform bed with its time scales, cell-free, and the step expected there.
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
  BedState rest;                 ///< settled, as bed.solids_fraction says
  BedState lifted;               ///< packed but carried by the fluid, as a bed is that starts packed
  BedState expanded;             ///< as the inlet's greatest velocity expands it; at rest if it does not
  std::optional<TimeNeed> time;  ///< empty if the numbers failed in the sample
};

/// The case on fewer cells of the same size: sides drawn in first, to no less than eight cells, then the height, with
/// the bed. What decides the steps, cell size, velocities and composition, stays.
[[nodiscard]] core::Scene narrow_part(const core::Scene& scene, std::size_t most_cells);

/// How a round column lies on its grid, in words; empty for a box.
[[nodiscard]] std::string shape_text(const core::Column& column);

/// Builds and steps a narrow part of the case for at most about a second of computing.
/// \param model  receives the model of the part, for what else follows from a case
[[nodiscard]] Requirements requirements_of(const core::Scene& scene, core::Timers& timers,
                                           std::unique_ptr<tfm::Model>& model);

/// The same of a model that is there already, without memory and without a step: what a step takes is given.
/// \param seconds_per_step  CPU time
[[nodiscard]] Requirements expected_of(const core::Scene& scene, const tfm::Model& model, double seconds_per_step);

/// Throws core::CaseError if a case needs more memory than there is, with both numbers.
/// \param bytes  that a run needs   \param particles  the number of particles that needs most of it; 0: cells do
void refuse_beyond_memory(const core::Scene& scene, double bytes, const core::AvailableMemory& available,
                          std::int64_t particles = 0);

/// The same before a run, from a sample of its own. A case that is small beside the memory is let through unmeasured.
void require_memory(const core::Scene& scene);

}  // namespace polybed::multiscale
