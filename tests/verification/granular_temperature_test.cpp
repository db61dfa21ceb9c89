// Kinetic theory in the continuum: cooling, simple shear, walls, transport of the granular temperature.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <numbers>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using Kind = tfm::StateLayout::Entry::Kind;
using Place = std::function<double(double x, double y)>;
constexpr double pi = std::numbers::pi;

/// Solids of 1 mm, 2500 kg/m3 in a closed box without weight, joined along x, in next to nothing of a fluid.
core::Scene collisions(double solids, int cells, double height, const std::string& temperature) {
  core::Scene scene = uniform_bed(1e-3, 2500, 1e-3, 1e-9, solids, cells, height);
  scene.column.closed = true;
  scene.column.gravity = 0;
  scene.effects = {{"solids_stress", "kinetic"}, {"granular_temperature", temperature}};
  scene.tfm.max_packing = 0.64;
  scene.tfm.radial_distribution = core::RadialDistribution::carnahan_starling;
  scene.tfm.rtol = 1e-7;
  return scene;
}

/// A model that starts with a velocity along x, of solids and fluid alike, and temperatures, both by place.
struct Prepared {
  core::Timers timers;
  tfm::Model model;
  Prepared(const core::Scene& scene, const Place& velocity, const Place& temperature) : model(scene, timers) {
    const core::Grid& grid = model.constants().grid;
    core::Checkpoint start = model.checkpoint();
    const bool transported = !model.fields().solids.temperature_rate.empty();
    const tfm::StateLayout layout(grid, 1, scene.tfm.integrator == core::TfmIntegrator::implicit_steps, transported);
    for (const auto& entry : layout.entries()) {
      const bool moves = (entry.kind == Kind::velocity || entry.kind == Kind::flux) && entry.axis == 0;
      if (!moves && entry.kind != Kind::temperature) continue;
      double* out = start.arrays.at("state").data() + entry.begin;
      for (int j = entry.box.lo[1]; j < entry.box.hi[1]; ++j)
        for (int i = entry.box.lo[0]; i < entry.box.hi[0]; ++i) {
          const double x = (i + (moves ? 0.0 : 0.5)) * grid.spacing[0], y = grid.centre(1, j);
          *out++ = entry.kind == Kind::temperature ? temperature(x, y) : velocity(x, y);
        }
    }
    model.start_from(start);
    model.show(0);
  }
  [[nodiscard]] double theta(int i, int j) const { return model.fields().solids.temperature[0][at(i, j)]; }
  [[nodiscard]] double rate(int i, int j) const { return model.fields().solids.temperature_rate[0][at(i, j)]; }
  [[nodiscard]] std::size_t at(int i, int j) const { return std::size_t(model.constants().grid.index(i, j)); }
};

const Place rest = [](double, double) { return 0.0; };
Place even(double value) {
  return [value](double, double) { return value; };
}

struct Steps {
  std::string integrator;
  double rtol;
};

class Cooling : public testing::TestWithParam<Steps> {};

// dtheta/dt = -(2/t_H) sqrt(theta/theta_0) theta - 2 theta/tau_d: sqrt(theta/theta_0) = E/[1 + (tau_d/t_H)(1 - E)],
// E = exp(-t/tau_d); phi 0.2, e 0.9, theta_0 0.01 and t_H 66.337 ms of Haff; tau_d = rho/b = 50 ms by Stokes drag.
// 1e-5: printed digits, and a hundred times rtol. Implicit steps, of second order, are 2.3e-5 off at rtol 1e-7 and need
// 1e-8.
TEST_P(Cooling, ByCollisionsAndDragFollowsTheExactSolution) {
  core::Scene scene = collisions(0.2, 4, 0.02, "transported");
  scene.effects["drag"] = "stokes";
  scene.fluid.viscosity = 2500 * 1e-6 / (18 * 0.8 * 0.05);  // b = 18 mu eps/D^2
  scene.fluid.density = 1000;
  scene.tfm.kinetic_theory = core::KineticTheory::lun;
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam().integrator);
  scene.tfm.rtol = GetParam().rtol;
  Prepared run(scene, rest, even(0.01));
  const auto expect = [&](double time, double expected) {
    advance(run.model, time);
    record("relative error at " + std::to_string(int(time * 1000)) + " ms", run.theta(0, 2) / expected - 1);
    EXPECT_NEAR(run.theta(0, 2), expected, 1e-5 * expected);
  };
  expect(0.01, 5.18856e-3);
  expect(0.02, 2.88268e-3);
  expect(0.05, 6.20837e-4);
}

