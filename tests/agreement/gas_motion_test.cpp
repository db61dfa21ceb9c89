// Particles so small that a gas slips on them and its molecules push them about, against closed forms.
#include "closures/gas_slip.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"
#include "tfm/model.hpp"

namespace polybed::scenes {
namespace {

/// Micron spheres of one species far apart in a closed box of gas.
core::Scene box_of_dust(double diameter, double density, const Liquid& fluid, double cell) {
  core::Scene scene = wet_box(diameter, density, fluid, {5 * cell, 5 * cell, 5 * cell}, {5, 5, 5});
  scene.effects["drag"] = "stokes";
  scene.fluid.temperature = 300;
  scene.dem.greatest_speed = 1;
  return scene;
}

// At 1.2 kg/m3 and 101325 Pa: lambda = 1.8e-5/1.2 sqrt(pi 1.2/(2 101325)) = 6.4697e-8 m, Kn of 1 um 0.12939, and the
// divisor 1 + 0.12939 (1.257 + 0.4 exp(-8.501)) = 1.16265, by hand.
TEST(DemGasSlip, ASphereFallsFasterByCunninghamsDivisor) {
  const double d = 1e-6, expected = 1500.0 - 1.2;
  core::Scene scene = box_of_dust(d, 1500, gas, 1e-3);
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = 1e-5;  // two relaxation times
  std::array<double, 2> speed{};
  for (const bool slips : {false, true}) {
    if (slips) scene.effects["gas_slip"] = "cunningham";
    Beads beads(scene, {{"a", {2.5e-3, 2.5e-3, 2.5e-3}}});
    beads.steps(40);
    speed[slips] = -beads.motion(0).v[1];
  }
  compare("without", speed[0], expected * 9.81 * d * d / (18 * 1.8e-5), 1e-4);  // the gas that it stirs
  compare("over that without", speed[1] / speed[0], 1.16265, 1e-5);             // digits above
}

TEST(TfmGasSlip, DividesTheDragOfEachSpecies) {
  core::Scene scene = box_of_dust(1e-6, 1500, gas, 1e-3);
  scene.column.dimensions = 2;
  scene.column.cells = {2, 8, 1};
  scene.bed.volume_share = {1.0};
  scene.bed.solids_fraction = scene.bed.start_solids_fraction = 0.3;
  scene.bed.static_height = 2e-3;
  scene.effects = {{"drag", "stokes"}};
  std::array<double, 2> exchange{};
  for (const bool slips : {false, true}) {
    if (slips) scene.effects["gas_slip"] = "cunningham";
    core::Timers timers;
    tfm::Model model(scene, timers);
    model.show(0);
    exchange[slips] = model.fields().solids.exchange[0][std::size_t(model.constants().grid.index(0, 0))];
  }
  compare("drag over that with slip", exchange[0] / exchange[1], 1.16265, 1e-5);
}

/// By Ganser's formula at a sphericity of 0.8. It falls by 0.9270287 of a sphere's speed, by hand: Re is 2.8e-6 there,
/// and K1 = 0.9270510.
TEST(DemShape, AParticleFallsByGansersFactor) {
  core::Scene scene = box_of_dust(1e-6, 1500, gas, 1e-3);
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = 1e-5;  // two relaxation times
  std::array<double, 2> speed{};
  for (const bool shaped : {false, true}) {
    if (shaped) scene.effects["shape"] = "ganser";
    if (shaped) scene.species[0].sphericity = 0.8;
    Beads beads(scene, {{"a", {2.5e-3, 2.5e-3, 2.5e-3}}});
    beads.steps(40);
    speed[shaped] = -beads.motion(0).v[1];
  }
  compare("over that of a sphere", speed[1] / speed[0], 0.9270287, 1e-5);  // the gas that it stirs, less in proportion
}

TEST(GasSlip, IsRefusedInALiquid) {
  core::Scene scene = box_of_dust(1e-6, 1500, water, 1e-3);
  scene.effects["gas_slip"] = "cunningham";
  EXPECT_THROW(Beads(scene, {{"a", {2.5e-3, 2.5e-3, 2.5e-3}}}), core::CaseError);
}

/// Spheres 0.1 mm apart on a lattice of 7 x 7 x 7.
std::vector<Bead> cloud() { return cubic_lattice("a", 0.1e-3, {0.7e-3, 0.7e-3, 0.7e-3}); }

/// Numbers that a mean over spheres and axes is made of.
constexpr double numbers = 3.0 * 343;

// In water slip relaxes within 1.4e-7 s and a step is 1e-4 s: the sphere diffuses with D = k_B T/(3 pi mu d), the mean
// square of its way along an axis is 2 D t. Three standard errors of a variance of 1029 numbers: 3 sqrt(2/1029) = 13 %.
TEST(DemBrownian, DiffusesAsEinsteinSays) {
  core::Scene scene = box_of_dust(1e-6, 2500, water, 0.14e-3);
  scene.effects["brownian"] = "langevin";
  scene.dem.fixed_step = 1e-4;
  Beads beads(scene, cloud());
  beads.steps(50);
  const std::vector<Bead> start = cloud();
  double sum = 0;
  for (std::size_t n = 0; n < start.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k) sum += std::pow(beads.place(std::int64_t(n)).x[k] - start[n].x[k], 2);
  const double expected = 2 * closures::brownian_diffusivity(300, 1e-3, 1e-6) * 50 * 1e-4;
  compare("mean square of the way", sum / numbers, expected, 0.13);
}

// In gas slip relaxes within tau = 7.72e-6 s. A force held over x = h/tau gives at the ends of holds, with a = exp(-x),
// the variance (k_B T/M)(2/x)(1 - a)/(1 + a), and in their middle, where steps end, what is left of it and of half a
// hold: 0.7898 of equipartition for x = 1/2, 0.9876 for 1/40. Six samples 4 tau apart: 3 sqrt(2/6174) = 5.4 %.
TEST(DemBrownian, MovesWithTheSpeedOfEquipartition) {
  core::Scene scene = box_of_dust(1e-6, 2500, gas, 0.14e-3);
  scene.effects["brownian"] = "langevin";
  const double tau = 2500 * 1e-12 / (18 * 1.8e-5), mass = pi / 6 * 1e-18 * 2500;
  for (const auto& [x, share] : {std::pair{1.0 / 2, 0.7898}, {1.0 / 40, 0.9876}}) {
    scene.dem.fixed_step = x * tau;
    Beads beads(scene, cloud());
    double sum = 0;
    for (int sample = 0; sample < 6; ++sample) {
      beads.steps(std::int64_t(4 / x));
      for (std::int64_t n = 0; n < 343; ++n)
        for (const double v : beads.motion(n).v) sum += v * v;
    }
    compare(fmt::format("variance of the speed, steps of {} tau", x), sum / (6 * numbers),
            share * closures::boltzmann * 300 / mass, 0.054);
  }
}

}  // namespace
}  // namespace polybed::scenes
