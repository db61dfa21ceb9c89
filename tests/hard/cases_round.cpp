// Hard cases of tubes whose wall cuts cells, T29 to T33, and of particles in a cone, D16 and C13.
#include <cmath>

#include "hard/cases.hpp"
#include "hard/grains.hpp"
#include "hard/scenes.hpp"
#include "scenes/beads.hpp"

namespace polybed::hard {

namespace {

/// A scene of one row of cells in a tube as wide as so many of them.
core::Scene in_tube(core::Scene scene, int across, int deep) {
  core::Column& column = scene.column;
  column.shape = core::ColumnShape::cylinder;
  column.sides = core::Boundary::wall;
  column.dimensions = 3;
  column.cells[0] = across;
  column.cells[2] = deep;
  column.size[0] = column.size[2] = across * column.size[0];
  scene.tfm.max_packing = 0.62;
  return scene;
}

/// T29: of 13 by 8 cells across the least that stand alone are open by 0.504. Two species are lifted and let fall upon
/// the distributor.
void slivers(Trial& trial) {
  core::Scene scene = in_tube(two_species(16, 0.048, false), 13, 8);
  scene.column.size[0] = scene.column.size[2] = 0.03;
  scene.bed.static_height = 0.018;
  scene.bed.start_solids_fraction = 0.55;
  scene.inlet.superficial_velocity = {{0.0, 0.04}, {0.15, 0.04}, {0.15, 0.0}};
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.4);
}

/// 0.5 mm glass in air, minimum fluidisation at 0.21 m/s, in a tube of 32 mm.
core::Scene gas_bed() {
  core::Scene scene = in_tube(uniform_bed(0.5e-3, 2500, 1.2, 1.8e-5, 0.6, 20, 0.08), 8, 8);
  scene.effects = {{"drag", "ergun"}, {"solids_stress", "frictional"}};
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.58;
  return scene;
}

/// T30: two jets of twenty times minimum fluidisation, one through a cell that has taken up its two cut neighbours, one
/// along the wall.
void jets_at_the_wall(Trial& trial) {
  core::Scene scene = gas_bed();
  scene.inlet.superficial_velocity = {{0.0, 0.2}};
  scene.jets.push_back({{0.005, 0.005}, {0.009, 0.009}, {{0.0, 4.2}}});
  scene.jets.push_back({{0.027, 0.014}, {0.0315, 0.018}, {{0.0, 4.2}}});
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.06);
}

/// Glass of 1.2 mm in water, in a tube of 45 mm.
core::Scene liquid_bed() {
  core::Scene scene = in_tube(uniform_bed(1.2e-3, 2700, 998.207, 1.00157e-3, 0.6, 20, 0.1), 9, 9);
  scene.effects["solids_stress"] = "frictional";
  return scene;
}

/// T31: a suspension settles to the maximum packing, and the bed is held.
void packed_in_a_tube(Trial& trial) {
  core::Scene scene = liquid_bed();
  scene.column.closed = true;
  scene.bed.static_height = 0.05;
  scene.bed.start_solids_fraction = 0.4;
  const auto run = trial.begin(scene);
  trial.advance(*run, 2.0, {.settles = true});
}

/// T32: solids are fed beside the wall into a bed that stands packed above the feed.
void feed_into_a_packed_bed(Trial& trial) {
  core::Scene scene = liquid_bed();
  scene.column.outlet = core::Outlet::open;
  scene.bed.static_height = 0.04;
  scene.inlet.superficial_velocity = {{0.0, 0.002}};
  scene.feeds.push_back({"solid", core::ColumnFace::bottom, {{0.0, 0.01}}, 0.05, {0.002, 0.018}, {0.012, 0.027}});
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.5);
  const double fed = 0.01 * 0.010 * 0.009 * 0.5;  // area and time
  trial.measure("fed as prescribed", std::abs(run->model().passed()[0].in / fed - 1), 1e-9);
}

