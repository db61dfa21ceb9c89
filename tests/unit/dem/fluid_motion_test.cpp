// A particle in a frozen fluid: its drag is exact for any step, and what it takes is what it gains.
#include "dem/coupling/fluid_motion.hpp"

#include <gtest/gtest.h>

#include "cloud.hpp"

namespace polybed::dem::test {
namespace {

/// A load in whole units of 2^-60 N, about (1, 5, -4) micronewtons.
constexpr Vector load{0x1p-20, 5 * 0x1p-20, -4 * 0x1p-20};

constexpr PartGroup alone{0, 1};

/// One coarse particle, its force counted in units of 2^-60 N.
struct One {
  Cloud cloud{cloud_scene(3, true)};
  FluidMotion motion;
  double mass;

  explicit One(Vector gravity = {0, -9.81, 0})
      : motion(cloud.materials, 1000, gravity, {std::ldexp(1.0, 60), std::ldexp(1.0, -60)},
               {std::ldexp(1.0, 80), std::ldexp(1.0, -80)}),
        mass(cloud.materials.species()[1].mass) {
    cloud.add(1, {5e-3, 5e-3, 4e-3}, {0.03, -0.02, 0.01});
    motion.load.resize(1);
    motion.load[0].velocity = {-0.01, 0.05, 0.02};
  }
  [[nodiscard]] Motion& state() { return cloud.particles.motion[0]; }
  [[nodiscard]] FluidLoad& feels() { return motion.load[0]; }
  void push(const Vector& force) {
    for (std::size_t k = 0; k < 3; ++k) cloud.particles.load[0].force[k] = std::llround(std::ldexp(force[k], 60));
  }
  [[nodiscard]] FourMotions in_rows() const {
    FourMotions s{};
    const auto put = [](const auto& from, FourVectors& row) {
      row.x[0] = double(from[0]);
      row.y[0] = double(from[1]);
      row.z[0] = double(from[2]);
    };
    put(cloud.particles.motion[0].v, s.v);
    put(cloud.particles.load[0].force, s.load.force);
    return s;
  }
  void kick(double h, WorkShare share = {0.5, 0.5}) {
    motion.relax(cloud.particles, h);
    const FourMotions s = in_rows();
    const FluidMotion::Kick kick = motion.kick(motion.pull(cloud.particles, alone, s, h), s.v);
    motion.account(alone, kick, s, h, share);
    motion.sum_work();
    state().v = {s.v.x[0] + kick.dv.x[0], s.v.y[0] + kick.dv.y[0], s.v.z[0] + kick.dv.z[0]};
  }
};

TEST(FluidMotion, TakesTheSameImpulseWhereItsWorkIsNotCounted) {
  One one;
  one.feels().drag = 2e-5;
  one.feels().added = 0.3 * one.mass;
  one.push(load);
  FluidMotion other(one.cloud.materials, 1000, {0, -9.81, 0}, {std::ldexp(1.0, 60), std::ldexp(1.0, -60)},
                    {std::ldexp(1.0, 80), std::ldexp(1.0, -80)}, false);
  other.load = one.motion.load;
  other.relax(one.cloud.particles, 1e-3);
  const FourMotions s = one.in_rows();
  other.account_impulse(alone, other.kick(other.pull(one.cloud.particles, alone, s, 1e-3), s.v));
  other.account_work(1e-9);
  one.kick(1e-3);
  EXPECT_NE(one.motion.work(), EnergySum());
  EXPECT_EQ(other.work(), EnergySum());
  EXPECT_NE(other.load[0].impulse, Vector{});
  EXPECT_EQ(other.load[0].impulse, one.feels().impulse);
}

// In long double, where neither difference loses digits that matter.
TEST(FluidMotion, RelaxesExactlyForStepsOfAnyLength) {
  for (const double x : {1e-6, 1e-3, 0.0199, 0.0201, 1.0, 10.0, 1e3}) {
    One one;
    const double h = 1e-3, added = 0.4 * one.mass, inertia = one.mass + added;
    one.feels().added = added;
    one.feels().drag = x * inertia / h;
    one.feels().force = {2e-6, -1e-6, 3e-6};
    one.push(load);
    const Vector before = one.state().v;
    one.kick(h);
    for (std::size_t k = 0; k < 3; ++k) {
      const long double weight = k == 1 ? -9.81L * (1 - 1000.0L / 1400) * one.mass : 0;
      const long double force = load[k] + (long double)(one.feels().force[k]) + weight;
      const long double a = force / inertia, kappa = (long double)(x) / h, decay = std::exp(-(long double)(x));
      const long double u = one.feels().velocity[k];
      const long double exact = u + (before[k] - u) * decay - a / kappa * std::expm1(-(long double)(x));
      EXPECT_NEAR(one.state().v[k], double(exact), 3e-16) << "kappa h = " << x;  // of 0.1 m/s: a few units of 1.4e-17
    }
  }
}

// exp(-a - b) = exp(-a) exp(-b), so in a frozen field two halves are a whole, whatever else acts.
TEST(FluidMotion, TwoHalvesAreAWhole) {
  for (const double x : {1e-6, 0.03, 1.0, 50.0}) {
    One whole, halves;
    for (One* one : {&whole, &halves}) {
      one->feels().drag = x * one->mass / 1e-3;
      one->feels().force = {2e-6, -1e-6, 3e-6};
    }
    whole.kick(1e-3);
    halves.kick(0.5e-3);
    halves.kick(0.5e-3);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(halves.state().v[k], whole.state().v[k], 1e-16);
      // Impulses are differences of velocities of 0.1 m/s times the mass: three of their units.
      EXPECT_NEAR(halves.feels().impulse[k], whole.feels().impulse[k], 1e-16 * whole.mass);
    }
  }
}

// What the fluid gives by drag and added mass is what the velocity gains beyond weight, pressure and contacts.
TEST(FluidMotion, CountsWhatItTakesFromTheFluid) {
  for (const double added_share : {0.0, 0.4}) {
    One one;
    const double h = 1e-3;
    one.feels().added = added_share * one.mass;
    one.feels().drag = 0.7 * one.mass / h;
    one.feels().force = {2e-6, -1e-6, 3e-6};
    one.push(load);
    const Vector before = one.state().v;
    one.kick(h);
    one.kick(h);
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = k == 1 ? -9.81 * (1 - 1000.0 / 1400) * one.mass : 0;
      const double others = 2 * h * (load[k] + one.feels().force[k] + weight);
      EXPECT_NEAR(one.feels().impulse[k], one.mass * (one.state().v[k] - before[k]) - others, 1e-16 * one.mass);
    }
  }
}

