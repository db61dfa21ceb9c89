// Lift, spin and history of spheres in the averaged fluid: each against its closed form, what it adds to a run that
// does without it (nothing), to a run taken up again, and to what the fluid is charged with.
#include "dem_fluid_sides.hpp"

#include <bit>

namespace polybed::verification {
namespace {

// Some ten operations on numbers that do not cancel.
constexpr double round_off = 1e-13;

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
  scene.dem.friction = 0.3;
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
constexpr Side sides[] = {{"lift", "saffman_mei", 3}};

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

TEST(SideForces, RefuseACheckpointWithoutThem) {
  Flight bare(flight_scene({}));
  for (const Side& side : sides) {
    Flight flight(flight_scene({{side.role, side.law}}));
    EXPECT_THROW(flight.beads.model.resume(bare.beads.model.checkpoint()), core::FileError) << side.role;
  }
}

TEST(SideForces, NeedAFluid) {
  for (const Side& side : sides) {
    core::Scene scene = flight_scene({{side.role, side.law}});
    scene.fluid.name = "none";
    EXPECT_THROW(Beads(scene, {{"a", {5e-3, 5e-3, 5e-3}}}), core::CaseError) << side.role;
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
}  // namespace polybed::verification