/// T33: the bed is carried out at the open top, also beside the wall, until none is left in the lower half.
void carried_out(Trial& trial) {
  core::Scene scene = liquid_bed();
  scene.column.outlet = core::Outlet::open;
  scene.bed.static_height = 0.07;
  scene.inlet.superficial_velocity = {{0.0, 0.30}, {0.32, 0.30}, {0.32, 0.05}};
  const auto run = trial.begin(scene);
  double out = 0;
  for (int n = 1; n <= 10; ++n) {
    trial.advance(*run, 0.05 * n, {.steps = n == 10});
    const double now = run->model().passed()[0].out;
    trial.measure("solids that come in by the outlet", std::max(out - now, 0.0), 1e-12 * now);  // a sum is rounded
    out = now;
  }
  trial.report("share of the bed that has left",
               out / (out + measures::species_volumes(run->model().constants().grid, run->fields().solids)[0]));
}

/// 600 beads of 1 mm above the bottom of a cone of 60 degrees, which ends at a tube of 20 mm; dry.
core::Scene beads_in_a_cone() {
  core::Scene scene = scenes::dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.02, 0.04, 0.02});
  scene.column.shape = core::ColumnShape::cylinder;
  scene.column.profile = {{0, 0.01}, {0.00866, 0.02}, {0.04, 0.02}};
  scene.column.cells = {8, 16, 8};
  scene.column.gravity = 9.81;
  scene.bed.particles = {600};
  scene.bed.solids_fraction = 0.6;
  scene.bed.start_solids_fraction = 0.45;
  core::set_friction(scene, 0.4);
  core::set_restitution(scene, 0.5);
  return scene;
}

/// Energy of motion over what lifts each by its radius.
double unrest(const dem::Model& model) {
  const double lift = double(model.particle_count()) * scenes::mass_of(0.5e-3, 2500) * 9.81 * 0.5e-3;
  return dem::totals_of(model).kinetic / lift;
}

/// D16: beads fall into a cone, pack, and are held by its wall.
void packed_in_a_cone(Trial& trial) {
  const core::Scene scene = beads_in_a_cone();
  core::Timers timers;
  dem::Model model(scene, timers);
  Grains(trial, model).until(0.4);
  trial.measure("V6 energy of motion over that of rest", unrest(model), 1e-6);
  double beyond = 0;
  for (const dem::Place& place : model.particles().place)
    beyond = std::max(beyond, model.box().within_side({place.x, 0.95 * place.radius}) ? 0.0 : 1.0);
  trial.measure("beads beyond the wall", beyond, 0);
}

/// C13: water lifts the same beads out of their cone into the tube, and stops: they pack again, at rest in clear water.
void lifted_from_a_cone(Trial& trial) {
  core::Scene scene = beads_in_a_cone();
  scene.fluid.name = "test fluid";
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 1e-3;
  scene.effects["drag"] = "gidaspow";
  scene.dem.kernel = core::Kernel::bilinear;
  scene.dem.fluid_every = 8;
  scene.inlet.superficial_velocity = {{0.0, 0.15}, {0.15, 0.15}, {0.15, 0.0}};
  core::Timers timers;
  dem::Model model(scene, timers);
  Grains grains(trial, model);
  grains.until(0.15);
  double drop = 0;
  for (int n = 0; n < 10; ++n) {
    grains.steps(8);
    drop += model.coupling()->pressure_drop() / 10;
  }
  trial.report("pressure drop while it is lifted, Pa", drop);
  grains.until(1.0);
  trial.measure("V6 energy of motion over that of rest", unrest(model), 1e-4);
}

}  // namespace

std::vector<HardCase> round_cases() {
  return {
      {"T29", "tube of 13 by 8 cells, some half open: lifted, let fall", {}, all_schemes(), slivers},
      {"T30", "tube: jets at 20 u_mf along its wall and through a merged cell", {}, all_schemes(), jets_at_the_wall},
      {"T31", "tube: settle to the maximum packing and hold", {"hard_packing"}, all_schemes(), packed_in_a_tube},
      {"T32", "tube: feed into a packed bed", {}, all_schemes(), feed_into_a_packed_bed},
      {"T33", "tube: a bed carried out at the top", {}, all_schemes(), carried_out},
      {"D16", "cone: beads fall in, pack and are held", {}, {{"particles", "", ""}}, packed_in_a_cone},
      {"C13", "cone: beads lifted by water, let fall", {}, {{"coupled", "", ""}}, lifted_from_a_cone}};
}

}  // namespace polybed::hard
