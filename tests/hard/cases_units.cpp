// V12: a run whose numbers are those of other units gives the same bed. A constant with a hidden unit would show.
#include <algorithm>
#include <cmath>

#include "hard/cases.hpp"
#include "hard/other_units.hpp"
#include "hard/scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::hard {

namespace {

/// Those that V12 names, in which velocities have the numbers of SI, and others in which they have not.
const UnitSystem millimetres{"mm, g, ms", 1e3, 1e3, 1e3}, centimetres{"cm, g, s", 1e2, 1e3, 1};

/// Greatest difference of two fields, the second divided by a factor, over the greatest value of the first.
double apart(const core::Grid& grid, const core::Field& one, const core::Field& other, double factor) {
  double most = 0, scale = 0;
  core::for_each_row(grid, [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      most = std::max(most, std::abs(one[c] - other[c] / factor));
      scale = std::max(scale, std::abs(one[c]));
    }
  });
  return scale > 0 ? most / scale : most;
}

/// Water, two species, walls, every exchange.
core::Scene liquid_bed() {
  core::Scene scene = between_walls(two_species(20, 0.06, false), 6);
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.56;
  scene.inlet.superficial_velocity = {{0.0, 0.02}, {0.01, 0.02}, {0.02, 0.03}};
  scene.effects["fluid_stress"] = "newtonian";
  scene.effects["solids_viscosity"] = "schaeffer";
  scene.tfm.fixed_step = 2e-4;
  return scene;
}

/// Air, two sizes, granular temperatures of their own, walls with partial slip.
core::Scene gas_bed() {
  core::Scene scene = between_walls(uniform_bed(0.5e-3, 2500, 1.2, 1.8e-5, 0.6, 20, 0.06), 6);
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "coarse";
  scene.species[1].diameter = 0.8e-3;
  scene.bed.volume_share = {0.5, 0.5};
  scene.effects = {{"drag", "gidaspow"},
                   {"solids_stress", "kinetic"},
                   {"granular_temperature", "transported"},
                   {"solids_viscosity", "schaeffer"},
                   {"species_exchange", "syamlal"}};
  scene.tfm.solids_wall = core::SolidsWall::johnson_jackson;
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.55;
  scene.inlet.superficial_velocity = {{0.0, 0.6}};
  scene.tfm.fixed_step = 1e-5;
  return scene;
}

/// Runs a scene in SI and in other units to the same time: fractions, velocities and pressure. Implicit steps have no
/// length of their own: their error test and Newton's must see the same, too.
void same_in(Trial& trial, const std::string& id, core::Scene scene, const UnitSystem& units, double until) {
  scene.tfm.pressure_tolerance = 1e-13;
  const core::Scene other = in_units(scene, units);
  const auto a = trial.begin(scene);
  trial.advance(*a, until, {.steps = false, .packing = false});
  const auto b = trial.begin(other);
  trial.advance(*b, until * units.time, {.steps = false, .packing = false});
  const tfm::Fields &one = a->fields(), &two = b->fields();
  const core::Grid& grid = a->model().constants().grid;
  const double velocity = number_of_one(core::dimension::velocity, units);
  double most = apart(grid, one.fluid.pressure, two.fluid.pressure, number_of_one(core::dimension::pressure, units));
  for (std::size_t j = 0; j < one.solids.species(); ++j) {
    most = std::max(most, apart(grid, one.solids.fraction[j], two.solids.fraction[j], 1));
    most = std::max(most, apart(grid, one.solids.velocity[j][1], two.solids.velocity[j][1], velocity));
  }
  trial.measure("V12 " + id + " in " + units.name, most, 1e-12);
  trial.report("V12 " + id + " in " + units.name, most);
}

void continuum(Trial& trial) {
  for (const UnitSystem& units : {millimetres, centimetres}) {
    same_in(trial, "liquid", liquid_bed(), units, 0.01);
    if (!trial.naive()) same_in(trial, "gas", gas_bed(), units, 5e-4);  // textbook runs know no granular temperature
  }
}

std::vector<scenes::Bead> in_units(std::vector<scenes::Bead> beads, const UnitSystem& units) {
  for (scenes::Bead& bead : beads)
    for (std::size_t d = 0; d < 3; ++d) {
      bead.x[d] *= units.length;
      bead.v[d] *= number_of_one(core::dimension::velocity, units);
      bead.w[d] /= units.time;
    }
  return beads;
}

/// Particles in SI and in other units after as many steps of one length: places over a diameter.
void same_beads(Trial& trial, core::Scene scene, const std::vector<scenes::Bead>& beads, int steps) {
  scene.dem.fixed_step = scenes::Beads(scene, beads).dt();
  for (const UnitSystem& units : {millimetres, centimetres}) {
    scenes::Beads one(scene, beads), other(in_units(scene, units), in_units(beads, units));
    one.steps(steps);
    other.steps(steps);
    double most = 0;
    for (std::size_t n = 0; n < beads.size(); ++n)
      for (std::size_t d = 0; d < 3; ++d)
        most = std::max(most,
                        std::abs(one.place(std::int64_t(n)).x[d] - other.place(std::int64_t(n)).x[d] / units.length));
    trial.measure("V12 places in " + units.name, most / scene.species[0].diameter, 1e-12);
  }
}

/// Two beads meet askew above a floor that one of them lies on, a third falls: contacts, friction, walls, gravity.
std::pair<core::Scene, std::vector<scenes::Bead>> a_few_beads() {
  constexpr double r = 0.5e-3;
  core::Scene scene = scenes::dry_box(r, {5e6, 0.25, 2500}, {0.01, 0.01, 0.01});
  scene.column.gravity = 9.81;
  return {scene,
          {{"a", {5e-3, 0.999 * r, 5e-3}},
           {"a", {5.3e-3, 2.9 * r, 5.1e-3}, {0, -0.2, 0.1}, {10, 0, -20}},
           {"a", {4.5e-3, 4.8 * r, 5e-3}, {0.1, -0.1, 0}}}};
}

void particles(Trial& trial) {
  const auto [scene, beads] = a_few_beads();
  same_beads(trial, scene, beads, 200);
}

void coupled(Trial& trial) {
  core::Scene scene = scenes::wet_box(1e-3, 2500, scenes::water, {0.01, 0.01, 0.01}, {5, 5, 5});
  scene.column.gravity = 9.81;
  scene.tfm.pressure_tolerance = 1e-13;
  scene.dem.fluid_every = 4;
  same_beads(trial, scene, a_few_beads().second, 100);
}

}  // namespace

std::vector<HardCase> unit_cases() {
  return {{"V12", "the same bed in other units", {"hidden_unit"}, all_schemes(), continuum},
          {"V12 beads", "dry particles in other units", {}, {{"particles", "", ""}}, particles},
          {"V12 wet", "particles in a fluid in other units", {}, {{"coupled", "", ""}}, coupled}};
}

}  // namespace polybed::hard
