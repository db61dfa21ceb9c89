// How fast this machine computes: shipped values, or those measured here once and kept in the user's cache.
#pragma once

#include <filesystem>
#include <string>

namespace polybed::multiscale {

/// How fast one core computes particles. The values here were measured on the cases of this repository: a dense bed
/// with friction and the ledger; a dilute one is up to four times as fast. A step costs something with no particle at
/// all. With a fluid particles are slower, as each asks the fields and the drag law at every step; of the fluid's step
/// count what each particle gives and answers, each cell, and what it takes on the smallest grid.
struct ParticleSpeed {
  double particle_step = 1e-7, step = 3e-6;                                                    ///< s
  double particle_step_in_fluid = 1.0 / 6e6, exchange = 2e-7, cell = 8e-7, fluid_step = 2e-4;  ///< s
};

/// CPU seconds of one core. The shipped values are those of an AMD EPYC virtual machine, docs/record/cost.md.
struct Machine {
  double explicit_step = 0.9e-6;                  ///< of the two-fluid model, per cell of a plane with two species
  double implicit_step = 5e-6;                    ///< likewise
  double tfm_step = 1e-4;                         ///< per step, however few the cells
  double start = 0.1;                             ///< of the program, s
  double stored_step = 6e-3, history_row = 1e-4;  ///< of output, beyond what grows with the case, s
  double placed_particle = 3e-5;                  ///< of a random start, s; 2e-5 to 5e-5 by how dense it is
  ParticleSpeed particles;
  bool measured = false;  ///< on this machine
  std::string processor;  ///< on which they were measured
};

/// What a step of the two-fluid model takes, s: in proportion to the phases, and in three dimensions 1.4 times as much
/// per cell (three velocities of each phase in place of two).
[[nodiscard]] double tfm_step_seconds(const Machine& machine, bool implicit, double cells, std::size_t species,
                                      int dimensions);

/// $XDG_CACHE_HOME/polybed/machine.json, or that in ~/.cache; empty where neither variable is set.
[[nodiscard]] std::filesystem::path machine_file();

/// What was measured here; the shipped values if nothing was, if it was on another processor, or if the file is
/// damaged.
[[nodiscard]] Machine known_machine();

/// Runs four small beds for some seconds each: two-fluid model explicit and implicit, particles without and with a
/// fluid. \param seconds  in all, CPU
[[nodiscard]] Machine measure_machine(double seconds);

[[nodiscard]] std::string machine_text(const Machine& machine);  ///< as JSON
/// Throws core::FileError for another text.
[[nodiscard]] Machine machine_of_text(const std::string& text);

}  // namespace polybed::multiscale
