#include "multiscale/estimate/machine.hpp"

#include <cstdlib>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/output/json_value.hpp"
#include "core/timers.hpp"
#include "core/version.hpp"
#include "dem/model.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/run_record.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {

namespace {

constexpr const char* filetype = "polybed machine";

/// System B's two sizes; in the liquid the bed starts at a solids fraction of 0.3, where the fluid carries it.
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
[run]
until = "100 s"
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

core::Scene scene_in(const std::string& fluid, const std::vector<std::string>& overrides) {
  return core::parse_case(solids + fluid, "the bed that measures the machine", overrides, all_roles(), size_classes);
}

/// CPU seconds of a step, after some that are not counted.
template <class Model>
double seconds_of_step(const core::Scene& scene, double seconds) {
  core::Timers timers;
  Model model(scene, timers);
  for (int n = 0; n < 5; ++n) model.step(scene.run.until);
  const double begin = core::cpu_seconds();
  double spent = 0;
  int steps = 0;
  for (; spent < seconds; ++steps, spent = core::cpu_seconds() - begin) model.step(scene.run.until);
  return spent / steps;
}

}  // namespace

double tfm_step_seconds(const Machine& machine, bool implicit, double cells, std::size_t species, int dimensions) {
  constexpr double measured_phases = 3, three_dimensions = 1.4;
  const double phases = double(species + 1) / measured_phases, more = dimensions == 3 ? three_dimensions : 1;
  return machine.tfm_step + (implicit ? machine.implicit_step : machine.explicit_step) * phases * more * cells;
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
  if (path.empty() || !std::filesystem::exists(path)) return {};
  try {
    const Machine machine = machine_of_text(core::read_text(path));
    return machine.processor == processor() ? machine : Machine{};
  } catch (const core::FileError&) {
    return {};
  }
}

Machine measure_machine(double seconds) {
  Machine machine;
  const core::Scene scene = scene_in(liquid, {"tfm.integrator=explicit"});
  const double cells = scene.column.cells[0] * scene.column.cells[1], each = seconds / 4;
  machine.explicit_step = seconds_of_step<tfm::Model>(scene, each) / cells;
  machine.implicit_step = seconds_of_step<tfm::Model>(scene_in(liquid, {"tfm.integrator=implicit"}), each) / cells;
  const ParticleSpeed shipped;
  const double particles = double(scene.bed.particles[0] + scene.bed.particles[1]);
  const core::Scene dry = scene_in(no_fluid, {"bed.start_solids_fraction=0.5"});
  machine.particles.particle_step = seconds_of_step<dem::Model>(dry, each) / particles;
  const double step = seconds_of_step<dem::Model>(scene_in(liquid, {"bed.start_solids_fraction=0.5"}), each);
  const double every = scene.dem.fluid_every;
  const double expected = shipped.particle_step_in_fluid * particles + shipped.step +
                          (shipped.fluid_step + shipped.exchange * particles + shipped.cell * cells) / every;
  machine.particles.particle_step_in_fluid *= step / expected;
  machine.particles.exchange *= step / expected;
  machine.particles.cell *= step / expected;
  machine.measured = true;
  machine.processor = processor();
  return machine;
}

std::string machine_text(const Machine& machine) {
  core::Json json;
  json.begin_object().member("filetype", filetype).member("version", 1).member("git_commit", core::git_commit());
  json.member("processor", machine.processor).member("explicit_cell_step_s", machine.explicit_step);
  json.member("implicit_cell_step_s", machine.implicit_step).member("tfm_step_s", machine.tfm_step);
  json.member("particle_step_s", machine.particles.particle_step);
  json.member("particle_step_in_fluid_s", machine.particles.particle_step_in_fluid);
  json.member("exchange_s", machine.particles.exchange).member("fluid_cell_step_s", machine.particles.cell);
  return json.end_object().text();
}

Machine machine_of_text(const std::string& text) {
  const core::JsonValue json = core::parse_json(text);
  if (json.of("filetype").text() != filetype || json.of("version").number() != 1)
    throw core::FileError("no \"polybed machine\" of version 1");
  Machine machine;
  machine.measured = true;
  machine.processor = json.of("processor").text();
  machine.explicit_step = json.of("explicit_cell_step_s").number();
  machine.implicit_step = json.of("implicit_cell_step_s").number();
  machine.tfm_step = json.of("tfm_step_s").number();
  machine.particles.particle_step = json.of("particle_step_s").number();
  machine.particles.particle_step_in_fluid = json.of("particle_step_in_fluid_s").number();
  machine.particles.exchange = json.of("exchange_s").number();
  machine.particles.cell = json.of("fluid_cell_step_s").number();
  return machine;
}

}  // namespace polybed::multiscale
