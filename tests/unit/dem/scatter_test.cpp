// What goes from particles to the fluid is all of what they have, in any order and shared in any way.
#include "dem/coupling/scatter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cloud.hpp"

namespace polybed::dem::test {
namespace {

constexpr std::size_t number = 300;

struct Given {
  fluid::ParticlePhase phase;
  std::vector<core::Field> fraction;
};

Given give(Cloud& cloud, double dt = 1e-3, bool held = false) {
  const bool added =
      std::any_of(cloud.loads.begin(), cloud.loads.end(), [](const FluidLoad& f) { return f.added > 0; });
  Scatter scatter(cloud.grid, cloud.grid, cloud.materials, added, cloud.volume, 0.2);
  Given given{fluid::ParticlePhase(cloud.grid, added), {core::make_field(cloud.grid), core::make_field(cloud.grid)}};
  if (held)
    scatter.collect_held(nullptr, cloud.particles, cloud.loads, dt);
  else
    scatter.collect(cloud.particles, cloud.loads, dt);
  scatter.give(nullptr, nullptr, false, given.phase, given.fraction);
  return given;
}

double sum(const core::Field& field) { return std::accumulate(field.begin(), field.end(), 0.0); }

/// Both kinds of columns, two and three dimensions, with and without added mass.
template <class Body>
void for_each_column(Body&& body) {
  for (const int dimensions : {2, 3})
    for (const bool periodic : {false, true})
      for (const bool added : {false, true}) {
        SCOPED_TRACE(testing::Message() << dimensions << "-D, periodic " << periodic << ", added mass " << added);
        Cloud cloud(cloud_scene(dimensions, periodic), number, added);
        body(cloud);
      }
}

/// Truncation to whole units: at most one for every particle and entry; a unit is at most 2^-61 of the greatest sum.
double whole_units(double most) { return double(number) * 8 * most * std::ldexp(1.0, -61); }

TEST(Scatter, GivesAllOfTheParticlesVolume) {
  for_each_column([](Cloud& cloud) {
    const Given given = give(cloud);
    const double psi = cloud.grid.cell_volume();
    std::array<double, 2> expected{};
    for (std::size_t i = 0; i < number; ++i)
      expected[std::size_t(cloud.particles.species[i])] += Cloud::volume_of(cloud.particles.place[i].radius);
    // The sums of the test itself: 1e3 terms of round-off.
    const double allowed = whole_units(cloud.volume) + 1e3 * 1.1e-16 * cloud.volume;
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(psi * sum(given.fraction[j]), expected[j], allowed);
    double least = 1;
    core::for_each_row(cloud.grid, [&](core::Index begin, core::Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        EXPECT_NEAR(given.phase.voidage[c], 1 - given.fraction[0][c] - given.fraction[1][c], 3e-16);
        least = std::min(least, given.phase.voidage[c]);
      }
    });
    EXPECT_LT(least, 0.99);  // there is something to look at
    for (int axis = 0; axis < cloud.grid.dimensions; ++axis) {
      double on_faces = 0;
      for (const double eps : given.phase.voidage_on[std::size_t(axis)]) on_faces += 1 - eps;
      // 1 - (1 - phi) of about 150 faces: half a unit in the last place of 1 each.
      EXPECT_NEAR(psi * on_faces, cloud.volume, allowed + psi * 1.1e-16 * double(cloud.grid.padded_size()));
    }
  });
}

TEST(Scatter, GivesAllOfTheImpulsesAndFluxes) {
  for_each_column([](Cloud& cloud) {
    const Given given = give(cloud);
    const double psi = cloud.grid.cell_volume();
    for (std::size_t a = 0; a < std::size_t(cloud.grid.dimensions); ++a) {
      double impulse = 0, flux = 0, largest = 0;
      for (std::size_t i = 0; i < number; ++i) {
        impulse += cloud.loads[i].impulse[a];
        largest += std::abs(cloud.loads[i].impulse[a]);
        flux += Cloud::volume_of(cloud.particles.place[i].radius) * cloud.particles.motion[i].v[a];
      }
      // A unit stands for 64 times the momentum of all at 0.2 m/s.
      const double momentum = cloud.volume * 2500 * 0.2 * 64, fluxes = cloud.volume * 0.2 * 64;
      EXPECT_NEAR(psi * sum(given.phase.impulse[a]), impulse, whole_units(momentum) + 1e-13 * largest);
      EXPECT_NEAR(psi * sum(given.phase.flux[a]), flux, whole_units(fluxes) + 1e-13 * cloud.volume * 0.1);
    }
  });
}

// One particle amid cells: all its answers by hand. kappa dt = k dt/M.
TEST(Scatter, GivesTheAnswerOfAParticle) {
  Cloud cloud(cloud_scene(3, true));
  cloud.add(1, {5e-3, 4e-3, 5e-3}, {0.02, 0, 0});  // on a face of y, in the middle of a cell in x and z
  const double dt = 2e-3, mass = 1 / cloud.particles.motion[0].inverse_mass, added = 0.3 * mass, inertia = 1.3 * mass;
  FluidLoad& f = cloud.loads[0];
  f.added = added;
  f.drag = 700 * inertia;  // kappa dt = 1.4
  const double decay = std::exp(-1.4), s = (1 - decay) / 1.4, g = 1 - decay, v = cloud.volume;
  const Given given = give(cloud, dt);
  const double psi = cloud.grid.cell_volume();
  const auto at = std::size_t(cloud.grid.index(2, 2, 2));
  const auto y = [&](const core::FaceField& field) { return field[1][at] * psi; };
  EXPECT_NEAR(y(given.phase.drag), mass * (g + 0.3 / 1.3 * s), 1e-13 * mass);
  EXPECT_NEAR(y(given.phase.follow), v * (g + 0.3 / 1.3 * s), 1e-13 * v);
  EXPECT_NEAR(y(given.phase.slide), v * (1 - s / 1.3), 1e-13 * v);
  EXPECT_NEAR(y(given.phase.yield), v * v * s / inertia, 1e-13 * v * v / inertia);
  EXPECT_NEAR(y(given.phase.carry), mass * 0.3 / 1.3 * s, 1e-13 * mass);
  EXPECT_NEAR(y(given.phase.carry_flux), v * 0.3 / 1.3 * s, 1e-13 * v);
  // Half of its flux along x on either side: the place is that of the cell's centre.
  EXPECT_NEAR(given.phase.flux[0][std::size_t(cloud.grid.index(2, 1, 2))] * psi, 0.25 * 0.02 * v, 1e-13 * v);
}

TEST(Scatter, OfAFixedBedHasDragAlone) {
  Cloud cloud(cloud_scene(2, false), number);
  const Given given = give(cloud, 1e-3, true);
  double drag = 0;
  for (const FluidLoad& f : cloud.loads) drag += f.drag * 1e-3;
  EXPECT_NEAR(sum(given.phase.drag[1]) * cloud.grid.cell_volume(), drag,
              whole_units(cloud.volume * 2500 * 64) + 1e-13 * drag);
  for (const core::FaceField* none : {&given.phase.follow, &given.phase.slide, &given.phase.yield})
    EXPECT_EQ(sum((*none)[1]), 0);
}

// A held particle is not stopped by its drag: over a step it may take a thousand times what would stop a free one.
TEST(Scatter, OfOneHeldParticleHoldsStepsOfAThousandRelaxationTimes) {
  for (const double relaxations : {1e-3, 1.0, 1e3, 1e6}) {
    Cloud cloud(cloud_scene(3, true));
    cloud.add(1, {5.3e-3, 4.2e-3, 5.1e-3});
    const double mass = 1 / cloud.particles.motion[0].inverse_mass, dt = 1e-3;
    cloud.loads[0].drag = relaxations * mass / dt;
    cloud.loads[0].impulse = {0, relaxations * mass * 0.1, 0};
    const Given given = give(cloud, dt, true);
    const double psi = cloud.grid.cell_volume();
    EXPECT_NEAR(sum(given.phase.drag[1]) * psi, relaxations * mass, 1e-12 * relaxations * mass) << relaxations;
    EXPECT_NEAR(sum(given.phase.impulse[1]) * psi, relaxations * mass * 0.1, 1e-12 * relaxations * mass) << relaxations;
  }
}

/// Fields of two runs, bit by bit.
void expect_same(const fluid::ParticlePhase& one, const fluid::ParticlePhase& other) {
  EXPECT_EQ(one.voidage, other.voidage);
  EXPECT_EQ(one.voidage_on, other.voidage_on);
  EXPECT_EQ(one.flux, other.flux);
  EXPECT_EQ(one.impulse, other.impulse);
  EXPECT_EQ(one.drag, other.drag);
  EXPECT_EQ(one.follow, other.follow);
  EXPECT_EQ(one.slide, other.slide);
  EXPECT_EQ(one.yield, other.yield);
  EXPECT_EQ(one.carry, other.carry);
  EXPECT_EQ(one.carry_flux, other.carry_flux);
}

TEST(Scatter, DoesNotDependOnTheOrderOfTheParticles) {
  for_each_column([](Cloud& cloud) {
    const Given before = give(cloud);
    std::vector<std::size_t> order(number);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::shuffle(order.begin(), order.end(), std::mt19937_64(5));
    const Particles particles = cloud.particles;
    const std::vector<FluidLoad> loads = cloud.loads;
    for (std::size_t i = 0; i < number; ++i) {
      cloud.particles.set(i, particles.at(order[i]));
      cloud.loads[i] = loads[order[i]];
    }
    const Given after = give(cloud);
    expect_same(before.phase, after.phase);
    EXPECT_EQ(before.fraction, after.fraction);
  });
}

/// A cloud with some of the particles of another.
Cloud part_of(const Cloud& cloud, std::size_t begin, std::size_t end) {
  Cloud part(cloud.scene);
  for (std::size_t i = begin; i < end; ++i) {
    part.particles.add(cloud.particles.at(i));
    part.loads.push_back(cloud.loads[i]);
  }
  part.particles.owned = part.particles.size();
  part.volume = cloud.volume;  // units follow from that of all particles
  return part;
}

// The sums are whole numbers of one unit: parts add up but for the conversion to double of each.
TEST(Scatter, OfTwoPartsAddsUpToThatOfAll) {
  for_each_column([](Cloud& cloud) {
    const Given all = give(cloud);
    Cloud low = part_of(cloud, 0, number / 3), high = part_of(cloud, number / 3, number);
    const Given one = give(low), other = give(high);
    for (std::size_t a = 0; a < std::size_t(cloud.grid.dimensions); ++a)
      for (std::size_t c = 0; c < all.phase.impulse[a].size(); ++c) {
        const double p = one.phase.impulse[a][c], q = other.phase.impulse[a][c], whole = all.phase.impulse[a][c];
        EXPECT_NEAR(p + q, whole, 2.3e-16 * (std::abs(p) + std::abs(q) + std::abs(whole)));
      }
  });
}

// Sums of nothing have a unit too: where nothing can move, speeds are 0 at most.
TEST(FixedPoint, OfNothingIsOne) {
  EXPECT_EQ(FixedPoint::for_sums_of(0, 1).unit, 1);
  const FixedPoint some = FixedPoint::for_sums_of(3, 5);  // 15 2^58 is below 2^62, 15 2^59 is not
  EXPECT_EQ(some.per_unit, std::ldexp(1.0, 58));
  EXPECT_EQ(some.unit, std::ldexp(1.0, -58));
}

}  // namespace
}  // namespace polybed::dem::test
