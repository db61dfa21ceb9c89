// Bounces, rests, slides and rolls through the engine, against closed forms; set-ups of MFiX among them.
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

/// MFiX: a sphere of 0.1 m, 2600 kg/m3, falls from 0.5 m on a linear floor of 1e4 N/m.
core::Scene falling(double restitution) {
  core::Scene scene = dry_box(0.1, {1e7, 0.3, 2600}, {2, 2, 2});
  scene.effects["contact"] = "linear";
  scene.column.gravity = 9.81;
  scene.dem.normal_stiffness = 1e4;
  scene.dem.tail = core::Tail::keep;
  scene.dem.max_overlap = 0.9;
  core::set_restitution(scene, restitution);
  return scene;
}

/// Of the first contact, from y(t) of the damped oscillator under gravity.
struct Contact {
  double overlap, duration, leaving;
};

/// A step that meets the touch: the fall to it in a whole number of them.
void bounce(double restitution, const Contact& expected) {
  constexpr double touch = 0.2855686;
  core::Scene scene = falling(restitution);
  scene.dem.fixed_step = touch / 5000;
  Beads beads(scene, {{"a", {1, 0.5, 1}}});
  compare("bounce touch", std::sqrt(2 * 0.4 / 9.81), touch, 1e-6);
  beads.run_while([&] { return beads.place(0).x[1] > 0.1 || beads.model.steps() < 5000; });
  double lowest = 1;
  std::int64_t inside = 0;
  while (beads.place(0).x[1] <= 0.1 || inside < 2) {
    beads.steps(1);
    ++inside;
    lowest = std::min(lowest, beads.place(0).x[1]);
  }
  // Of the last step only the part before the floor is left.
  const double beyond = (beads.place(0).x[1] - 0.1) / beads.motion(0).v[1];
  const double left = double(beads.model.steps()) * beads.dt() - beyond;
  const std::string name = fmt::format("bounce e {} ", restitution);
  compare(name + "overlap", 0.1 - lowest, expected.overlap, 1e-4);
  compare(name + "duration", left - touch, expected.duration, 1e-4);
  compare(name + "leaves at", beads.motion(0).v[1] + 9.81 * beyond, expected.leaving, 1e-4);
}

// Overlap, duration and speed after. 1e-4 is this project's goal; 6.5e-5 were found. At e 1 it leaves as it came,
// sqrt(2 g 0.4).
TEST(DemBounce, OfASphereOnALinearFloor) {
  bounce(1, {0.1037500, 0.1112704, std::sqrt(2 * 9.81 * 0.4)});
  bounce(0.8, {0.0929871, 0.1126481, 2.149490});
}

/// The height of the next apex, from a parabola through three steps at it: free flight is exact.
double next_apex(Beads& beads) {
  beads.run_while([&] { return beads.motion(0).v[1] >= 0; });
  beads.run_while([&] { return beads.motion(0).v[1] < 0; });
  beads.run_while([&] { return beads.motion(0).v[1] > 0; });
  const double v = beads.motion(0).v[1];
  return beads.place(0).x[1] + v * v / (2 * 9.81);
}

/// Speed with which the sphere leaves the floor that it has met at v: y(t) of the damped oscillator, weight included.
double leaving_speed(double v, double restitution) {
  const double mass = mass_of(0.1, 2600), g = 9.81, log_e = std::log(restitution);
  const double beta = -log_e / std::hypot(pi, log_e), w = std::sqrt(1e4 / mass), c = w * std::sqrt(1 - beta * beta);
  const double sag = g / (w * w);
  // y - R + sag = e^(-beta w t) (sag cos ct + s sin ct)
  const double s = (beta * sag * w - v) / c;
  const auto height = [&](double t) {
    return std::exp(-beta * w * t) * (sag * std::cos(c * t) + s * std::sin(c * t)) - sag;
  };
  double low = 0.5 * pi / c, high = 1.5 * pi / c;
  for (int n = 0; n < 60; ++n) (height(0.5 * (low + high)) < 0 ? low : high) = 0.5 * (low + high);
  return (height(low + 1e-7) - height(low - 1e-7)) / 2e-7;
}

