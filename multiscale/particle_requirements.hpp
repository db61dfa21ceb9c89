// Requirements of a case for the particle model, before its run: particles, memory, time step, steps and time.
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
  int every = 1;     ///< steps of the particles per fluid step
  double step = 0;   ///< s
  double steps = 0;  ///< in the whole run
  std::size_t cells = 0;
  dem::Kernel kernel;
  double memory = 0;     ///< bytes
  std::string warning;   ///< for steps that are too long; empty otherwise
  std::string smearing;  ///< warning about the kernel's width; empty otherwise
};

struct ParticleRequirements {
  std::vector<std::int64_t> numbers;  ///< of each species
  std::vector<std::int64_t> fed;      ///< of each species that enter during the run; empty: no feeds
  dem::StepLimits limits;             ///< the step and its limits
  dem::OverlapForecast overlap;       ///< at the speed used for the step
  double program = 0, particles = 0;  ///< memory, bytes: the program itself; the part that grows with the number
  std::optional<FluidNeed> fluid;     ///< absent without one
  double steps = 0, particle_steps = 0;
  double expected = 0;              ///< CPU time of the run at the given speed, s
  double settling = 0, before = 0;  ///< simulated s until a settling bed is at rest; its part of expected
  [[nodiscard]] std::int64_t count() const;
  /// About a step given by the case, and about contacts that are too soft.
  [[nodiscard]] std::vector<std::string> warnings() const;
  [[nodiscard]] double memory() const { return program + particles + (fluid ? fluid->memory : 0); }
};

/// From the case alone: packs and steps nothing, so it is immediate for any number. Throws core::CaseError for scenes
/// that the particle model could not build.
[[nodiscard]] ParticleRequirements particle_requirements_of(const core::Scene& scene, const ParticleSpeed& speed = {});

/// The same for a run: throws core::CaseError if it needs more memory than is available, and core::StartError if the
/// particles do not fit, unless they are too many to place quickly.
[[nodiscard]] ParticleRequirements placed_requirements_of(const core::Scene& scene);

/// Throws core::CaseError if a run needs more memory than is available. A relatively small case passes unmeasured.
void require_particle_memory(const core::Scene& scene);

/// Value of steps_by from which it is reported.
inline constexpr double many_more_steps = 1.25;

/// Ratio of a particle run's steps with an effect of the scene to those without: 1 if the effect does not shorten the
/// step, or if a run without it is unknown.
[[nodiscard]] double steps_by(const core::Scene& scene, const std::string& role);

/// Sets the modulus of a scene with Hertz contacts that gives none: core::least_modulus, or more if the expected speeds
/// need it to keep overlaps within dem.max_overlap. Softer contacts allow longer steps.
void choose_stiffness(core::Scene& scene);

/// Sets the particle steps per fluid step of a coupled scene that does not give them: core::most_fluid_every, or fewer
/// to keep the fluid's Courant number below one half.
void choose_fluid_every(core::Scene& scene);

/// Warning about the number in a scene if the fluid is expected to cross a cell in a step, which will stop the run;
/// empty otherwise. \param dt  of the particles, s
[[nodiscard]] std::string fluid_every_warning(const core::Scene& scene, double dt);

/// "step": its length and its limits. \param greatest_speed  expected, m/s
void write_step(core::Json& json, const dem::StepLimits& limits, double greatest_speed);

/// "overlap": the deepest expected contact.
void write_overlap(core::Json& json, const dem::OverlapForecast& overlap);

/// Members of an object that is open.
void write_particle_requirements(core::Json& json, const core::Scene& scene, const ParticleRequirements& need);

/// The same for people.
void print_particle_requirements(const core::Scene& scene, const ParticleRequirements& need);

}  // namespace polybed::multiscale
