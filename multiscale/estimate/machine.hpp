// Speed of this machine: shipped values, or values measured here once and stored in the user's cache.
#pragma once

#include <filesystem>
#include <string>

namespace polybed::multiscale {

/// Speed of one core with particles. The values here were measured on cases in this repository: a dense bed with
/// friction and the ledger; a dilute one is up to four times as fast. A step costs something even without particles.
/// Particles in a fluid are slower, as each evaluates fields and drag law at every step; the cost of a fluid step has
/// parts for each particle's exchange, for each cell, and for the smallest grid.
struct ParticleSpeed {
  double particle_step = 1e-7, step = 3e-6;                                                    ///< s
  double particle_step_in_fluid = 1.0 / 6e6, exchange = 2e-7, cell = 8e-7, fluid_step = 2e-4;  ///< s
};

/// CPU seconds on one core. The shipped values are from an AMD EPYC virtual machine, docs/record/cost.md.
struct Machine {
  double explicit_step = 0.9e-6;                  ///< for the two-fluid model, per cell of a plane with two species
  double implicit_step = 5e-6;                    ///< likewise
  double tfm_step = 1e-4;                         ///< per step, for any number of cells
  double start = 0.1;                             ///< the program's start, s
  double stored_step = 6e-3, history_row = 1e-4;  ///< for output, without parts that grow with the case, s
  double placed_particle = 3e-5;                  ///< in a random start, s; 2e-5 to 5e-5 depending on density
  ParticleSpeed particles;
  bool measured = false;  ///< on this machine
  std::string processor;  ///< used for the measurement
};

/// Cost of a step of the two-fluid model, s: proportional to the phases, and in three dimensions 1.4 times as much per
/// cell (three velocities per phase instead of two).
[[nodiscard]] double tfm_step_seconds(const Machine& machine, bool implicit, double cells, std::size_t species,
                                      int dimensions);

/// $XDG_CACHE_HOME/polybed/machine.json, or the one in ~/.cache; empty if neither variable is set.
[[nodiscard]] std::filesystem::path machine_file();

/// The values measured here; the shipped ones if there are none, if they are from another processor, or if the file is
/// damaged.
[[nodiscard]] Machine known_machine();

/// Runs four small beds for some seconds each: two-fluid model explicit and implicit, particles without and with a
/// fluid. \param seconds  in total, CPU; a bed that ends before has taken less \param until  simulated, s
[[nodiscard]] Machine measure_machine(double seconds, double until = 100);

[[nodiscard]] std::string machine_text(const Machine& machine);  ///< as JSON
/// Throws core::FileError for any other text.
[[nodiscard]] Machine machine_of_text(const std::string& text);

}  // namespace polybed::multiscale
