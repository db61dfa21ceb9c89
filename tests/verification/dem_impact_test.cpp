// Head-on impacts of spheres through the engine: Chung and Ooi (2011), tests 1 to 3 and the normal part of 5.
#include <algorithm>

#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

/// What is seen of an impact on the way.
struct Seen {
  double overlap = 0, force = 0, duration = 0;  ///< the greatest, m, N; s
  double restitution = 0;
};

/// The vertex of a parabola through three values at equal steps: the greatest of a smooth course between its samples.
double vertex(double before, double top, double after) {
  return top + 0.125 * (after - before) * (after - before) / (2 * top - before - after);
}

double greatest(const std::vector<double>& values) {
  const auto top = std::max_element(values.begin() + 1, values.end() - 1);
  return vertex(top[-1], top[0], top[1]);
}

/// Runs through one impact. Touch and parting lie within a step: they are found from gap and speed of the free flight
/// before and after, which are exact. \param overlap  m  \param closing  speed of approach, m/s
Seen watch(Beads& beads, const std::function<double()>& overlap, const std::function<double()>& closing) {
  std::vector<double> depth{overlap()}, force{0};
  const double before = closing(), touch = -depth[0] / before;
  bool met = false;
  beads.run_while([&] {
    if (beads.model.steps() > 0) {
      depth.push_back(overlap());
      force.push_back(std::abs(beads.force(0)[1]));
    }
    met = met || depth.back() > 0;
    return !(met && depth.back() <= 0);
  });
  const double parting = double(beads.model.steps()) * beads.dt() + depth.back() / -closing();
  return {greatest(depth), greatest(force), parting - touch, -closing() / before};
}

/// A sphere against the floor. \param phase  of the touch within a step
Seen on_the_floor(core::Scene scene, double radius, double speed, double dt, double phase = 0) {
  scene.dem.fixed_step = dt;
  scene.dem.greatest_speed = speed;
  const double middle = 0.5 * scene.column.size[0];
  Beads beads(scene, {{"a", {middle, radius + phase * dt * speed, middle}, {0, -speed, 0}}});
  return watch(
      beads, [&] { return radius - beads.place(0).x[1]; }, [&] { return -beads.motion(0).v[1]; });
}

void compare_impact(const std::string& name, const Seen& seen, const HertzImpact& expected) {
  // dt = t_c/100; the scheme's own errors are (pi/100)^2/24 = 4e-5 of time and depth.
  compare(name + " overlap", seen.overlap, expected.overlap, 1e-4);
  compare(name + " force", seen.force, expected.force, 1e-4);
  compare(name + " duration", seen.duration, expected.duration, 1e-4);
}

struct Case {
  std::string name;
  double radius, speed;
  Material material;
  HertzImpact expected;  ///< 5 m* V^2/(4 K) to the 2/5, K delta^1.5, 2.94328 delta/V
};

// Chung and Ooi, tests 2, 3 (e = 1) and 5: a sphere on a rigid plane.
TEST(DemImpact, OnARigidPlane) {
  for (const Case& c : {Case{"2 Al", 0.1, 0.2, {70e9, 0.30, 2699}, {4.971718e-5, 1.136986e4, 7.316566e-4}},
                        Case{"2 Mg", 0.1, 0.2, {40e9, 0.35, 1800}, {5.212329e-5, 7.232681e3, 7.670659e-4}},
                        Case{"3 Al2O3", 2.5e-3, 3.9, {380e9, 0.23, 4000}, {8.088808e-6, 6.153516e2, 6.104510e-6}},
                        Case{"3 iron", 2.5e-3, 3.9, {100e9, 0.25, 7000}, {1.718871e-5, 5.067602e2, 1.297208e-5}},
                        Case{"5 steel", 1e-5, 5, {208e9, 0.3, 7850}, {6.473498e-8, 1.587337e-2, 3.810657e-8}}}) {
    core::Scene scene = dry_box(c.radius, c.material, {20 * c.radius, 20 * c.radius, 20 * c.radius});
    core::set_restitution(scene, 1);
    compare_impact(c.name, on_the_floor(scene, c.radius, c.speed, c.expected.duration / 100), c.expected);
  }
}

// Chung and Ooi, test 1: two equal spheres at +-10 m/s.
TEST(DemImpact, OfTwoSpheres) {
  for (const Case& c : {Case{"1 glass", 0.01, 10, {48e9, 0.20, 2800}, {2.741127e-4, 1.069689e4, 4.033946e-5}},
                        Case{"1 limestone", 0.01, 10, {20e9, 0.25, 2500}, {3.683040e-4, 7.108241e3, 5.420100e-5}}}) {
    core::Scene scene = dry_box(c.radius, c.material, {0.2, 0.2, 0.2});
    core::set_restitution(scene, 1);
    scene.dem.fixed_step = c.expected.duration / 100;
    Beads beads(scene, {{"a", {0.1, 0.09, 0.1}, {0, 10, 0}}, {"a", {0.1, 0.11, 0.1}, {0, -10, 0}}});
    const Seen seen = watch(
        beads, [&] { return 0.02 - (beads.place(1).x[1] - beads.place(0).x[1]); },
        [&] { return beads.motion(0).v[1] - beads.motion(1).v[1]; });
    compare_impact(c.name, seen, c.expected);
    EXPECT_EQ(beads.motion(0).v[1], -beads.motion(1).v[1]);
  }
}

