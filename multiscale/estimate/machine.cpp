#include "multiscale/estimate/machine.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/timers.hpp"
#include "core/version.hpp"
#include "dem/model.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/run_record.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {

namespace {

constexpr const char* filetype = "polybed machine";
constexpr int version = 2;

/// System B's two sizes; in the liquid the bed starts at a solids fraction of 0.3, where the fluid suspends it.
constexpr const char* solids = R"(
[column]
size = ["60 mm", "300 mm"]
depth = "4.2 mm"
cells = [18, 96]
[[species]]
name = "fine"
diameter = "0.807 mm"
density = 1395
[[species]]
name = "coarse"
diameter = "2.010 mm"
density = 1170
[bed]
particles = [10000, 500]
solids_fraction = 0.62
start_solids_fraction = 0.3
[dem]
greatest_speed = "0.3 m/s"
[tfm]
rtol = 1e-3
)";
constexpr const char* liquid = R"(
[fluid]
name = "liquid"
density = 999.19
viscosity = "1.14e-3 Pa s"
[inlet]
superficial_velocity = "20 mm/s"
[effects]
drag = "cello"
solids_stress = "frictional"
contact = "hertz_mindlin"
)";
constexpr const char* no_fluid = R"(
[fluid]
name = "none"
[effects]
contact = "hertz_mindlin"
)";

core::Scene scene_in(const std::string& fluid, double until, std::vector<std::string> overrides) {
  overrides.push_back(fmt::format("run.until={}", until));
  return core::parse_case(solids + fluid, "the bed that measures the machine", overrides, all_roles(), size_classes);
}

/// CPU seconds of a step, after some uncounted ones, over so many CPU seconds or to the end of the case.
template <class Model>
double seconds_of_step(const core::Scene& scene, double seconds) {
  core::Timers timers;
  Model model(scene, timers);
  for (int n = 0; n < 5; ++n) model.step(scene.run.until);
  const double begin = core::cpu_seconds();
  double spent = 0;
  int steps = 0;
  for (; spent < seconds && model.time() < scene.run.until; ++steps, spent = core::cpu_seconds() - begin)
    model.step(scene.run.until);
  return spent / steps;
}

}  // namespace

double tfm_step_seconds(const Machine& machine, bool implicit, double cells, std::size_t species, int dimensions) {
  constexpr double measured_phases = 3, three_dimensions = 1.4;
  const double phases = double(species + 1) / measured_phases, more = dimensions == 3 ? three_dimensions : 1;
  return machine.tfm_step + (implicit ? machine.implicit_step : machine.explicit_step) * phases * more * cells;
}

double fluid_step_seconds(const ParticleSpeed& speed, double particles, double cells, bool diffusion) {
  return (diffusion ? speed.diffusion : 1) * (speed.fluid_step + speed.exchange * particles + speed.cell * cells);
}

std::filesystem::path machine_file() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache != nullptr && *cache != '\0') return std::filesystem::path(cache) / "polybed/machine.json";
  if (home != nullptr && *home != '\0') return std::filesystem::path(home) / ".cache/polybed/machine.json";
  return {};
}

Machine known_machine() {
  const std::filesystem::path path = machine_file();
  std::error_code closed;  // a home directory that is not readable
  if (path.empty() || !std::filesystem::exists(path, closed)) return {};
  try {
    const Machine machine = machine_of_text(core::read_text(path));
    return machine.processor == processor() ? machine : Machine{};
  } catch (const core::FileError&) {
    return {};
  }
}

Machine measure_machine(double seconds, double until) {
  Machine machine;
  const core::Scene scene = scene_in(liquid, until, {"tfm.integrator=explicit"});
  const double cells = scene.column.cells[0] * scene.column.cells[1], each = seconds / 5;
  machine.explicit_step = seconds_of_step<tfm::Model>(scene, each) / cells;
  machine.implicit_step =
      seconds_of_step<tfm::Model>(scene_in(liquid, until, {"tfm.integrator=implicit"}), each) / cells;
  ParticleSpeed& speed = machine.particles;
  const double particles = double(scene.bed.particles[0] + scene.bed.particles[1]);
  const auto of_particles = [&](const char* fluid, int every) {
    return seconds_of_step<dem::Model>(
        scene_in(fluid, until, {"bed.start_solids_fraction=0.5", fmt::format("dem.fluid_every={}", every)}), each);
  };
  speed.particle_step = of_particles(no_fluid, core::most_fluid_every) / particles;
  constexpr int often = 2;
  const double rarely_solved = of_particles(liquid, core::most_fluid_every), often_solved = of_particles(liquid, often);
  const double fluid = (often_solved - rarely_solved) / (1.0 / often - 1.0 / core::most_fluid_every);
  const bool diffusion = particle_requirements_of(scene_in(liquid, until, {})).fluid->kernel.width > 0;
  const double ratio = fluid / fluid_step_seconds(speed, particles, cells, diffusion);
  speed.particle_step_in_fluid = (often_solved - fluid / often) / particles;
  for (double* part : {&speed.fluid_step, &speed.exchange, &speed.cell}) *part *= ratio;
  machine.measured = true;
  machine.processor = processor();
  return machine;
}

std::string machine_text(const Machine& machine) {
  return core::json_text({{"filetype", filetype},
                          {"version", version},
                          {"git_commit", core::git_commit()},
                          {"processor", machine.processor},
                          {"explicit_cell_step_s", machine.explicit_step},
                          {"implicit_cell_step_s", machine.implicit_step},
                          {"tfm_step_s", machine.tfm_step},
                          {"particle_step_s", machine.particles.particle_step},
                          {"particle_step_in_fluid_s", machine.particles.particle_step_in_fluid},
                          {"exchange_s", machine.particles.exchange},
                          {"fluid_cell_step_s", machine.particles.cell},
                          {"fluid_step_s", machine.particles.fluid_step}});
}

Machine machine_of_text(const std::string& text) {
  const core::Json json = core::parse_json(text);
  const auto number = [&](const char* name) { return core::number_of(core::member_of(json, name)); };
  if (core::text_of(core::member_of(json, "filetype")) != filetype || number("version") != version)
    throw core::FileError(fmt::format("no \"{}\" of version {}", filetype, version));
  Machine machine;
  machine.measured = true;
  machine.processor = core::text_of(core::member_of(json, "processor"));
  machine.explicit_step = number("explicit_cell_step_s");
  machine.implicit_step = number("implicit_cell_step_s");
  machine.tfm_step = number("tfm_step_s");
  machine.particles.particle_step = number("particle_step_s");
  machine.particles.particle_step_in_fluid = number("particle_step_in_fluid_s");
  machine.particles.exchange = number("exchange_s");
  machine.particles.cell = number("fluid_cell_step_s");
  machine.particles.fluid_step = number("fluid_step_s");
  return machine;
}

}  // namespace polybed::multiscale
