// What a case will need of the particle model before it is run: particles, memory, time step, steps and time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "dem/coupling/kernel.hpp"
#include "dem/overlap_forecast.hpp"
#include "dem/step_limits.hpp"
#include "multiscale/estimate/machine.hpp"

namespace polybed::multiscale {

/// The fluid between the particles.
struct FluidNeed {
  int every = 1;     ///< steps of the particles in one of the fluid
  double step = 0;   ///< s
  double steps = 0;  ///< in the whole run
  std::size_t cells = 0;
  dem::Kernel kernel;
  double memory = 0;    ///< bytes
  std::string warning;  ///< steps that are too long; empty: none
};

struct ParticleRequirements {
  std::vector<std::int64_t> numbers;  ///< of each species
  std::vector<std::int64_t> fed;      ///< of each species that enter in the run; empty: none are fed
  dem::StepLimits limits;             ///< the step and what sets it
  dem::OverlapForecast overlap;       ///< at the speed that it is made for
  double program = 0, particles = 0;  ///< memory, bytes: the program itself; what grows with the number
  std::optional<FluidNeed> fluid;     ///< absent without one
  double steps = 0, particle_steps = 0;
  double expected = 0;              ///< CPU time of the run by the speed given, s
  double settling = 0, before = 0;  ///< s simulated until a bed that settles first is at rest; of expected
  [[nodiscard]] std::int64_t count() const;
  /// Of a step that the case gives, and of contacts too soft.
  [[nodiscard]] std::vector<std::string> warnings() const;
  [[nodiscard]] double memory() const { return program + particles + (fluid ? fluid->memory : 0); }
};

/// From the case alone: nothing is packed and nothing is stepped, so that it is known at once for any number. Throws
/// core::CaseError for what the particle model could not build.
[[nodiscard]] ParticleRequirements particle_requirements_of(const core::Scene& scene, const ParticleSpeed& speed = {});

/// The same for a run: throws core::CaseError if it needs more memory than there is, and core::StartError where the
/// particles do not fit, if they are not too many to be placed at once.
[[nodiscard]] ParticleRequirements placed_requirements_of(const core::Scene& scene);

/// Throws core::CaseError if a run needs more memory than there is. A case that is small beside it is let through.
void require_particle_memory(const core::Scene& scene);

/// Of steps_by: from here on people are told.
inline constexpr double many_more_steps = 1.25;

/// How many times as many steps a run of particles takes with an effect that the scene has on: 1 where the effect does
/// not shorten the step, or a run without it is not known.
[[nodiscard]] double steps_by(const core::Scene& scene, const std::string& role);

/// Gives a scene whose particles touch after Hertz and that states no modulus one: core::least_modulus, or more where
/// the speeds to expect need it to keep overlaps within dem.max_overlap. Steps are the longer the softer contacts are.
void choose_stiffness(core::Scene& scene);

/// Gives a scene whose particles are coupled to a fluid and that does not say how many of their steps make one of the
/// fluid that number: core::most_fluid_every, or as many as keep the fluid's Courant number below one half.
void choose_fluid_every(core::Scene& scene);

/// What is wrong with the number that a scene states: the fluid is expected to cross a cell in a step, and the run will
/// stop; empty: nothing. \param dt  of the particles, s
[[nodiscard]] std::string fluid_every_warning(const core::Scene& scene, double dt);

/// "step": its length and what sets it. \param greatest_speed  expected, m/s
void write_step(core::Json& json, const dem::StepLimits& limits, double greatest_speed);

/// "overlap": the deepest contact to expect.
void write_overlap(core::Json& json, const dem::OverlapForecast& overlap);

/// Members of an object that is open.
void write_particle_requirements(core::Json& json, const core::Scene& scene, const ParticleRequirements& need);

/// The same for people.
void print_particle_requirements(const core::Scene& scene, const ParticleRequirements& need);

}  // namespace polybed::multiscale
