// Many spheres without a flow: pressure of an elastic gas, cooling of an inelastic one, conservation.
#include "dem_gas.hpp"

namespace polybed::verification {
namespace {

/// p/(rho theta) of a gas over Carnahan-Starling's phi (1 + 4 phi g0), and its allowed error.
///
/// Statistics: the collisional part is a sum over collisions of impulses that are Rayleigh distributed, with a square
/// deviation of 4/pi - 1 of the mean's square, so it is known to sqrt((4/pi - 1)/collisions); three of these. Physics:
/// 1/N for the N - 1 particles that move freely, and 0.5 % for springs of finite stiffness (calibration, 4: 0.2 % at
/// t_c/tau = 0.03).
void check_pressure(double fraction, int number, double collision_times, double allowed) {
  const Gas gas{.number = number, .fraction = fraction, .softness = 0.04};
  GasRun run(gas);
  run.run_for(30 * gas.between_collisions());
  const Blocks<3> mean = averages(run, collision_times * gas.between_collisions(), 10);
  const double expected = closures::kinetic_pressure(fraction, gas.g0(), 1);
  const double collisional = 1 - fraction / expected, collisions = 0.5 * number * collision_times;
  const double statistical = 3 * collisional * std::sqrt((4 / pi - 1) / collisions);
  const double obtained = mean.mean(pressure) / (Gas::density * mean.mean(theta));
  compare("pressure", obtained, expected, allowed > 0 ? allowed : 0.005 + statistical + 1.0 / number);
  compare("standard error of the pressure", mean.error(pressure) / mean.mean(pressure), 0, 0.01, 1);
}

TEST(DemGas, PressureAtAFifth) { check_pressure(0.2, 400, 60, 0); }
TEST(DemGas, PressureAtTwoFifths) { check_pressure(0.4, 400, 60, 0); }

// Haff: sqrt(theta_0/theta) = 1 + t/t_H, 1/t_H = 4 (1 - e^2) phi g0 sqrt(theta_0)/(sqrt(pi) d): 66.337 ms. Each
// collision takes an energy with a deviation about its mean, so 1000 particles with 22 collisions each by 3 t_H know
// the slope to 1/sqrt(22000) = 0.7 %; the specification allows 2 %.
TEST(DemGas, Haff) {
  const Gas gas{.number = 1000, .restitution = 0.9};
  const double expected = 66.337e-3;
  GasRun run(gas);
  run.run_for(0.2 * expected);  // the random start finds its structure
  double n = 0, st = 0, sy = 0, stt = 0, sty = 0;
  for (int k = 0; k < 140; ++k) {
    run.run_for(0.02 * expected);
    const double t = double(run.model.steps()) * run.model.limits().dt;
    const double y = std::sqrt(gas.temperature / dem::stress_of(run.model).temperature[0]);
    n += 1, st += t, sy += y, stt += t * t, sty += t * y;
  }
  const double slope = (n * sty - st * sy) / (n * stt - st * st);
  compare("t_H", 1 / slope, expected, 0.02);
  // Forces are exact opposites; velocities round 5e4 times.
  EXPECT_LT(run.drift(), 1e-12);
}

// Hertz' law ends smoothly, so that steps can be made small enough. 50 spheres, 1e4 collisions: work() counts the steps
// of contacts, each of which lasts about t_c.
TEST(DemGas, EnergyOfElasticCollisions) {
  const Gas gas{.number = 50, .fraction = 0.4, .softness = 0.3, .steps_per_contact = 400};
  core::Scene scene = scene_of(gas);
  scene.effects = {{"contact", "hertz"}};
  // E that makes an impact at the mean normal speed of collisions, sqrt(pi theta), last t_c (Hertz, 2.9432751843
  // delta/V; delta = (5 m* V^2/(4 K))^(2/5)).
  const double speed = std::sqrt(pi * gas.temperature), overlap = gas.contact_time() * speed / 2.9432751843;
  const double k = 1.25 * 0.5 * gas.mass() * speed * speed / std::pow(overlap, 2.5);
  const double poisson = 0.25, reduced = 0.75 * k / std::sqrt(0.25 * Gas::diameter);
  scene.species[0].youngs_modulus = 2 * (1 - poisson * poisson) * reduced;
  scene.dem.max_overlap = 0.4;
  GasRun run(gas, scene);
  run.run_for(gas.between_collisions());
  const double before = dem::totals_of(run.model).sum();
  run.run_for(500 * gas.between_collisions());
  const dem::Totals after = dem::totals_of(run.model);
  const double collisions = double(run.model.work().contact_steps) / gas.steps_per_contact;
  compare("collisions", collisions, 1.25e4, 0.2);
  compare("energy", after.sum() / before, 1, 1e-6);
  EXPECT_LT(run.drift(), 1e-12);
}

}  // namespace
}  // namespace polybed::verification
