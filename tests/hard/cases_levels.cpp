// Hard case of one scene as a continuum and as particles: C12.
#include <cmath>
#include <span>
#include <vector>

#include "core/numerics/random.hpp"
#include "dem/coupling/coupling.hpp"
#include "hard/cases.hpp"
#include "measures/bed.hpp"
#include "measures/particle_profile.hpp"
#include "measures/time_mean.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::hard {

namespace {

/// What both models measure, sample by sample.
struct Series {
  std::vector<double> height, centre, drop;
};

constexpr double diameter = 2e-3, solids_density = 2500, liquid_density = 1000, liquid_viscosity = 0.03,
                 velocity = 30e-3;
constexpr double until = 1.6, sphere = scenes::pi / 6 * diameter * diameter * diameter, gravity = 9.81;  // s, m3
constexpr int particles = 160, samples = 160;

/// 160 glass beads of 2 mm in a viscous liquid, expanded, in a column joined on its sides.
core::Scene bed_of_beads() {
  core::Scene scene =
      scenes::wet_box(diameter, solids_density, {liquid_density, liquid_viscosity}, {12e-3, 48e-3, 12e-3}, {4, 16, 4});
  scene.column.closed = false;
  scene.column.sides = core::Boundary::periodic;
  scene.column.gravity = gravity;
  scene.inlet.superficial_velocity = {{0.0, velocity}};
  scene.effects = {{"drag", "cello"}, {"contact", "hertz_mindlin"}, {"solids_stress", "frictional"}};
  scene.dem.youngs_modulus = 1e6;
  scene.dem.kernel = core::Kernel::diffusion;
  scene.dem.own_share = core::OwnShare::removed;
  scene.dem.fluid_every = 8;
  scene.dem.greatest_speed = 0.15;
  scene.dem.ledger = false;
  scene.run.until = until;
  return scene;
}

void keep(Series& series, const measures::Profile& profile, double drop) {
  series.height.push_back(measures::bed_height(profile).value());
  series.centre.push_back(measures::centre(profile, 0).value());
  series.drop.push_back(drop);
}

Series as_particles(const core::Scene& scene) {
  std::vector<scenes::Bead> beads;
  for (std::uint64_t n = 0; n < particles; ++n)  // ten layers of a lattice, shaken a little
    beads.push_back({"a",
                     {(double(n % 4) + 0.4 + 0.2 * core::uniform(7, 0, n)) * 3e-3,
                      (double(n / 16) + 0.4 + 0.2 * core::uniform(7, 1, n)) * 3e-3,
                      (double(n / 4 % 4) + 0.4 + 0.2 * core::uniform(7, 2, n)) * 3e-3}});
  scenes::Beads run(scene, beads);
  Series series;
  for (int n = 1; n <= samples; ++n) {
    run.until(n * until / samples);
    const dem::Coupling& coupling = *run.model.coupling();
    const core::Grid& grid = coupling.flow().grid();
    keep(series, {grid.spacing[1], {measures::lateral_mean(grid, coupling.fraction()[0])}, {}},
         coupling.pressure_drop());
  }
  return series;
}

/// In one row of cells: a bed this narrow is even across.
Series as_continuum(core::Scene scene) {
  scene.column.dimensions = 2;
  scene.column.cells = {1, 2 * scene.column.cells[1], 1};
  scene.bed.volume_share = {1.0};
  scene.bed.solids_fraction = 0.6;
  scene.bed.static_height = particles * sphere / (0.6 * scene.column.size[0] * scene.column.size[2]);
  scene.bed.start_solids_fraction = 0.3;
  core::Timers timers;
  tfm::Model model(scene, timers);
  Series series;
  for (int n = 1; n <= samples; ++n) {
    while (model.time() < n * until / samples) model.step(n * until / samples);
    model.show(model.time());
    const core::Grid& grid = model.constants().grid;
    const tfm::Fields& fields = model.fields();
    const measures::Profile profile{grid.spacing[1],
                                    {measures::lateral_mean(grid, fields.solids.fraction[0])},
                                    measures::lateral_mean(grid, fields.fluid.pressure)};
    keep(series, profile, measures::pressure_drop(profile));
  }
  return series;
}

measures::TimeMean later_half(const std::vector<double>& values) {
  return measures::time_mean(std::span(values).subspan(values.size() / 2)).value();
}

/// C12: one bed of beads by both models: what they measure is the same, within the intervals of the means and what the
/// drag law itself is off by.
void both_models(Trial& trial) {
  const Series one = as_continuum(bed_of_beads()), other = as_particles(bed_of_beads());
  const double weight = particles * sphere * (solids_density - liquid_density) * gravity / (12e-3 * 12e-3);
  const auto compare = [&](const std::string& what, const std::vector<double>& a, const std::vector<double>& b,
                           double scale) {
    constexpr double drag_error = 0.025;  // mean of the law against its data, docs/record/accuracy.md
    const measures::TimeMean p = later_half(a), q = later_half(b);
    const double interval = std::hypot(p.interval.value_or(0), q.interval.value_or(0));
    trial.report(what + " of the continuum", p.mean);
    trial.report(what + " of particles", q.mean);
    trial.measure(what + " apart", std::abs(p.mean - q.mean) / scale, drag_error + interval / scale);
  };
  compare("bed height, m,", one.height, other.height, later_half(one.height).mean);
  compare("centre, m,", one.centre, other.centre, later_half(one.centre).mean);
  compare("pressure drop, Pa,", one.drop, other.drop, weight);
}

}  // namespace

std::vector<HardCase> level_cases() {
  return {{"C12", "one bed by both models", {}, {{"both", "", ""}}, both_models, false}};
}

}  // namespace polybed::hard
