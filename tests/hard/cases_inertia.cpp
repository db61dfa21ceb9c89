// Hard cases of forces that follow the fluid's acceleration and shear: T27, T28.
#include <algorithm>
#include <cmath>

#include "closures/added_mass.hpp"
#include "hard/cases.hpp"
#include "hard/scenes.hpp"

namespace polybed::hard {

namespace {

constexpr double light = 10, liquid = 998.207, released_fraction = 0.1;  // kg/m3, kg/m3, -

/// Spheres of 1 mm and 10 kg/m3 in water, evenly over a closed column.
core::Scene light_suspension() {
  core::Scene scene = uniform_bed(1e-3, light, liquid, 1.00157e-3, released_fraction, 40, 0.08);
  scene.column.closed = true;
  scene.effects = {{"drag", "cello"}, {"solids_stress", "frictional"}, {"added_mass", "zuber"}};
  scene.tfm.max_packing = 0.62;
  return scene;
}

/// Acceleration upwards of spheres released in a suspension without flux, m/s2. From the equations of both phases by
/// hand: eps U_f = -phi U, and the pressure between them gone, leave
///   (rho_s + rho_f phi/eps + C rho_f/eps^2) dU/dt = (rho_f - rho_s) g.
double released_at(double solids_fraction) {
  const double eps = 1 - solids_fraction, carried = closures::added_mass_zuber(solids_fraction) * liquid;
  return (liquid - light) * 9.81 / (light + liquid * solids_fraction / eps + carried / (eps * eps));
}

/// T27: added mass is 67 times the solids' own. Released, they accelerate as the equations of both phases say, then
/// rise to a bed that hangs under the top.
void light_release(Trial& trial) {
  constexpr double soon = 5e-5;  // s, of 0.04 s in which drag acts
  const auto start = trial.begin(light_suspension());
  trial.advance(*start, soon, {.steps = false});
  const double velocity =
      start->fields().solids.velocity[0][1][std::size_t(start->model().constants().grid.index(0, 20))];
  trial.measure("acceleration of the release", std::abs(velocity / (released_at(released_fraction) * soon) - 1), 5e-3);
  const auto run = trial.begin(light_suspension());
  trial.advance(*run, 4);
  const measures::Profile profile = profile_of(*run);
  double below = 0;
  for (std::size_t k = 0; k < 20; ++k) below = std::max(below, profile.fraction[0][k]);
  trial.measure("solids left below the bed that hangs", below, 1e-3);
}

/// T28: a bed of two species between no-slip walls with lift, added mass and the fluid's viscous stress, a hundredth
/// denser on one side; the inlet is stepped up and shut. At steps of one length the bed that is denser on the other
/// side is its mirror image (V11).
void lifted_bed(Trial& trial) {
  core::Scene scene = between_walls(two_species(40, 0.12, false), 8);
  scene.effects["lift"] = "saffman_mei";
  scene.effects["added_mass"] = "zuber";
  scene.effects["fluid_stress"] = "newtonian";
  scene.bed.start_solids_fraction = 0.5;
  scene.bed.static_height = 0.04;
  scene.inlet.superficial_velocity = {{0.0, 0.02}, {0.5, 0.02}, {0.5, 0.05}, {1.0, 0.05}, {1.0, 0.0}};
  const auto denser = [&](bool left) {
    return [left](tfm::Model& model) {
      core::Checkpoint start = model.checkpoint();
      double* phi = start.arrays.at("state").data();
      const core::Grid& grid = model.constants().grid;
      for (std::size_t j = 0; j < model.constants().species(); ++j)
        for (int k = 0; k < grid.cells[1]; ++k)
          for (int i = 0; i < grid.cells[0]; ++i, ++phi)
            if ((i < grid.cells[0] / 2) == left) *phi *= 1.01;
      model.start_from(start);
    };
  };
  const auto run = trial.begin(scene, denser(true));
  trial.advance(*run, 2);
  scene.tfm.fixed_step = 5e-4;
  scene.tfm.pressure_tolerance = 1e-13;
  see_mirror_images(trial, 0.1, [&](bool left) { return trial.begin(scene, denser(left)); });
}

}  // namespace

std::vector<HardCase> inertia_cases() {
  return {{"T27",
           "release of solids a hundredth as dense as the fluid",
           {"added_mass_lagged"},
           all_schemes(),
           light_release},
          {"T28", "lift and added mass between no-slip walls, inlet stepped", {}, all_schemes(), lifted_bed}};
}

}  // namespace polybed::hard
