// Boxes of many equal spheres, at equilibrium, cooling or sheared: scenes and averages.
#pragma once

#include "closures/kinetic_theory.hpp"
#include "closures/restitution.hpp"
#include "core/numerics/messages.hpp"
#include "dem/stress.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {

/// Equal spheres of 1 mm and 2500 kg/m3 in a periodic cube, frictionless linear springs, tail kept.
struct Gas {
  int number = 500;
  double fraction = 0.2, restitution = 1;
  double temperature = 0.01;  ///< theta at the start, m2/s2
  double softness = 0.05;     ///< t_c/tau, tau = sqrt(pi) d/(24 phi g0 sqrt(theta)), the time between collisions
  double shear_rate = 0;      ///< 1/s
  double steps_per_contact = 20;
  std::uint64_t seed = 1;

  static constexpr double diameter = 1e-3, density = 2500;
  [[nodiscard]] double mass() const { return mass_of(0.5 * diameter, density); }
  [[nodiscard]] double g0() const { return closures::radial_carnahan_starling(fraction).value; }
  [[nodiscard]] double length() const { return std::cbrt(number * pi / 6 / fraction) * diameter; }
  [[nodiscard]] double between_collisions() const {
    return std::sqrt(pi) * diameter / (24 * fraction * g0() * std::sqrt(temperature));
  }
  [[nodiscard]] double contact_time() const { return softness * between_collisions(); }
};

/// k of a damped contact that lasts a time: t_c = pi sqrt(m*/k)/sqrt(1 - beta^2), m* = m/2.
inline double stiffness_of(const Gas& gas) {
  const double beta = closures::damping_ratio_kept(gas.restitution), omega = pi / gas.contact_time();
  return 0.5 * gas.mass() * omega * omega / (1 - beta * beta);
}

inline core::Scene scene_of(const Gas& gas) {
  const double length = gas.length();
  core::Scene scene = dry_box(0.5 * Gas::diameter, {1e6, 0.25, Gas::density}, {length, length, length});
  scene.column.sides = scene.column.ends = core::Boundary::periodic;
  scene.bed.start = {core::StartKind::random};
  scene.bed.particles = {gas.number};
  scene.bed.start_solids_fraction = gas.fraction;
  scene.bed.seed = gas.seed;
  scene.effects = {{"contact", "linear"}};
  scene.dem.normal_stiffness = stiffness_of(gas);
  core::set_restitution(scene, gas.restitution);
  core::set_friction(scene, 0);
  scene.dem.tail = core::Tail::keep;
  scene.dem.max_overlap = 0.2;
  scene.column.shear_rate = gas.shear_rate;
  scene.dem.start_speed = std::sqrt(gas.temperature);
  // Maxwell's tail reaches 5 deviations of each component among 1e4 particles; the flow comes on top.
  scene.dem.greatest_speed = 10 * std::sqrt(gas.temperature) + std::abs(gas.shear_rate) * length;
  scene.dem.fixed_step = gas.contact_time() / gas.steps_per_contact;
  scene.dem.skin = (gas.fraction < 0.35 ? 0.25 : 0.1) * Gas::diameter;
  return scene;
}

/// Diameter of the hard spheres that soft ones act like (Barker and Henderson, J. Chem. Phys. 47, 1967, 4714): the
/// integral of 1 - exp(-u/T) over r, u = k (d - r)^2/2, T = m theta: d - sqrt(pi m theta/(2 k)), for T << k d^2.
inline double hard_diameter(const Gas& gas) {
  return Gas::diameter - std::sqrt(0.5 * pi * gas.mass() * gas.temperature / stiffness_of(gas));
}

/// p/(rho theta) of an elastic gas, rho that of the spheres, after Carnahan and Starling at that diameter.
inline double hard_sphere_pressure(const Gas& gas) {
  const double share = std::pow(hard_diameter(gas) / Gas::diameter, 3), phi = share * gas.fraction;
  return closures::kinetic_pressure(phi, closures::radial_carnahan_starling(phi).value, 1) / share;
}

/// A gas that runs.
class GasRun {
 public:
  explicit GasRun(const Gas& gas) : GasRun(gas, scene_of(gas)) {}
  GasRun(const Gas& gas, const core::Scene& scene) : gas(gas), model(scene, timers) {}
  GasRun(const GasRun&) = delete;
  GasRun& operator=(const GasRun&) = delete;

  void run_for(double time) {
    for (std::int64_t n = std::llround(time / model.limits().dt); n > 0; --n) model.step(1e300);
  }
  /// Calls `look` four or five times per contact over a time: half a sine wave summed so is exact to 1e-3.
  template <class Look>
  void watch_for(double time, Look&& look) {
    const auto every = std::max<std::int64_t>(std::llround(gas.steps_per_contact / 5), 1);
    for (std::int64_t n = std::llround(time / (double(every) * model.limits().dt)); n > 0; --n) {
      for (std::int64_t k = 0; k < every; ++k) model.step(1e300);
      look(dem::stress_of(model));
    }
  }
  /// Momentum of the fluctuating motion over the sum of its magnitudes.
  [[nodiscard]] double drift() const {
    dem::Vector sum{};
    double all = 0;
    for (std::size_t i = 0; i < model.particles().owned; ++i) {
      dem::Vector v = model.particles().motion[i].v;
      v[0] -= gas.shear_rate * model.particles().place[i].x[1];
      for (std::size_t k = 0; k < 3; ++k) sum[k] += v[k];
      all += std::hypot(v[0], v[1], v[2]);
    }
    return std::hypot(sum[0], sum[1], sum[2]) / all;
  }

  const Gas gas;
  core::Timers timers;
  dem::Model model;
};

/// Means of some quantities over blocks of a run, and their standard errors from the scatter of the blocks.
template <std::size_t size>
struct Blocks {
  using Row = std::array<double, size>;
  std::vector<Row> blocks;

  void add(const Row& sum, std::int64_t number) {
    blocks.push_back(sum);
    for (double& s : blocks.back()) s /= double(number);
  }
  [[nodiscard]] double mean(std::size_t q) const {
    double sum = 0;
    for (const Row& b : blocks) sum += b[q];
    return sum / double(blocks.size());
  }
  [[nodiscard]] double error(std::size_t q) const {
    double squares = 0;
    for (const Row& b : blocks) squares += (b[q] - mean(q)) * (b[q] - mean(q));
    return std::sqrt(squares / double(blocks.size() * (blocks.size() - 1)));
  }
};

/// Granular temperature, pressure and shear stress -sigma_yx, SI, of a run in blocks of equal time.
enum Quantity : std::size_t { theta, pressure, shear_stress };
inline Blocks<3> averages(GasRun& run, double time, int blocks) {
  Blocks<3> averages;
  for (int b = 0; b < blocks; ++b) {
    std::array<double, 3> sum{};
    std::int64_t number = 0;
    run.watch_for(time / blocks, [&](const dem::Stress& s) {
      sum[theta] += s.temperature[0];
      sum[pressure] += s.pressure();
      sum[shear_stress] += s.shear();
      ++number;
    });
    averages.add(sum, number);
  }
  return averages;
}

}  // namespace polybed::scenes