// Heights of four bounces; without the weight during contact they would be R + (h_0 - R) e^(2k). The
// 1e-4 that a speed may be off, as above, are 2e-4 of a height, for each bounce.
TEST(DemBounce, HeightsFallWithTheRestitution) {
  compare("leaving speed", leaving_speed(std::sqrt(2 * 9.81 * 0.4), 0.8), 2.149490, 1e-6);
  core::Scene scene = falling(0.8);
  scene.dem.fixed_step = 5e-5;
  Beads beads(scene, {{"a", {1, 0.5, 1}}});
  double rise = 0.4;
  for (int k = 1; k <= 4; ++k) {
    rise = std::pow(leaving_speed(std::sqrt(2 * 9.81 * rise), 0.8), 2) / (2 * 9.81);
    compare(fmt::format("height after {}", k), next_apex(beads) - 0.1, rise, 2e-4 * k);
  }
}

// e = 1: after 16 bounces no higher than at the start by more than 1e-6, and no lower by more than the phases of 16
// touches leave; elastic, the scheme is symplectic.
TEST(DemBounce, WithoutLossGainsNothing) {
  core::Scene scene = falling(1);
  scene.dem.fixed_step = 5e-5;
  Beads beads(scene, {{"a", {1, 0.5, 1}}});
  double highest = 0, lowest = 1;
  for (int k = 0; k < 16; ++k) {
    const double apex = next_apex(beads);
    highest = std::max(highest, apex);
    lowest = std::min(lowest, apex);
  }
  compare("16 bounces, highest", highest, 0.5, 1e-6);
  compare("16 bounces, lowest", lowest, 0.5, 1e-6);
}

// MFiX: two spheres of 0.5 mm, the lower of twice the density, between plates 1.8 mm apart, squeezed from the start;
// all springs 1000 N/m. Centres after 1 ms, and at rest. 1e-5 is this project's goal; 8.0e-6 were found, at e 0.8.
TEST(DemBounce, OfTwoSpheresBetweenPlates) {
  struct Row {
    double restitution, time, lower, upper;
  };
  // At rest: damped to 1e-9 within 60 ms at e 0.8.
  for (const Row& r : {Row{1, 1e-3, .42712796e-3, 1.38355313e-3}, Row{.8, 1e-3, .43218710e-3, 1.36796147e-3},
                       Row{.8, 60e-3, .43324772e-3, 1.36659818e-3}}) {
    core::Scene scene = dry_box(0.5e-3, {1e7, 0.3, 20000}, {0.01, 1.8e-3, 0.01});
    scene.species.push_back(sphere("b", 0.5e-3, {1e7, 0.3, 10000}));
    scene.column.closed = true;
    scene.column.gravity = 9.81;
    scene.effects["contact"] = "linear";
    scene.dem.normal_stiffness = 1000;
    scene.dem.tail = core::Tail::keep;
    scene.dem.max_overlap = 0.5;
    core::set_restitution(scene, r.restitution);
    scene.dem.fixed_step = r.time / 5000;
    Beads beads(scene, {{"a", {0.005, 0.45e-3, 0.005}}, {"b", {0.005, 1.35e-3, 0.005}}});
    beads.until(r.time);
    const std::string name = fmt::format("two spheres, e {}, {} s, ", r.restitution, r.time);
    compare(name + "lower", beads.place(0).x[1], r.lower, 1e-5);
    compare(name + "upper", beads.place(1).x[1], r.upper, 1e-5);
  }
}

// Two spheres at rest on each other after Hertz: delta = (F/K)^(2/3), F = m_2 g between them and (m_1 + m_2) g on the
// floor. Damped to round-off in 0.2 s.
TEST(DemRest, OfAStackAfterHertz) {
  const double radius = 0.5e-3, g = 9.81, modulus = 5e6 / (1 - 0.25 * 0.25);
  core::Scene scene = dry_box(radius, {5e6, 0.25, 2500}, {0.01, 0.01, 0.01});
  scene.column.gravity = g;
  core::set_restitution(scene, 0.3);
  Beads beads(scene, {{"a", {0.005, radius, 0.005}}, {"a", {0.005, 3 * radius, 0.005}}});
  beads.until(0.2);
  const double weight = mass_of(radius, 2500) * g;
  const double on_floor = std::pow(2 * weight / (4.0 / 3 * modulus * std::sqrt(radius)), 2.0 / 3);
  const double between = std::pow(weight / (4.0 / 3 * 0.5 * modulus * std::sqrt(0.5 * radius)), 2.0 / 3);
  compare("stack, floor", radius - beads.place(0).x[1], on_floor, 1e-8);
  compare("stack, between", 2 * radius - (beads.place(1).x[1] - beads.place(0).x[1]), between, 1e-8);
  EXPECT_NEAR(beads.motion(1).v[1], 0, 1e-12);
}

