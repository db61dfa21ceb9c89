// Lift, spin and history of spheres in the averaged fluid: each against its closed form, what it adds to a run that
// does without it (nothing), to a run taken up again, and to what the fluid is charged with.
#include "scenes/dem_fluid_sides.hpp"

#include <bit>

namespace polybed::scenes {
namespace {

TEST(Lift, HasTheHandValueInALinearShear) {
  core::Scene scene = sphere_in_water(1e-3, 2500, {0.02, 0.02, 0.02}, {5, 5, 5});
  scene.effects["lift"] = "saffman_mei";
  constexpr double rate = 10, lag = 0.02;  // 1/s, m/s
  HeldShear bench(scene, rate, 1e-4);
  bench.add({0.01, 0.011, 0.009}, {rate * 0.011 - lag, 0, 0});
  bench.begin();
  // Re_p = 20, a = 0.25: M = (1 - 0.1657) exp(-2) + 0.1657, and 1.615 d^2 sqrt(mu rho/omega) w omega M towards the
  // faster fluid. The fields have no pressure gradient, so that nothing else is in the load's force.
  const double share = (1 - 0.1657) * std::exp(-2.0) + 0.1657;
  const dem::Vector& force = bench.motion.load[0].force;
  compare("lift, N", force[1], 1.615e-6 * std::sqrt(0.1) * lag * rate * share, 1e-12);  // rate from fields: 1e-14 m/s
  EXPECT_NEAR(force[0], 0, 1e-20);
  EXPECT_NEAR(force[2], 0, 1e-20);
}

TEST(Lift, PointsAwayFromFasterFluidWhereTheSphereLeads) {
  core::Scene scene = sphere_in_water(1e-3, 2500, {0.02, 0.02, 0.02}, {5, 5, 5});
  scene.effects["lift"] = "saffman_mei";
  HeldShear bench(scene, 10, 1e-4);
  bench.add({0.01, 0.011, 0.009}, {10 * 0.011 + 0.02, 0, 0});
  bench.begin();
  EXPECT_LT(bench.motion.load[0].force[1], -2e-8);
}

TEST(Magnus, SpinOfASphereDecaysInStillFluidAndComesToThatOfAShear) {
  core::Scene scene = sphere_in_water(1e-3, 2500, {0.02, 0.02, 0.02}, {5, 5, 5});
  scene.effects["magnus"] = "rubinow_keller";
  for (const double rate : {0.0, 10.0}) {
    HeldShear bench(scene, rate, 1e-3);
    const double y = 0.01;
    bench.add({0.01, y, 0.01}, {rate * y, 0, 0}, {30, -20, 100});
    bench.begin();
    for (int n = 0; n < 40; ++n) bench.step();
    const double left = std::exp(-60 * 1e-3 * 0.04 / (2500 * 1e-6));  // mu t/(rho_p d^2), 40 steps of it
    const dem::Vector& w = bench.particles.motion[0].w;
    compare("spin about x, 1/s", w[0], 30 * left, 1e-12);
    compare("spin about y, 1/s", w[1], -20 * left, 1e-12);
    compare("spin about z, 1/s", w[2], -0.5 * rate + (100 + 0.5 * rate) * left, 1e-12);
    // What the torque takes is counted: of a sphere that moves with the fluid there is no other work. 40 sums in units
    // of 8e-25 J.
    const double inertia = 0.1 * mass_of(0.5e-3, 2500) * 1e-6;
    const double lost = 0.5 * inertia * (1300 + 1e4 - w[0] * w[0] - w[1] * w[1] - w[2] * w[2]);
    if (rate == 0) compare("work of the fluid, J", -bench.motion.work().units() * HeldShear::energy.unit, lost, 1e-12);
  }
}

/// A sphere that flies and spins in still fluid under Stokes' drag: (v_x, v_y, Omega_z) at a time, s, by Runge-Kutta
/// steps of fourth order.
std::array<double, 3> curved_flight(std::array<double, 3> start, double time) {
  const double mass = mass_of(0.5e-3, 2500), drag = 3 * pi * 1e-3 * 1e-3 / mass, turn = pi / 8 * 1000 * 1e-9 / mass;
  const auto rate = [&](const std::array<double, 3>& s) -> std::array<double, 3> {
    return {-drag * s[0] - turn * s[2] * s[1], -drag * s[1] + turn * s[2] * s[0], -60 * 1e-3 / (2500 * 1e-6) * s[2]};
  };
  const auto moved = [](std::array<double, 3> s, const std::array<double, 3>& by, double h) {
    for (std::size_t k = 0; k < 3; ++k) s[k] += h * by[k];
    return s;
  };
  constexpr int steps = 2000;
  const double h = time / steps;
  for (int n = 0; n < steps; ++n) {
    const auto a = rate(start), b = rate(moved(start, a, 0.5 * h)), c = rate(moved(start, b, 0.5 * h)),
               d = rate(moved(start, c, h));
    for (std::size_t k = 0; k < 3; ++k) start[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
  }
  return start;
}

TEST(Magnus, ASpinningSphereIsDeflectedAsItsEquationOfMotionSays) {
  core::Scene scene = sphere_in_water(1e-3, 2500, {0.02, 0.02, 0.02}, {5, 5, 5});
  scene.effects["magnus"] = "rubinow_keller";
  const std::array<double, 3> expected = curved_flight({8e-4, 0, 50}, 0.1);  // Re_p 0.8: below the jump at 1
  std::array<double, 2> error{};
  for (const int fine : {1, 2}) {
    HeldShear bench(scene, 0, 1e-3 / fine);
    bench.add({0.01, 0.01, 0.01}, {8e-4, 0, 0}, {0, 0, 50});
    bench.begin();
    for (int n = 0; n < 100 * fine; ++n) bench.step();
    const dem::Vector& v = bench.particles.motion[0].v;
    error[std::size_t(fine - 1)] =
        std::hypot(v[0] - expected[0], v[1] - expected[1]) / std::hypot(expected[0], expected[1]);
    compare("speed along, m/s", v[0], expected[0], 0.02, expected[1]);
    compare("speed across, m/s", v[1], expected[1], 0.02);
  }
  // First order in the step, which is 1/42 of the spin's time: forces are of velocities of the half step.
  EXPECT_LT(error[0], 0.02);
  EXPECT_NEAR(error[0] / error[1], 2, 0.2);
}

/// v(t) of a sphere released in still fluid, with Stokes' drag, added mass 1/2 and Basset's history, m/s: with x^2 + (B
/// sqrt(pi)/M) x + k/M = (x + a)(x + b) it is W/k {1 - [a exp(b^2 t) erfc(b sqrt t) - b exp(a^2 t) erfc(a sqrt t)]/(a -
/// b)}, from the transform W/s/(M s + B sqrt(pi s) + k). a and b are real below rho_p/rho_f = 5/8.
double released(double time, double d, double density, double rho, double mu, double gravity) {
  const double volume = pi / 6 * d * d * d;
  const double weight = (rho - density) * volume * gravity, mass = (density + 0.5 * rho) * volume, k = 3 * pi * mu * d;
  const double p = 1.5 * pi * d * d * std::sqrt(rho * mu) / mass, root = std::sqrt(p * p - 4 * k / mass);
  const double a = 0.5 * (p + root), b = 0.5 * (p - root), t = time;
  const auto part = [&](double x) { return std::exp(x * x * t) * std::erfc(x * std::sqrt(t)); };
  return weight / k * (1 - (a * part(b) - b * part(a)) / (a - b));
}

TEST(History, ALightSphereRisesAsTheClosedFormSays) {
  core::Scene scene = sphere_in_water(1e-3, 300, {0.02, 0.02, 0.02}, {5, 5, 5});
  scene.effects["history"] = "basset";
  scene.effects["added_mass"] = "half";
  // At 5, 10 and 20 steps of the fluid the error is that of the steps, of second order; later that of the sum of
  // exponentials, whose kernel errs by up to 0.126 %: a tenth of it is seen, for it changes sign on the way.
  std::vector<double> early;
  for (const double time : {0.004, 0.02, 0.1, 0.4}) {
    const double expected = released(time, 1e-3, 300, 1000, 1e-3, 9.81);
    for (const int fine : {1, 2, 4}) {
      HeldShear bench(scene, 0, 2e-4 / fine, 4, 9.81);
      bench.add({0.01, 0.01, 0.01}, {});
      bench.begin();
      for (int n = 0; n < std::lround(time / 2e-4) * fine; ++n) bench.step();
      const double v = bench.particles.motion[0].v[1];
      compare(fmt::format("rise at {} s, {} steps of the fluid, m/s", time, std::lround(time / 8e-4) * fine), v,
              expected, time < 0.01 ? 1e-3 / (fine * fine) : 2e-4);
      if (time < 0.01) early.push_back(v / expected - 1);
    }
  }
  EXPECT_NEAR(early[0] / early[1], 4, 1);
}

// In a fluid that moves, whose cells outweigh the sphere a thousand times: it is set in motion by so much.
TEST(History, ALightSphereRisesSoInABoxOfFluid) {
  core::Scene scene = sphere_in_water(1e-3, 300, {0.06, 0.06, 0.06}, {6, 6, 6});
  scene.effects["history"] = "basset";
  scene.effects["added_mass"] = "half";
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = 1e-4;
  Beads sphere(scene, {{"a", {0.03, 0.02, 0.03}}});
  for (const double time : {0.02, 0.05, 0.1}) {
    sphere.until(time);
    compare(fmt::format("rise in a box at {} s, m/s", time), sphere.motion(0).v[1],
            released(time, 1e-3, 300, 1000, 1e-3, 9.81), 1e-3);
  }
}

/// Three spheres that fly, of which two meet, in water that is sheared at the start.
struct Flight {
  explicit Flight(const core::Scene& scene)
      : scene(scene),
        beads(scene, {{"a", {4e-3, 5e-3, 5e-3}, {0.1, 0.02, 0}, {0, 0, 50}},
                      {"a", {6e-3, 5e-3, 5e-3}, {-0.1, 0.01, 0.01}, {20, 0, -80}},
                      {"a", {8e-3, 12e-3, 9e-3}, {0, -0.1, 0.02}, {0, 30, 0}}}) {
    core::Checkpoint checkpoint = beads.model.checkpoint();
    const core::Grid& grid = beads.model.coupling()->flow().grid();
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 1; i < grid.cells[0]; ++i)
          checkpoint.arrays["fluid_velocity_0"][std::size_t(grid.index(i, j, k))] = 20 * grid.centre(1, j);
    beads.model.resume(checkpoint);
  }
  core::Scene scene;
  Beads beads;
};

core::Scene flight_scene(const std::vector<std::pair<std::string, std::string>>& effects) {
  core::Scene scene = sphere_in_water(1e-3, 2500, {0.016, 0.016, 0.016}, {4, 4, 4});
  core::set_friction(scene, 0.3);
  scene.dem.fixed_step = 2e-5;
  for (const auto& [role, law] : effects) scene.effects[role] = law;
  return scene;
}

void expect_same_bits(const core::Checkpoint& one, const core::Checkpoint& other) {
  ASSERT_EQ(one.arrays.size(), other.arrays.size());
  for (const auto& [name, numbers] : one.arrays) {
    ASSERT_TRUE(other.arrays.contains(name)) << name;
    const std::vector<double>& others = other.arrays.at(name);
    ASSERT_EQ(numbers.size(), others.size()) << name;
    for (std::size_t n = 0; n < numbers.size(); ++n)
      ASSERT_EQ(std::bit_cast<std::uint64_t>(numbers[n]), std::bit_cast<std::uint64_t>(others[n])) << name << " " << n;
  }
}

/// A role, its law, and the numbers that a particle's row has with it.
struct Side {
  const char *role, *law;
  std::size_t width;
};
constexpr Side sides[] = {{"lift", "saffman_mei", 3}, {"magnus", "rubinow_keller", 3}, {"history", "basset", 51}};

TEST(SideForces, LeaveNothingBehindWhereTheyAreOff) {
  Flight bare(flight_scene({})), off(flight_scene({{"lift", "none"}, {"magnus", "none"}, {"history", "none"}}));
  for (Flight* flight : {&bare, &off}) flight->beads.steps(200);
  expect_same_bits(bare.beads.model.checkpoint(), off.beads.model.checkpoint());
  const dem::Coupling& coupling = *off.beads.model.coupling();
  EXPECT_FALSE(coupling.sides().present());
  EXPECT_EQ(coupling.sides().rows().width, 0u);
  EXPECT_EQ(coupling.sides().rows().numbers.capacity(), 0u);
  EXPECT_FALSE(off.beads.model.checkpoint().arrays.contains("fluid_sides"));
}

TEST(SideForces, HaveARowOfEachParticleInTheCheckpointWhereTheyAreOn) {
  for (const Side& side : sides) {
    Flight flight(flight_scene({{side.role, side.law}}));
    flight.beads.steps(10);
    EXPECT_EQ(flight.beads.model.checkpoint().arrays.at("fluid_sides").size(), 3 * (1 + side.width)) << side.role;
  }
}

TEST(SideForces, ChangeTheMotion) {
  Flight bare(flight_scene({}));
  bare.beads.steps(200);
  for (const Side& side : sides) {
    Flight flight(flight_scene({{side.role, side.law}}));
    flight.beads.steps(200);
    EXPECT_NE(flight.beads.motion(2).v, bare.beads.motion(2).v) << side.role;
  }
}

TEST(SideForces, GoOnWithTheSameBitsAfterARestart) {
  for (const Side& side : sides) {
    const core::Scene scene = flight_scene({{side.role, side.law}});
    Flight through(scene), taken_up(scene);
    through.beads.steps(330);  // the two have met; not at a step of the fluid
    through.beads.model.restart();
    taken_up.beads.model.resume(through.beads.model.checkpoint());
    for (Flight* flight : {&through, &taken_up}) flight->beads.steps(330);
    SCOPED_TRACE(side.role);
    expect_same_bits(through.beads.model.checkpoint(), taken_up.beads.model.checkpoint());
  }
}

// Contacts and films are in the memory of pairs.
TEST(Lubrication, GoesOnWithTheSameBitsAfterARestart) {
  std::vector<core::Checkpoint> ends;
  for (const char* law : {"none", "wet_restitution", "film"}) {
    const core::Scene scene = flight_scene({{"lubrication", law}});
    Flight through(scene), taken_up(scene);
    std::int64_t steps = 0;
    while (through.beads.model.pairs().touching.empty() && steps < 1000) {
      through.beads.steps(1);
      ++steps;
    }
    ASSERT_FALSE(through.beads.model.pairs().touching.empty()) << law;
    through.beads.model.restart();
    taken_up.beads.model.resume(through.beads.model.checkpoint());
    for (Flight* flight : {&through, &taken_up}) flight->beads.steps(700 - steps);
    SCOPED_TRACE(law);
    expect_same_bits(through.beads.model.checkpoint(), taken_up.beads.model.checkpoint());
    ends.push_back(through.beads.model.checkpoint());
  }
  EXPECT_NE(ends[0].arrays.at("particles"), ends[1].arrays.at("particles"));
  EXPECT_NE(ends[0].arrays.at("particles"), ends[2].arrays.at("particles"));
  EXPECT_EQ(ends[0].integers.at("memory_size") + 1, ends[1].integers.at("memory_size"));
  EXPECT_EQ(ends[0].integers.at("memory_size") + 2, ends[2].integers.at("memory_size"));
}

/// Those with a memory, that is: the others begin with what they meet, as where the monitor has switched them on.
TEST(SideForces, RefuseACheckpointWithoutTheirMemory) {
  Flight bare(flight_scene({}));
  for (const Side& side : sides) {
    Flight flight(flight_scene({{side.role, side.law}}));
    if (side.width > 3)
      EXPECT_THROW(flight.beads.model.resume(bare.beads.model.checkpoint()), core::FileError) << side.role;
    else
      EXPECT_NO_THROW(flight.beads.model.resume(bare.beads.model.checkpoint())) << side.role;
  }
}

TEST(SideForces, RefuseWhatContradictsThem) {
  core::Scene smooth = flight_scene({{"magnus", "rubinow_keller"}, {"contact", "hertz"}});
  EXPECT_THROW(Beads(smooth, {{"a", {5e-3, 5e-3, 5e-3}}}), core::CaseError);
  core::Scene held = flight_scene({{"history", "basset"}});
  held.bed.held = true;
  EXPECT_THROW(Beads(held, {{"a", {5e-3, 5e-3, 5e-3}}}), core::CaseError);
}

TEST(SideForces, NeedAFluid) {
  for (const Side& side : sides) {
    core::Scene scene = flight_scene({{side.role, side.law}});
    scene.fluid.name = "none";
    EXPECT_THROW(Beads(scene, {{"a", {5e-3, 5e-3, 5e-3}}}), core::CaseError) << side.role;
  }
}

// Neither spin nor vorticity, neither of which comes from nothing: a column one cell wide has no shear.
TEST(SideForces, OfNoStrengthAreAsIfTheyWereOff) {
  core::Scene scene = sphere_in_water(1e-3, 2500, {0.01, 0.04, 0.003}, {1, 16, 1});
  scene.column.dimensions = 2;
  scene.column.sides = core::Boundary::periodic;
  scene.column.gravity = 9.81;
  scene.dem.fixed_step = 1e-4;
  std::vector<core::Checkpoint> ends;
  std::vector<double> speed;
  for (const char* role : {"none", "lift", "magnus"}) {
    core::Scene with = scene;
    if (std::string(role) != "none")
      with.effects[role] = std::string(role) == "lift" ? "saffman_mei" : "rubinow_keller";
    Beads falling(with, {{"a", {5e-3, 30e-3, 1e-3}}, {"a", {3e-3, 20e-3, 2e-3}}});
    falling.steps(300);
    ends.push_back(falling.model.checkpoint());
    ends.back().arrays.erase("fluid_sides");
    speed.push_back(falling.motion(0).v[1]);
  }
  // Equal but for the sign of zeros.
  EXPECT_EQ(ends[1].arrays, ends[2].arrays);
  // Without them loads stand over 4 steps, a hundredth of the relaxation time, and what that leaves is of second order.
  EXPECT_NEAR(speed[0], speed[1], 1e-4 * std::abs(speed[0]));
}

// Fields that the test holds have no pressure gradient and the sphere no weight: all it gains is the fluid's.
TEST(SideForces, TakeWhatTheyGiveOverManyStepsOfTheFluid) {
  core::Scene scene = sphere_in_water(1e-3, 2500, {0.02, 0.02, 0.02}, {5, 5, 5});
  for (const Side& side : sides) scene.effects[side.role] = side.law;
  HeldShear bench(scene, 10, 1e-3, 4);
  const dem::Vector v{0.2, 0.01, -0.03};
  bench.add({0.008, 0.01, 0.01}, v, {10, 20, 80});
  bench.begin();
  for (int n = 0; n < 40; ++n) bench.step();
  for (std::size_t k = 0; k < 3; ++k) {
    const double gained = (bench.particles.motion[0].v[k] - v[k]) * mass_of(0.5e-3, 2500);
    EXPECT_NEAR(bench.motion.load[0].impulse[k], gained, 1e-13 * mass_of(0.5e-3, 2500) * 0.2);  // 80 roundings
    EXPECT_GT(std::abs(gained), 1e-10);
  }
}

// Between two steps of the fluid there is neither weight nor a pressure gradient: what a particle gains comes from its
// contacts, which give both of a pair the same, and from the fluid, which has to be charged with all of it.
TEST(SideForces, TakeFromTheFluidWhatTheyGive) {
  for (const Side& side : sides) {
    core::Scene scene = flight_scene({{side.role, side.law}});
    scene.dem.fluid_every = 400;
    Flight flight(scene);
    const double mass = mass_of(0.5e-3, 2500);
    std::array<dem::Vector, 3> before;
    for (std::size_t n = 0; n < 3; ++n) before[n] = flight.beads.motion(std::int64_t(n)).v;
    flight.beads.steps(399);
    dem::Vector gained{}, given{};
    for (std::size_t n = 0; n < 3; ++n)
      for (std::size_t k = 0; k < 3; ++k) {
        gained[k] += mass * (flight.beads.motion(std::int64_t(n)).v[k] - before[n][k]);
        given[k] += flight.beads.model.coupling()->motion().load[n].impulse[k];
      }
    // 400 steps of three particles, each rounded to a double of the greatest momentum.
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(given[k], gained[k], 1200 * 1.1e-16 * mass * 0.1) << side.role << k;
  }
}

}  // namespace
}  // namespace polybed::scenes
