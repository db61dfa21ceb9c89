// Speed of this machine: shipped values, or values measured here once and stored in the user's cache.
#pragma once

#include <filesystem>
#include <string>

namespace polybed::multiscale {

/// Speed of one core with particles: on dense beds with friction and the ledger, docs/record/cost.md; dilute ones
/// without a fluid are up to four times as fast. A step costs something even without particles. A fluid step has parts
/// for each particle's exchange, for each cell, and for the smallest grid; they grow with a kernel by diffusion.
struct ParticleSpeed {
  double particle_step = 5e-8, step = 1e-6;                                                 ///< s
  double particle_step_in_fluid = 4e-8, exchange = 1.2e-7, cell = 6e-7, fluid_step = 1e-5;  ///< s
  double diffusion = 2;                                                                     ///< of a fluid step
};

/// Output on one core, s: a stored time and a row of the history, with parts for each cell and each particle.
struct OutputSpeed {
  double stored = 2.3e-3, stored_cell = 1.1e-6, stored_particle = 1e-6;
  double row = 3e-5, row_cell = 6e-8, row_particle = 2e-8;
};

/// CPU seconds on one core. The shipped values are from a Zen 5 core with nothing beside it, docs/record/cost.md.
struct Machine {
  double explicit_step = 0.35e-6;   ///< for the two-fluid model, per cell of a plane with two species
  double implicit_step = 0.9e-6;    ///< likewise
  double tfm_step = 3e-5;           ///< per step, for any number of cells
  double start = 0.03;              ///< the program's start, s
  double placed_particle = 1.5e-5;  ///< in a random start, s
  OutputSpeed output;
  ParticleSpeed particles;
  bool measured = false;  ///< on this machine
  std::string processor;  ///< used for the measurement
};

/// Cost of a step of the two-fluid model, s: proportional to the phases, and in three dimensions 1.4 times as much per
/// cell (three velocities per phase instead of two).
[[nodiscard]] double tfm_step_seconds(const Machine& machine, bool implicit, double cells, std::size_t species,
                                      int dimensions);

/// Cost of a step of the fluid between particles, s.
[[nodiscard]] double fluid_step_seconds(const ParticleSpeed& speed, double particles, double cells, bool diffusion);

/// $XDG_CACHE_HOME/polybed/machine.json, or the one in ~/.cache; empty if neither variable is set.
[[nodiscard]] std::filesystem::path machine_file();

/// The values measured here; the shipped ones if there are none, if they are from another processor, or if the file is
/// damaged.
[[nodiscard]] Machine known_machine();

/// Runs small beds for some seconds each: two-fluid model explicit and implicit, particles without a fluid, and with
/// one that is solved rarely and often.
/// \param seconds  in total, CPU; a bed that ends before has taken less  \param until  simulated, s
[[nodiscard]] Machine measure_machine(double seconds, double until = 100);

[[nodiscard]] std::string machine_text(const Machine& machine);  ///< as JSON
/// Throws core::FileError for any other text.
[[nodiscard]] Machine machine_of_text(const std::string& text);

}  // namespace polybed::multiscale
