// Particles in a fluid in a box whose bottom and top are joined: momentum, slip, and the same bits wherever the ends
// are and whenever the run stops.
#include "core/numerics/random.hpp"
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

constexpr double spacing = 2e-3, diameter = 0.8e-3, density = 1500, gravity = 9.81;
const Liquid oil{1000, 0.01};
const dem::Vector box_size{8e-3, 12e-3, 8e-3};
constexpr double slip_of_one = 17.44e-3;  // m/s, D^2 (rho_p - rho_f) g/(18 mu)

/// Spheres of 0.8 mm and 1500 kg/m3 in a liquid, one in each cell of 2 mm: a solids fraction of 0.0335.
core::Scene joined_box(int every = 4) {
  core::Scene scene = wet_box(diameter, density, oil, box_size, {4, 6, 4});
  scene.column.closed = false;
  scene.column.sides = scene.column.ends = core::Boundary::periodic;
  scene.column.gravity = gravity;
  scene.effects["drag"] = "stokes";
  scene.dem.fluid_every = every;
  scene.dem.fixed_step = 1e-4;
  scene.dem.greatest_speed = 0.05;
  return scene;
}

double fraction() { return pi / 6 * std::pow(diameter / spacing, 3); }

/// Momentum of particles and fluid over the mass of all, m/s, with the voidage on faces from the particles' places
/// alone. \pre right after a step of the fluid
dem::Vector mass_velocity(const dem::Model& model) {
  const fluid::Flow& flow = model.coupling()->flow();
  const core::Grid& grid = flow.grid();
  const dem::Weights weights(grid);
  const dem::Particles& particles = model.particles();
  dem::Vector momentum{};
  double mass = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid, core::owned_faces(grid, axis), [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c)
        momentum[a] += oil.density * grid.cell_volume() * flow.state().velocity[a][std::size_t(c)];
    });
    for (std::size_t i = 0; i < particles.owned; ++i) {
      const dem::Motion& m = particles.motion[i];
      const double volume = 4.0 / 3 * pi * std::pow(particles.place[i].radius, 3);
      momentum[a] += m.v[a] / m.inverse_mass;
      dem::for_each_face(3, weights(particles.place[i].x), axis, [&](std::size_t at, double w) {
        momentum[a] -= oil.density * volume * w * flow.state().velocity[a][at];
      });
      if (axis == 0) mass += 1 / m.inverse_mass - oil.density * volume;
    }
  }
  mass += oil.density * box_size[0] * box_size[1] * box_size[2];
  for (double& component : momentum) component /= mass;
  return momentum;
}

double mean_velocity(const dem::Model& model) {
  double sum = 0;
  for (std::size_t i = 0; i < model.particles().owned; ++i) sum += model.particles().motion[i].v[1];
  return sum / double(model.particles().owned);
}

// The drag 18 mu eps/D^2 of Stokes' law on a particle carries eps (rho_p - rho_f) g: the slip is that of a lone sphere,
// D^2 (rho_p - rho_f) g/(18 mu) = 17.44 mm/s, and G = -phi 500 9.81. Its relaxation takes 5 ms; after 0.2 s the rest is
// the error of the fluid's steps, which a slip at rest does not have.
TEST(DemJoinedEnds, AnEvenSuspensionHasTheSlipOfItsLawAndKeepsItsMomentum) {
  Beads run(joined_box(), cubic_lattice("a", spacing, box_size));
  const dem::Coupling& fluid = *run.model.coupling();
  compare("gradient", fluid.flow().mean_gradient(), -fraction() * 500 * gravity, 1e-12);
  run.until(0.2);
  const double slip = fluid.fluid_flux() / (1 - fraction()) - mean_velocity(run.model);
  compare("slip", slip, diameter * diameter * 500 * gravity / (18 * oil.viscosity), 1e-9);
  // Sums of 96 particles and 96 faces, 500 steps of the fluid, each to 1e-15.
  compare("velocity of the centre of mass", mass_velocity(run.model)[1], 0, 1e-12, slip);
}

