// Hard cases of dry particles in boxes and at walls: D9 to D15.
#include <algorithm>
#include <cmath>

#include "core/numerics/random.hpp"
#include "hard/dry_spheres.hpp"

namespace polybed::hard {

namespace {

/// Spheres strewn in a box joined on all sides, none touching another, with random velocities.
std::vector<Bead> strewn(double side, int number, double speed_scale) {
  std::vector<Bead> beads;
  for (std::uint64_t k = 0; int(beads.size()) < number; ++k) {
    Bead b{"a", {}};
    bool free = true;
    for (std::size_t d = 0; d < 3; ++d) {
      b.x[d] = side * core::uniform(11, d, k);
      b.v[d] = speed_scale * core::normal(11, 3 + d, k);
    }
    for (const Bead& other : beads) {
      double square = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        const double apart = b.x[d] - other.x[d];
        square += std::pow(apart - side * std::round(apart / side), 2);
      }
      free = free && square > std::pow(2.02 * radius, 2);
    }
    if (free) beads.push_back(b);
  }
  return beads;
}

/// D9: a gas cools in a joined box: its momentum stays.
void cooling_gas(Trial& trial) {
  core::Scene scene = dry_box(radius, glass, {5e-3, 5e-3, 5e-3});
  scene.column.sides = scene.column.ends = core::Boundary::periodic;
  scene.dem.youngs_modulus = 5e6;
  scene.dem.greatest_speed = 0.5;
  const std::vector<Bead> start = strewn(5e-3, 40, 0.1);
  with_run(trial, scene, start, own_step(scene, start), [&](auto& run) {
    dem::Vector drift{};
    double all = 0;
    for (const int sign : {-1, 1}) {
      for (int n = 0; n < 40; ++n)
        for (std::size_t d = 0; d < 3; ++d) drift[d] += sign * run.motion(n).v[d];
      if (sign < 0) {
        for (int n = 0; n < 40; ++n) all += speed(run.motion(n));
        run.steps(3000);
      }
    }
    // Rounding of 40 velocities in 3000 steps: the square root of 1.2e5 times 1e-16.
    trial.measure("V4 momentum", std::hypot(drift[0], drift[1], drift[2]) / all, 1e-13);
  });
}

/// D10: 100 m/s at a wall where 1 m/s was expected.
void too_fast(Trial& trial) {
  core::Scene scene = dry_box(radius, glass, {0.02, 0.02, 0.02});
  scene.column.closed = true;
  const std::vector<Bead> start{{"a", {0.01, 0.01, 0.01}, {0, -100, 0}}};
  if (!trial.naive()) return stops_with_ids(trial, scene, start, 10'000);
  scene.dem.fixed_step = own_step(scene, {{"a", {0.01, 0.01, 0.01}}});
  const auto run = textbook::spheres(trial.treatment().naive, scene, start);
  run->steps(10'000);
  const double y = run->place(0).x[1];
  trial.measure("V1 particles beyond a wall", y > 0 && y < 0.02 ? 0 : 1, 0);
}

/// D11: a sphere in a box joined across 2.2 d, 1.99 d and less: the shallow ones are refused; in the least one allowed
/// a sphere that touches another on both sides feels both.
void shallow_box(Trial& trial) {
  const auto box = [](double depth) {
    core::Scene scene = dry_box(radius, glass, {8e-3, 8e-3, depth});
    scene.column.sides = scene.column.ends = core::Boundary::periodic;
    scene.dem.skin = 0.05e-3;
    return scene;
  };
  if (!trial.naive())
    for (const double depth : {1.0, 1.5, 1.99}) try {
        const Beads run(box(depth * 2 * radius), {{"a", {4e-3, 4e-3, 0.2e-3}}});
        trial.measure("V16 a box too shallow is refused", 1, 0);
      } catch (const core::CaseError&) {
        trial.measure("V16 a box too shallow is refused", 0, 0);
      }
  // Two spheres half the depth apart touch each other and each other's image; a textbook lets a box be that shallow.
  const double depth = (trial.naive() ? 1.5 : 2.2) * 2 * radius, z = trial.naive() ? 0.5 * depth : 0.6 * radius;
  const double reach = 2 * radius - 5e-6, aside = std::sqrt(reach * reach - z * z);
  const std::vector<Bead> start{{"a", {4e-3, 4e-3, 0.1e-3}}, {"a", {4e-3 + aside, 4e-3, 0.1e-3 + z}}};
  core::Scene scene = box(depth);
  with_run(trial, scene, start, 1e-6, [&](auto& run) {
    const double other = std::hypot(aside, depth - z), overlap = 2 * radius - other;
    const double k = 4.0 / 3 * 0.5 * 5e6 / (1 - 0.0625) * std::sqrt(0.5 * radius);
    const auto push = [&](double deep) { return deep > 0 ? k * std::pow(deep, 1.5) : 0.0; };
    const double expected = -(push(5e-6) * aside / reach + push(overlap) * aside / other);
    trial.measure("force of a pair and its image", std::abs(run.force(0)[0] / expected - 1), 1e-6);
  });
}

/// D12: spheres at exactly 0 and L, and a million diameters from where numbers are dense: the same motion.
void on_the_edge(Trial& trial) {
  const auto run_from = [](double x, double length) {
    core::Scene scene = dry_box(radius, glass, {length, 5e-3, 5e-3});
    scene.column.sides = scene.column.ends = core::Boundary::periodic;
    scene.dem.youngs_modulus = 5e6;
    const double other = x + 1.1e-3;
    Beads run(scene, {{"a", {x, 2e-3, 2e-3}, {0.1, 0, 0}},
                      {"a", {other < length ? other : other - length, 2e-3, 2e-3}, {-0.1, 0, 0}}});
    run.steps(2000);
    return run.motion(0).v[0];
  };
  constexpr double length = 5e-3, far = 1000;  // m
  const double inside = run_from(1e-3, length);
  for (const double x : {0.0, length, 4.9999e-3, 1e-12})
    trial.measure("the same speed at every place", std::abs(run_from(x, length) / inside - 1), 1e-9);
  // There places are kept to 1e-13 m, of steps of 1e-7 m a millionth part.
  for (const double x : {far - 1, far})
    trial.measure("the same speed far out", std::abs(run_from(x, far) / inside - 1), 1e-6);
}

/// D13: where no wall is there is no force: a hair off the walls, and beyond the open top.
void no_force_without_overlap(Trial& trial) {
  const core::Scene scene = dry_box(radius, glass, {0.01, 0.01, 0.01});
  for (const dem::Vector& x :
       {dem::Vector{radius * (1 + 1e-9), radius * (1 + 1e-9), radius * (1 + 1e-9)}, {0.005, 0.01, 0.005}}) {
    const Beads run(scene, {{"a", x}});
    const dem::Vector f = run.force(0);
    trial.measure("force without overlap", std::hypot(f[0], f[1], f[2]), 0);
  }
}

/// D14: two centres in one place.
void one_place(Trial& trial) {
  const core::Scene scene = dry_box(radius, glass, {0.02, 0.02, 0.02});
  stops_with_ids(trial, scene, {{"a", {0.01, 0.01, 0.01}}, {"a", {0.01, 0.01, 0.01}}}, 10);
}

/// D15: friction 0, 1e-9, 10 and restitution 1e-6, 1 at an oblique impact: finite, and continuous at the ends.
void ends_of_coefficients(Trial& trial) {
  const auto after = [](double friction, double restitution) {
    core::Scene scene = dry_box(radius, glass, {0.02, 0.02, 0.02});
    core::set_friction(scene, friction);
    core::set_restitution(scene, restitution);
    Beads run(scene, {{"a", {0.01, 1.1 * radius, 0.01}, {0.5, -0.5, 0}}});
    run.run_while([&] { return run.place(0).x[1] > radius; });
    run.run_while([&] { return run.place(0).x[1] < radius; });
    return run.motion(0);
  };
  for (const double mu : {0.0, 1e-9, 10.0})
    for (const double e : {1e-6, 0.5, 1.0}) trial.measure("V3 finite", std::isfinite(kinetic(after(mu, e))) ? 0 : 1, 0);
  trial.measure("friction 0 and 1e-9", std::abs(after(0, 0.9).v[0] - after(1e-9, 0.9).v[0]), 1e-8);
  trial.measure("restitution 1 and a little less", std::abs(after(0, 1).v[1] - after(0, 1 - 1e-9).v[1]), 1e-8);
}

}  // namespace

std::vector<HardCase> box_cases() {
  const std::vector<Treatment> dem{{"particles", "", ""}};
  return {{"D9", "a cooling granular gas", {"float_sums"}, dem, cooling_gas, false},
          {"D10", "100 m/s at a wall", {"fixed_dt"}, dem, too_fast, false},
          {"D11", "a box joined across two diameters", {"one_image"}, dem, shallow_box},
          {"D12", "places at exactly 0 and L, and far out", {}, dem, on_the_edge},
          {"D13", "no wall, no force", {}, dem, no_force_without_overlap, false},
          {"D14", "two centres in one place", {}, dem, one_place},
          {"D15", "extremes of friction and restitution", {}, dem, ends_of_coefficients}};
}

}  // namespace polybed::hard