/// A sphere that rests on the floor of a long periodic box, pressed on it by gravity along a direction (x, y).
core::Scene lying(double friction, double down, double along) {
  core::Scene scene = dry_box(0.5e-3, {5e7, 0.25, 2500}, {0.2, 0.02, 0.02});
  scene.column.sides = core::Boundary::periodic;
  scene.column.gravity = std::hypot(down, along);
  scene.column.down = {along / scene.column.gravity, -down / scene.column.gravity, 0};
  core::set_friction(scene, friction);
  core::set_restitution(scene, 0.5);
  return scene;
}

double sag(double down) {
  const double k = 4.0 / 3 * 5e7 / (1 - 0.25 * 0.25) * std::sqrt(0.5e-3);
  return std::pow(mass_of(0.5e-3, 2500) * down / k, 2.0 / 3);
}

// MFiX: a sphere set on the floor with 0.1 m/s and no spin slides until 2 v0/(7 mu g) and rolls with 5/7 v0 after. 0.1
// % is this project's goal, 1.2e-4 were found; t_s from the line that the speed falls on while sliding.
TEST(DemSlide, TurnsIntoRolling) {
  for (const double mu : {0.2, 0.4, 0.6, 1.0}) {
    const double g = 9.81, slides = 2 * 0.1 / (7 * mu * g);
    Beads beads(lying(mu, g, 0), {{"a", {0.05, 0.5e-3 - sag(g), 0.01}, {0.1, 0, 0}}});
    beads.until(0.5 * slides);
    const double time = double(beads.model.steps()) * beads.dt();
    compare(fmt::format("slide mu {} half-way", mu), beads.motion(0).v[0], 0.1 - mu * g * time, 1e-3);
    const double deceleration = (0.1 - beads.motion(0).v[0]) / time;
    beads.until(2 * slides);
    const double rolls = beads.motion(0).v[0];
    compare(fmt::format("slide mu {} v", mu), rolls, 5.0 / 7 * 0.1, 1e-3);
    compare(fmt::format("slide mu {} w R", mu), -beads.motion(0).w[2] * 0.5e-3, 5.0 / 7 * 0.1, 1e-3);
    compare(fmt::format("slide mu {} time", mu), (0.1 - rolls) / deceleration, slides, 1e-3);
  }
}

// A slope: it rolls with (5/7) g sin as long as tan <= 3.5 mu, and slides beyond with g (sin - mu cos) and a spin that
// grows with 2.5 mu g cos/R. 1e-3: the overlap over the radius is 8e-5, the step's error less.
TEST(DemSlide, DownAnIncline) {
  const double mu = 0.2, g = 9.81;
  for (const double angle : {10.0, 30.0, 34.0, 36.0, 50.0, 70.0}) {
    const double down = g * std::cos(angle * pi / 180), along = g * std::sin(angle * pi / 180);
    Beads beads(lying(mu, down, along), {{"a", {0.02, 0.5e-3 - sag(down), 0.01}}});
    // The spring of the contact is wound in the first 1 ms; the slope of the speed is taken after it.
    beads.until(0.01);
    const double v = beads.motion(0).v[0], w = beads.motion(0).w[2], begin = double(beads.model.steps()) * beads.dt();
    beads.until(0.06);
    const double time = double(beads.model.steps()) * beads.dt() - begin;
    const bool rolls = along / down <= 3.5 * mu;
    const double expected = rolls ? 5.0 / 7 * along : along - mu * down;
    compare(fmt::format("incline {} a", angle), (beads.motion(0).v[0] - v) / time, expected, 1e-3);
    compare(fmt::format("incline {} dw/dt", angle), (w - beads.motion(0).w[2]) / time,
            rolls ? expected / 0.5e-3 : 2.5 * mu * down / 0.5e-3, 1e-3);
  }
}

}  // namespace
}  // namespace polybed::scenes
