// Hard cases of transport, symmetry, restarts and grids: T10, T19, T23, T25.
#include <cmath>

#include "hard/cases.hpp"
#include "hard/scenes.hpp"

namespace polybed::hard {

namespace {

/// T10: two species alike but for their names, one above the other, fall as one; their interface, one cell wide at the
/// start, moves through a third of the column. In a window away from top and bottom the fraction of either only jumps
/// once.
void interface_of_one_cell(Trial& trial) {
  core::Scene scene = uniform_bed(1e-3, 2200, 998.207, 1.00157e-3, 0.3, 90, 0.18);
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "upper";
  scene.bed.volume_share = {0.5, 0.5};
  scene.bed.start = {core::StartKind::layered};
  scene.column.closed = true;
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.max_packing = 0.64;
  scene.tfm.fixed_step = 5e-4;
  scene.tfm.pressure_tolerance = 1e-9;  // what is left of div J compresses the fractions; the flux is on trial here
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.5, {.steps = false});
  const measures::Profile profile = profile_of(*run);
  double variation = 0, width = 0;
  for (std::size_t k = 20; k < 70; ++k) {
    variation += std::abs(profile.fraction[0][k] - profile.fraction[0][k - 1]);
    const double share = profile.fraction[0][k] / profile.solids_fraction(k);
    width += share > 0.1 && share < 0.9 ? 1 : 0;
  }
  trial.measure("growth of total variation", variation - std::abs(profile.fraction[0][69] - profile.fraction[0][19]),
                1e-12);
  trial.report("interface, cells of share 0.1 to 0.9", width);
}

/// T19: a run that goes on and one that resumes from its checkpoint, to the bit.
void resumed(Trial& trial) {
  core::Scene scene = two_species(40, 0.12, false);
  scene.bed.static_height = 0.05;
  scene.bed.start_solids_fraction = 0.5;
  scene.inlet.superficial_velocity = {{0.0, 0.02}};
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.137);
  tfm::Model& through = run->model();
  if (trial.naive())
    through.keep_last_state();  // the textbook: what is stored is the state, the run goes on with its history
  else
    through.restart();
  const core::Checkpoint middle = through.checkpoint();
  const auto other = trial.begin(scene);
  other->model().resume(middle);
  for (tfm::Model* model : {&through, &other->model()})
    while (model->time() < 0.3) model->step(0.3);
  double apart = 0;
  through.show(0.3);
  const std::vector<core::Field> phi = through.fields().solids.fraction;
  other->model().show(0.3);
  for (std::size_t j = 0; j < phi.size(); ++j)
    for (std::size_t c = 0; c < phi[j].size(); ++c)
      apart = std::max(apart, std::abs(phi[j][c] - other->model().fields().solids.fraction[j][c]));
  trial.measure("V10 the same bits", apart, 0);
  trial.measure("V10 the same number of steps",
                std::abs(double(through.work().steps) - double(other->model().work().steps)), 0);
}

/// T25: columns of one and two cells, and of 1e5.
void extreme_grids(Trial& trial) {
  for (const auto& [nx, ny] : {std::pair{1, 1}, {1, 2}, {2, 1}, {2, 2}, {1, 100000}}) {
    if (ny > 2 && trial.treatment().flux == "upwind") continue;  // the same stencils, narrower
    core::Scene scene = two_species(ny, 0.1, false);
    scene.column.cells = {nx, ny, 1};
    const double cell = 0.1 / ny;
    scene.column.size = {nx * cell, 0.1, cell};
    scene.column.sides = nx > 1 ? core::Boundary::wall : core::Boundary::periodic;
    scene.bed.static_height = 0.03;
    scene.bed.start_solids_fraction = 0.45;
    scene.inlet.superficial_velocity = {{0.0, 0.02}};
    const auto run = trial.begin(scene);
    trial.advance(*run, ny > 1000 ? 1e-8 : 0.2, {.steps = false});
  }
}

}  // namespace

std::vector<HardCase> transport_cases() {
  return {{"T10", "layers with an interface of one cell", {"central_flux"}, all_schemes(), interface_of_one_cell},
          {"T19", "restart at a random step", {"cold_restart"}, all_schemes(), resumed},
          {"T25", "one cell, two cells, 1e5 cells", {}, all_schemes(), extreme_grids}};
}

}  // namespace polybed::hard
