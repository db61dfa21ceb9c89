// Small scenes of both models, to be counted instruction by instruction: of particles without lift and cohesion, of a
// continuum without lift, added mass, the exchange of species and the viscosity of packed solids. Built once with the
// whole models, and once bare, without the lines of those effects in the lists. What it prints is what an absent effect
// must not change.
#include <fmt/format.h>

#include "absent/control.hpp"
#include "core/case/file.hpp"
#include "core/timers.hpp"
#include "dem/effects/maker.hpp"
#include "dem/model.hpp"
#include "tfm/model.hpp"

namespace {

using namespace polybed;

const char* const text = R"(
title = "absent"
column = { size = ["6 mm", "4 mm", "10 mm"], cells = [3, 2, 5] }
fluid = { name = "water", temperature = "20 degC" }
bed = { volume_share = [1], static_height = "2 mm", solids_fraction = 0.5, start_solids_fraction = 0.35 }
inlet = { superficial_velocity = "20 mm/s" }
effects = { contact = "hertz_mindlin", lubrication = "wet_restitution" }
run = { until = "1 s" }
dem = { start_speed = "0.2 m/s", greatest_speed = "2 m/s" }
[[species]]
name = "beads"
diameter = "1 mm"
density = 2500
)";

const char* const continuum = R"(
title = "absent"
column = { size = ["6 mm", "12 mm"], cells = [3, 6] }
fluid = { name = "water", temperature = "20 degC" }
bed = { volume_share = [0.5, 0.5], static_height = "5 mm", solids_fraction = 0.55 }
inlet = { superficial_velocity = "20 mm/s" }
effects = { drag = "cello", solids_stress = "frictional", fluid_stress = "newtonian" }
run = { until = "1 s" }
tfm = { integrator = "explicit", fixed_step = "0.5 ms" }
[[species]]
name = "fine"
diameter = "0.5 mm"
density = 2500
[[species]]
name = "coarse"
diameter = "1 mm"
density = 2000
)";

std::size_t bytes_of(const core::Checkpoint& checkpoint) {
  std::size_t bytes = 0;
  for (const auto& [name, array] : checkpoint.arrays) bytes += name.size() + array.size() * sizeof(double);
  bytes += checkpoint.numbers.size() * sizeof(double) + checkpoint.integers.size() * sizeof(std::int64_t);
  return bytes;
}

void particles() {
  core::Scene scene = core::parse_case(text, "absent", {}, dem::roles());
  scene.effects["drag"] = "cello";
  core::Timers timers;
  dem::Model model(scene, timers);
  for (int n = 0; n < 60; ++n) model.step(1e300);
  fmt::print("reach {}\ncontact memory {}\nside rows {}\nvorticity {}\n", model.laws().reach(),
             model.laws().memory_size(), model.coupling()->sides().rows().width,
             model.coupling()->sides().needs_vorticity());
  for (const dem::StepLimit& limit : model.limits().all) fmt::print("limit {} {}\n", limit.name, limit.dt);
  fmt::print("contact steps {}\n", model.work().contact_steps);
  fmt::print("checkpoint {}\n", bytes_of(model.checkpoint()));
}

void run_continuum() {
  const core::Scene scene = core::parse_case(continuum, "absent", {}, tfm::roles());
  core::Timers timers;
  tfm::Model model(scene, timers);
  for (int n = 0; n < 10; ++n) model.step(1e300);
  fmt::print("unknowns {}\ncontinuum steps {}\ncheckpoint {}\n", model.checkpoint().arrays.at("state").size(),
             model.work().steps, bytes_of(model.checkpoint()));
}

}  // namespace

int main() {
  particles();
  run_continuum();
  fmt::print("control {}\n", absent::control_kernel(1000));
}