// Work of the fluid, its buoyancy included, is the energy gained less that of weight and contacts, each along the
// velocity that the step gives it.
class FluidWork : public testing::TestWithParam<WorkShare> {};
TEST_P(FluidWork, IsWhatOthersDoNot) {
  One one;
  const double h = 1e-3;
  one.feels().drag = 0.7 * one.mass / h;
  one.feels().force = {2e-6, -1e-6, 3e-6};
  one.push(load);
  const Vector before = one.state().v;
  one.kick(h, GetParam());
  double energy = 0, others = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double after = one.state().v[k];
    const auto along = [&](double share) { return (1 - share) * before[k] + share * after; };
    energy += 0.5 * one.mass * (after * after - before[k] * before[k]);
    others += h * (along(GetParam().load) * load[k] + along(GetParam().weight) * (k == 1 ? -9.81 * one.mass : 0));
  }
  EXPECT_NEAR(one.motion.work().units() * std::ldexp(1.0, -80), energy - others, 1e-13 * std::abs(others));
}
INSTANTIATE_TEST_SUITE_P(Shares, FluidWork,
                         testing::Values(WorkShare::before_drift(false), WorkShare::after_drift(false),
                                         WorkShare::before_drift(true), WorkShare::after_drift(true)));

// New loads act as after relax(), to the bit.
TEST(FluidMotion, TakesNewLoads) {
  One one, other;
  for (One* each : {&one, &other}) {
    each->feels().drag = 2e-5;
    each->feels().added = 0.3 * each->mass;
    each->feels().force = {2e-6, -1e-6, 3e-6};
    each->motion.relax(each->cloud.particles, 1e-3);
    each->push(load);
  }
  (void)one.motion.take(one.cloud.particles, alone, one.in_rows(), 1e-3);
  other.motion.relax(other.cloud.particles, 1e-3);
  const FourVectors taken = one.motion.pull(one.cloud.particles, alone, one.in_rows(), 1e-3).free;
  const FourVectors relaxed = other.motion.pull(other.cloud.particles, alone, one.in_rows(), 1e-3).free;
  EXPECT_NE(taken.x[0], 0);
  EXPECT_EQ(taken.x[0], relaxed.x[0]);
  EXPECT_EQ(taken.y[0], relaxed.y[0]);
  EXPECT_EQ(taken.z[0], relaxed.z[0]);
}

// A whole number becomes the nearest double, whichever of its halves is large; ties go to the even one.
TEST(Several, RoundsWholeNumbers) {
  const std::int64_t large = (std::int64_t(1) << 62) + 1, tie = (std::int64_t(1) << 53) + 1;
  for (const std::int64_t whole :
       {std::int64_t(0), std::int64_t(1), std::int64_t(-1), tie, -tie, tie + 2, large, -large, std::int64_t(0xffffffff),
        std::int64_t(-0x100000000), INT64_MIN, INT64_MAX}) {
    const std::array<std::int64_t, 4> four{whole, whole, whole, whole};
    Four bits;
    get_four(four.data(), bits);
    EXPECT_EQ(from_whole(bits)[2], double(whole)) << whole;
  }
}

// exp series to x^6/5040: the next term is under 1e-16 below 0.02; both sides of the joint against long double.
TEST(FluidMotion, MeanDecayHasItsSeriesWhereTheDifferenceWouldCancel) {
  EXPECT_EQ(mean_decay(0), 1);
  for (const double x : {1e-12, 1e-6, 1e-3, 0.0199999, 0.02, 0.5, 5.0, 700.0, 1e5})
    EXPECT_NEAR(mean_decay(x), double(-std::expm1(-(long double)(x)) / (long double)(x)), 3e-16) << x;
}

}  // namespace
}  // namespace polybed::dem::test