INSTANTIATE_TEST_SUITE_P(Integrators, Cooling, testing::Values(Steps{"explicit", 1e-7}, Steps{"implicit", 1e-8}));

constexpr double gamma_rate = 100, diameter = 1e-3;  // 1/s, m
constexpr double unit = gamma_rate * gamma_rate * diameter * diameter;

struct Row {
  double phi, e;
  std::string theory;
  double theta, p, mu;
};

core::Scene sheared(const Row& row, const std::string& temperature, int cells) {
  core::Scene scene = collisions(row.phi, cells, 0.01 * cells, temperature);
  scene.species[0].restitution = row.e;
  scene.tfm.kinetic_theory = core::choice_of<core::KineticTheory>(row.theory);
  return scene;
}

const Place shear = [](double, double y) { return gamma_rate * (y - 0.1); };

class ShearedGrains : public testing::TestWithParam<Row> {};

// Values of the table, in units of rho, D and the shear rate: half of the last printed digit. The middle of the box,
// whose shear is even and, at the start, also where the pressure is.
TEST_P(ShearedGrains, HaveTheTabledTemperaturePressureAndViscosity) {
  const Row& row = GetParam();
  Prepared run(sheared(row, "algebraic", 20), shear, rest);
  const std::size_t middle = run.at(0, 10);
  const tfm::SolidsStress& stress = run.model.fields().stress;
  EXPECT_NEAR(run.theta(0, 10) / unit, row.theta, 5.1e-5);
  EXPECT_NEAR(stress.viscosity[middle] * row.phi / (2500 * diameter * diameter * gamma_rate), row.mu, 5.1e-5);
  EXPECT_NEAR(stress.pressure[middle] / (2500 * unit), row.p, 5.1e-5);  // below 0.5 friction adds nothing
}

INSTANTIATE_TEST_SUITE_P(
    Table, ShearedGrains,
    testing::Values(Row{.1, .7, "lun", 2.3031, .3324, .1573}, Row{.3, .7, "garzo_dufty", .3959, .4190, .1919},
                    Row{.1, .9, "garzo_dufty", 6.8577, 1.0254, .3002}, Row{.2, .9, "lun", 1.9655, .9183, .2492},
                    Row{.3, .9, "garzo_dufty", 1.2364, 1.4188, .3933}, Row{.4, .9, "lun", .9773, 2.5916, .7365},
                    Row{.4, .99, "garzo_dufty", 10.1709, 28.0565, 2.5886}));

// mu gamma^2 = Gamma + 3 phi rho theta/tau_d with 1/(gamma tau_d) = 0.1 and 1; the fluid moves with the grains.
TEST(ShearedGrains, AreCooledByDrag) {
  for (const auto& [drag, theta, mu] : {std::array{0.1, .848, .695}, std::array{1.0, .2324, .364}}) {
    core::Scene scene = sheared({.4, .9, "garzo_dufty", 0, 0, 0}, "algebraic", 20);
    scene.effects["drag"] = "stokes";
    scene.fluid.viscosity = 2500 * 1e-6 * gamma_rate * drag / (18 * 0.6);
    Prepared run(scene, shear, rest);
    EXPECT_NEAR(run.theta(0, 10) / unit, theta, 5.1e-4);  // three printed decimals
    EXPECT_NEAR(run.model.fields().stress.viscosity[run.at(0, 10)] * .4 / (2500 * diameter * diameter * gamma_rate), mu,
                5.1e-4);
  }
}

// The equation of its own finds the balance, from 10 % above, in fifteen over the shear rate, before the waves that
// start at the walls of a box of 400 D are in its middle. Half a printed digit; 0.1 exp(-0.7 15) of the disturbance is
// left.
TEST(ShearedGrains, FindTheirTemperatureInTime) {
  const Row row{.3, .9, "garzo_dufty", 1.2364, 1.4188, .3933};
  core::Scene scene = sheared(row, "transported", 40);
  scene.tfm.rtol = 1e-5;
  Prepared run(scene, shear, even(1.1 * row.theta * unit));
  advance(run.model, 15 / gamma_rate);
  record("theta of the table 1.2364", run.theta(0, 20) / unit);
  EXPECT_NEAR(run.theta(0, 20) / unit, row.theta, 5.1e-5);
}

