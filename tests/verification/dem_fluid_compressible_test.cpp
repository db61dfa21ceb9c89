// A sphere in a fluid that sound runs through: where it is slow it moves as in an incompressible one.
#include "core/numerics/metric.hpp"
#include "fluid/compressible.hpp"
#include "fluid/fluid_mass.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

/// Where a sphere is, how fast, and by what share the mass of the fluid has changed.
struct Fallen {
  double place, speed, mass_change;
};

double fluid_mass(const dem::Model& model) {
  const fluid::Flow& flow = model.coupling()->flow();
  return fluid::fluid_mass(flow.grid(), flow.state());
}

/// \param profile  of a round column, in cells; empty: a box
Fallen fall(const Liquid& fluid, const std::string& law, double density, double diameter, double cell, double time,
            core::Taper profile = {}) {
  core::Scene scene = wet_box(diameter, density, fluid, {5 * cell, 6 * cell, 5 * cell}, {5, 6, 5});
  for (auto& [height, across] : profile) scene.column.profile.emplace_back(height * cell, across * cell);
  if (!profile.empty()) scene.column.shape = core::ColumnShape::cylinder;
  scene.fluid.equation_of_state = core::choice_of<core::Compressibility>(law);
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = time / 2400;
  scene.dem.greatest_speed = 1;
  scene.dem.fluid_every = 8;
  Beads beads(scene, {{"a", {2.52 * cell, 4.4 * cell, 2.46 * cell}}});
  beads.steps(8);
  const bool compressible = law != "incompressible";
  const double before = compressible ? fluid_mass(beads.model) : 1;
  beads.until(time);
  return {beads.place(0).x[1], beads.motion(0).v[1], compressible ? fluid_mass(beads.model) / before - 1 : 0};
}

// What sound has time to even out differs by the square of the Mach number: 3e-8 in water, 3e-6 in gas. The mass of the
// fluid is a sum over 150 cells of 2400/8 steps.
TEST(DemCompressible, ASphereFallsInTaitWaterAsInIncompressible) {
  const Fallen one = fall(water, "incompressible", 2500, 2e-3, 8e-3, 0.1),
               other = fall(water, "tait", 2500, 2e-3, 8e-3, 0.1);
  compare("speed", other.speed, one.speed, 1e-5);
  compare("place", other.place, one.place, 1e-5);
  compare("mass of the water", other.mass_change, 0, 1e-12, 1);
}

// In a tube and in a cone, whose walls cut the cells.
TEST(DemCompressible, ASphereFallsInARoundColumnOfTaitWaterAsInIncompressible) {
  for (const double bottom : {5.0, 4.0}) {
    const core::Taper profile{{0, bottom}, {4, 5}, {6, 5}};
    const Fallen one = fall(water, "incompressible", 2500, 2e-3, 8e-3, 0.1, profile),
                 other = fall(water, "tait", 2500, 2e-3, 8e-3, 0.1, profile);
    compare("speed", other.speed, one.speed, 1e-5);
    compare("place", other.place, one.place, 1e-5);
    compare("mass of the water", other.mass_change, 0, 1e-12, 1);
  }
}

TEST(DemCompressible, ASphereFallsInAnIdealGasAsInIncompressible) {
  const Fallen one = fall(gas, "incompressible", 2500, 0.2e-3, 10e-3, 0.06),
               other = fall(gas, "ideal_gas", 2500, 0.2e-3, 10e-3, 0.06);
  compare("speed", other.speed, one.speed, 1e-5);
  compare("place", other.place, one.place, 1e-5);
  compare("mass of the gas", other.mass_change, 0, 1e-12, 1);
}

}  // namespace
}  // namespace polybed::scenes