/// Moved from their places at random, and upwards by a height; particles beyond the top return at the bottom.
std::vector<Bead> scattered(double up) {
  std::vector<Bead> beads = cubic_lattice("a", spacing, box_size);
  for (std::uint64_t n = 0; n < beads.size(); ++n) {
    for (std::size_t k = 0; k < 3; ++k) beads[n].x[k] += 0.8e-3 * (core::uniform(3, k, n) - 0.5);
    beads[n].x[1] = std::fmod(beads[n].x[1] + up, box_size[1]);
  }
  return beads;
}

// All momentum is kept to round-off: 1e-16 of each of 96 particles and 96 faces. What the averages over particles would
// have made of it, 5e-5 g in a box with streams, is taken back by moving all alike: here less than a hundredth of
// the slip in 0.2 s, for any number of particle steps in one of the fluid.
TEST(DemJoinedEnds, ScatteredParticlesKeepTheirMomentum) {
  for (const int every : {1, 4, 16}) {
    Beads run(joined_box(every), scattered(0));
    for (int n = 0; n < 20; ++n) {
      run.steps(96);
      for (const double u : mass_velocity(run.model)) EXPECT_NEAR(u, 0, 1e-13 * slip_of_one) << every;
    }
    const dem::Coupling::Frame& frame = *run.model.coupling()->frame();
    RecordProperty(fmt::format("moved by, over the slip, {} steps", every),
                   fmt::format("{:.2g}", frame.velocity[1] / slip_of_one));
    for (const double u : frame.velocity) EXPECT_LT(std::abs(u), 0.01 * slip_of_one) << every;
    EXPECT_NE(frame.velocity[1], 0);
  }
}

// Nothing knows where the ends are: after 20 steps of the fluid the shifted box differs by the tolerance of its
// pressure, 1e-8 of it in each step.
TEST(DemJoinedEnds, AShiftedBoxStaysShifted) {
  Beads one(joined_box(), scattered(0)), other(joined_box(), scattered(0.5 * box_size[1]));
  for (Beads* run : {&one, &other}) run->steps(80);
  std::vector<double> of_one(one.model.particles().owned), of_other(of_one);
  for (std::size_t i = 0; i < of_one.size(); ++i) {
    of_one[std::size_t(one.model.particles().id[i])] = one.model.particles().motion[i].v[1];
    of_other[std::size_t(other.model.particles().id[i])] = other.model.particles().motion[i].v[1];
  }
  for (std::size_t n = 0; n < of_one.size(); ++n) EXPECT_NEAR(of_one[n], of_other[n], 1e-8 * slip_of_one);
}

TEST(DemJoinedEnds, ARestartHasTheSameBits) {
  Beads through(joined_box(), scattered(0)), again(joined_box(), scattered(0));
  through.steps(41);
  through.model.restart();
  again.model.resume(through.model.checkpoint());
  for (Beads* run : {&through, &again}) run->steps(41);
  EXPECT_EQ(through.model.checkpoint().arrays, again.model.checkpoint().arrays);
  EXPECT_EQ(through.model.coupling()->fluid_flux(), again.model.coupling()->fluid_flux());
}

// A fixed bed of the same spheres, with f = 1: the gradient on the fluid, -eps G, meets the drag 18 mu phi eps U_f/D^2.
TEST(DemJoinedEnds, AGivenGradientDrivesTheFluidThroughHeldParticles) {
  core::Scene scene = joined_box();
  scene.bed.held = true;
  scene.column.pressure_gradient = -100.0;
  Beads run(scene, cubic_lattice("a", spacing, box_size));
  run.until(2);  // 20 relaxation times of rho_f D^2/(18 mu phi)
  const double flux = run.model.coupling()->fluid_flux();
  const double expected = 100 * (1 - fraction()) * diameter * diameter / (18 * oil.viscosity * fraction());
  compare("superficial velocity", flux, expected, 1e-7);
}

}  // namespace
}  // namespace polybed::scenes