// k dtheta/dy of elastic grains, k* = 1.58625521 at phi 0.3 (written out apart): a small ripple cos(pi y/H) decays at
// (2/3) k/((phi + 1e-4) rho) (pi/H)^2; the scheme's 2 (1 - cos(pi h/H))/h^2 lies (pi/20)^2/12 below.
TEST(GranularTemperature, IsConducted) {
  constexpr double height = 0.2, theta = 0.01, ripple = 1e-5;
  core::Scene scene = collisions(0.3, 20, height, "transported");
  scene.species[0].restitution = 1;
  Prepared run(scene, rest, [&](double, double y) { return theta * (1 + ripple * std::cos(pi * y / height)); });
  const double k = 1.5862552132846346 * 2500 * 1e-3 * std::sqrt(theta);
  const double rate = 2.0 / 3 * k / (0.3001 * 2500) * std::pow(pi / height, 2);
  for (int j : {0, 4, 19}) {
    const double here = ripple * theta * std::cos(pi * (j + 0.5) / 20);
    EXPECT_NEAR(run.rate(0, j) / (-rate * here), 1 - std::pow(pi / 20, 2) / 12, 1e-4) << j;  // the scheme's h^4; ripple
  }
}

// -U dtheta/dx: the difference between a bed that moves evenly and one at rest; second order but at the extrema.
TEST(GranularTemperature, IsCarriedAlong) {
  const auto error = [](int cells) {
    core::Scene scene = collisions(0.3, 2, 0.02, "transported");
    scene.column.size[0] = 0.1;
    scene.column.cells[0] = cells;
    const Place wave = [](double x, double) { return 0.01 * (1 + 0.1 * std::sin(2 * pi * x / 0.1)); };
    const Prepared moving(scene, even(2.0), wave), still(scene, rest, wave);
    double sum = 0;
    for (int i = 0; i < cells; ++i) {
      const double x = (i + 0.5) / cells;
      const double expected = -2.0 * 0.01 * 0.1 * 2 * pi / 0.1 * std::cos(2 * pi * x);
      sum += std::abs(moving.rate(i, 0) - still.rate(i, 0) - expected) / cells;
    }
    return sum;
  };
  const double coarse = error(64), fine = error(128);
  record("order", std::log2(coarse / fine));
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.25);  // the limiter sees two extrema
}

// A layer of 1 mm on the wall, phi 0.5, theta 0.01, U_t 0.2 m/s, s 0.1, e_w 0.9. B = 106.2773065 Pa s/m and
// mu_s = 0.4306781191 Pa s (Garzo and Dufty, g0 = 6) give mu_s B U/(mu_s + B h/2) = 18.92092754 Pa, all written out
// apart; the wall gives 1.22218902 W/m2 to fluctuations, (2/3) of it over phi rho h to theta.
TEST(JohnsonJackson, WallHasTheStressAndEnergyByHand) {
  core::Scene scene = collisions(0.5, 4, 0.004, "transported");
  scene.tfm.solids_wall = core::SolidsWall::johnson_jackson;
  const Prepared run(scene, even(0.2), even(0.01));
  const tfm::Fields& fields = run.model.fields();
  const double stress = 18.920927542198797, per_area = 0.5 * 2500 * 1e-3;
  for (int j : {0, 3})
    EXPECT_NEAR(fields.solids.acceleration[0][0][run.at(0, j)], -stress / (0.5001 * 2500 * 1e-3), 1e-9 * stress);
  EXPECT_NEAR(fields.solids.acceleration[0][0][run.at(0, 1)], 0, 1e-9 * stress);
  EXPECT_NEAR(run.rate(0, 0) - run.rate(0, 1), 2.0 / 3 * 1.2221890247 / per_area, 1e-8);  // printed digits
}

}  // namespace
}  // namespace polybed::scenes