/// The error of the restitution that another program of the thesis' scheme has, largest over the phase of contact.
double error_of_restitution(double restitution, int steps) {
  if (restitution == 1) return steps == 20 ? 4.3e-4 : 7.2e-6;
  if (restitution == 0.9) return steps == 20 ? 2.0e-3 : 1.6e-4;
  if (restitution == 0.7) return steps == 20 ? 6.3e-3 : 5.5e-4;
  return steps == 20 ? 1.1e-2 : 1.3e-3;
}

double worst_error(double restitution, const std::string& tail, int steps) {
  const double radius = 2.5e-3, speed = 3.9;
  core::Scene scene = dry_box(radius, {380e9, 0.23, 4000}, {0.05, 0.05, 0.05});
  core::set_restitution(scene, restitution);
  scene.dem.tail = core::choice_of<core::Tail>(tail);
  scene.dem.integrator = core::DemIntegrator::thesis;
  double worst = 0;
  for (int k = 0; k < 16; ++k)
    worst = std::max(
        worst, std::abs(on_the_floor(scene, radius, speed, 6.104510e-6 / steps, k / 16.0).restitution - restitution));
  return worst;
}

// Chung and Ooi, test 3: the restitution asked for is the one found. With the tail kept, within 1.5 times the error
// that another program of the same scheme has, a margin for phases that neither took; and it falls from
// 20 to 100 steps as second order does at e = 1, 25-fold, and as first order does, 5-fold, with damping.
TEST(DemImpact, LeavesWithTheRestitutionAskedFor) {
  for (const double e : {1.0, 0.9, 0.7, 0.5}) {
    const double coarse = worst_error(e, "keep", 20), fine = worst_error(e, "keep", 100);
    compare(fmt::format("3 e {} keep 20", e), coarse, 0, 1.5 * error_of_restitution(e, 20), 1);
    compare(fmt::format("3 e {} keep 100", e), fine, 0, 1.5 * error_of_restitution(e, 100), 1);
    EXPECT_GT(coarse, (e == 1 ? 25 : 5) * fine) << e;
  }
}

// With the tail clipped the solved damping ratio must give the restitution in the limit of dt: the error falls at
// least in proportion to the step (four-fold, less what the worst of 16 phases varies), and at 100 steps is within the
// 5e-3 that are this project's goal for oblique impacts too; 2.9e-3 were found, at e = 0.2.
TEST(DemImpact, ClippedTailsKeepTheRestitution) {
  for (const double e : {0.9, 0.8, 0.7, 0.5, 0.3, 0.2}) {
    const double coarse = worst_error(e, "clip", 100), fine = worst_error(e, "clip", 400);
    compare(fmt::format("3 e {} clip 100", e), coarse, 0, 5e-3, 1);
    EXPECT_GT(coarse, 3.5 * fine) << e;
  }
}

// D3 of the hard cases: from soft to steel the same restitution within 1 %, and an overlap that follows E^(-2/5).
TEST(DemImpact, AtAnyStiffness) {
  const double radius = 0.5e-3, speed = 0.1;
  double last = 0;
  for (const double modulus : {1e5, 1e7, 1e9, 2e11}) {
    core::Scene scene = dry_box(radius, {modulus, 0.25, 2500}, {0.01, 0.01, 0.01});
    core::set_restitution(scene, 0.8);
    scene.dem.greatest_speed = speed;
    const double reduced = modulus / (1 - 0.25 * 0.25);
    const HertzImpact hertz = hertz_impact(reduced, radius, mass_of(radius, 2500), speed);
    const double middle = 0.005;
    Beads beads(scene, {{"a", {middle, 1.1 * radius, middle}, {0, -speed, 0}}});  // at the engine's own step
    const Seen seen = watch(
        beads, [&] { return radius - beads.place(0).x[1]; }, [&] { return -beads.motion(0).v[1]; });
    compare(fmt::format("D3 E {:.0e} e", modulus), seen.restitution, 0.8, 0.01);
    EXPECT_LT(seen.overlap, hertz.overlap);
    if (last > 0) {
      const double exponent = std::log(seen.overlap / last) / std::log(modulus == 2e11 ? 200.0 : 100.0);
      compare(fmt::format("D3 E {:.0e} exponent", modulus), exponent, -0.4, 5e-3);
    }
    last = seen.overlap;
  }
}

}  // namespace
}  // namespace polybed::scenes
