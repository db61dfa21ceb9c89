#include "measures/particle_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "measures/bed.hpp"
#include "scenes/snapshot_profile.hpp"
#include "scenes/stored_steps.hpp"

namespace polybed::measures {
namespace {

constexpr double pi = std::numbers::pi;
/// Rounding of a few operations on numbers near 1.
constexpr double rounding = 1e-14;

/// Particles one by one.
struct Bed {
  core::ParticleStep p;
  void add(int species, double radius, std::array<double, 3> x, std::array<double, 3> u = {}) {
    p.id.push_back(std::int64_t(p.id.size()));
    p.species.push_back(species);
    p.radius.push_back(radius);
    p.position.push_back(x);
    p.velocity.push_back(u);
    p.spin.push_back({});
  }
  [[nodiscard]] core::ParticleSnapshot view() const {
    return {p.id, p.species, p.radius, p.position, p.velocity, p.spin};
  }
};

Bed shuffled(const Bed& bed, unsigned seed) {
  std::vector<std::size_t> order(bed.p.id.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  Bed other;
  for (std::size_t i : order) other.add(bed.p.species[i], bed.p.radius[i], bed.p.position[i], bed.p.velocity[i]);
  return other;
}

/// 20 000 particles of two sizes, mixed below 0.12 m in a column of 0.06 x 0.2 x 0.004 m.
Bed random_bed() {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  Bed bed;
  for (int n = 0; n < 20'000; ++n) {
    const int species = n % 3 == 0;
    const std::array<double, 3> x{0.06 * unit(random), 0.12 * unit(random), 0.004 * unit(random)};
    bed.add(species, species ? 3e-4 : 2e-4, x, {unit(random) - 0.5, unit(random), -unit(random)});
  }
  return bed;
}

const Slabs column{0.06 * 0.004, 0.2, 100};

TEST(SphereVolumeBelow, CapsByHand) {
  EXPECT_EQ(sphere_volume_below(2, 10, 8), 0);
  EXPECT_EQ(sphere_volume_below(2, 10, 7), 0);
  EXPECT_NEAR(sphere_volume_below(2, 10, 9) / (5 * pi / 3), 1, rounding);    // h = 1: pi (6 - 1)/3
  EXPECT_NEAR(sphere_volume_below(2, 10, 10) / (16 * pi / 3), 1, rounding);  // half of 4/3 pi 8
  EXPECT_NEAR(sphere_volume_below(2, 10, 11) / (27 * pi / 3), 1, rounding);  // the sphere less the first cap
  EXPECT_NEAR(sphere_volume_below(2, 10, 12) / (32 * pi / 3), 1, rounding);
  EXPECT_EQ(sphere_volume_below(2, 10, 50), sphere_volume_below(2, 10, 12));
}

// A sphere of radius 2 at height 5 in slabs of 2 (planes 2, 4, 6, 8): nothing below 2; 3 to 4 is the cap h = 1, 5 pi/3;
// 4 to 6 the middle, 32 pi/3 - 2 * 5 pi/3 = 22 pi/3; 6 to 7 the other cap.
TEST(ParticleProfile, ASphereOverThreeSlabs) {
  Bed bed;
  bed.add(0, 2, {0, 5, 0}, {0.5, -3, 0.25});
  const ParticleProfile profile = particle_profile(bed.view(), 1, {10, 10, 5});
  const std::vector<double> volume{0, 5 * pi / 3, 22 * pi / 3, 5 * pi / 3, 0};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(profile.solids.fraction[0][k], volume[k] / 20, rounding) << k;
    EXPECT_NEAR(profile.velocity[0][k], volume[k] > 0 ? -3 : 0, 3 * rounding) << k;
    EXPECT_NEAR(profile.temperature[0][k], 0, 10 * rounding) << k;  // |u|^2 is 9.3
  }
  EXPECT_EQ(profile.solids.slab, 2);
}

// In one slab: a sphere of volume 1 at (1, 2, 0) m/s, one of volume 8 at (1, -1, 3) m/s. Mean (1, -2/3, 8/3); mean of
// |u|^2 = (5 + 8 * 11)/9 = 31/3; less |mean|^2 = 1 + 4/9 + 64/9 = 77/9; theta = 16/27.
TEST(ParticleProfile, MeansAreWeightedByVolume) {
  const double r = std::cbrt(3 / (4 * pi));
  Bed bed;
  bed.add(0, r, {0, 5, 0}, {1, 2, 0});
  bed.add(0, 2 * r, {0, 4, 0}, {1, -1, 3});
  bed.add(1, r, {0, 3, 0}, {0, 7, 0});  // another species is not part of the mean
  const ParticleProfile profile = particle_profile(bed.view(), 3, {2, 10, 1});
  EXPECT_NEAR(profile.solids.fraction[0][0], 9.0 / 20, rounding);
  EXPECT_NEAR(profile.velocity[0][0], -2.0 / 3, rounding);
  EXPECT_NEAR(profile.temperature[0][0], 16.0 / 27, 10 * rounding);  // of a difference of 10.3 and 8.6
  EXPECT_NEAR(profile.velocity[1][0], 7, 10 * rounding);
  EXPECT_EQ(profile.solids.fraction[2][0], 0);
  EXPECT_EQ(profile.velocity[2][0], 0);
  EXPECT_EQ(profile.temperature[2][0], 0);
}

/// Solids volume of a species in all slabs, m3.
double volume_in(const ParticleProfile& profile, const Slabs& slabs, std::size_t species = 0) {
  const std::vector<double>& phi = profile.solids.fraction[species];
  return std::accumulate(phi.begin(), phi.end(), 0.0) * slabs.area * slabs.thickness();
}

TEST(ParticleProfile, APressedParticleCountsWhereItWouldTouchTheEnd) {
  Bed pressed, touching;
  pressed.add(0, 1, {0, 0.9, 0});
  pressed.add(0, 1, {0, 10, 0});
  touching.add(0, 1, {0, 1, 0});
  touching.add(0, 1, {0, 9, 0});
  for (std::size_t count : {std::size_t(5), std::size_t(1000)}) {
    const Slabs slabs{4, 10, count};
    const ParticleProfile profile = particle_profile(pressed.view(), 1, slabs);
    EXPECT_EQ(profile.solids.fraction, particle_profile(touching.view(), 1, slabs).solids.fraction);
    EXPECT_NEAR(volume_in(profile, slabs) / (8 * pi / 3), 1, 10 * rounding);
    const auto& phi = profile.solids.fraction[0];
    EXPECT_LE(*std::max_element(phi.begin(), phi.end()), pi / 4);  // of the square around a sphere its middle fills
  }
}

// Through an opening: one that is half below a cap h = 0.5, pi h^2 (3 - h)/3 = 5 pi/24, and one that has left.
TEST(ParticleProfile, WhatHasLeftThroughAnOpeningDoesNotCount) {
  Bed bed;
  bed.add(0, 1, {0, -0.5, 0});
  bed.add(0, 1, {0, -3, 0});
  const Slabs slabs{4, 10, 1000};
  const ParticleProfile profile = particle_profile(bed.view(), 1, slabs);
  EXPECT_NEAR(volume_in(profile, slabs) / (5 * pi / 24), 1, 10 * rounding);
  EXPECT_NEAR(profile.solids.fraction[0][0] / (pi * (0.01 - (0.51 * 0.51 * 0.51 - 0.125) / 3) / 0.04), 1, 1e-12);
}

// Spheres of radius 1 that touch in squares of 2 x 2, layers 2 apart, moved by a height: in slabs much thinner than a
// sphere every layer is the same, those through both ends too.
TEST(ParticleProfile, GoesOnThroughJoinedEnds) {
  constexpr std::size_t in_a_layer = 50;
  const Slabs slabs{4, 10, 5 * in_a_layer, true};
  for (const double moved : {0.0, 0.3, 1.0, 1.7}) {
    Bed bed;
    for (int n = 0; n < 5; ++n) bed.add(0, 1, {0, 2 * n + moved, 0});
    const ParticleProfile profile = particle_profile(bed.view(), 1, slabs);
    EXPECT_NEAR(volume_in(profile, slabs) / (20 * pi / 3), 1, 10 * rounding);
    const auto& phi = profile.solids.fraction[0];
    for (std::size_t k = 0; k < slabs.count; ++k) EXPECT_NEAR(phi[k], phi[k % in_a_layer], 100 * rounding) << moved;
    EXPECT_NEAR(*std::max_element(phi.begin(), phi.end()), pi / 4, 1e-3);
  }
}

// The box's flow takes a particle through its top to the speed of the particles at its bottom: no slab is agitated.
TEST(ParticleProfile, OfAShearedBoxHasTheVelocityOfTheImages) {
  const Slabs slabs{4, 10, 10, true, 6};
  Bed bed;
  bed.add(0, 1, {0, 9.75, 0}, {3, 0, 0});
  bed.add(0, 1, {0, 0.25, 0}, {-3, 0, 0});
  ParticleExtremes most = extremes_of(bed.view());
  most.momentum *= 3;  // an image moves at 9 m/s
  most.energy *= 9;
  const ParticleProfile profile = particle_profile(particle_sums(bed.view(), 1, slabs, most), 1, slabs);
  for (std::size_t k = 0; k < slabs.count; ++k) EXPECT_NEAR(profile.temperature[0][k], 0, 100 * rounding) << k;
  EXPECT_GT(profile.solids.fraction[0][0], 0);
  EXPECT_NEAR(volume_in(profile, slabs) / (8 * pi / 3), 1, 10 * rounding);
}

TEST(ParticleProfile, HasTheVolumeOfItsParticles) {
  const Bed bed = random_bed();
  const ParticleSums sums = particle_sums(bed.view(), 2, column, extremes_of(bed.view()));
  for (std::size_t j = 0; j < 2; ++j) {
    const auto* first = &sums.sum[j * ParticleSums::quantities * column.count];
    const double volume = double(std::accumulate(first, first + column.count, std::int64_t(0))) * sums.unit[0];
    const double number = double(std::count(bed.p.species.begin(), bed.p.species.end(), int(j)));
    const double radius = j ? 3e-4 : 2e-4, sphere = 4 * pi * radius * radius * radius / 3;
    EXPECT_NEAR(volume / (number * sphere), 1, 0.5 * sums.unit[0] / sphere + rounding);  // half a unit per particle
  }
  // A unit is at most twice what 2^62 of it need for 20 000 < 2^15 spheres of the larger volume.
  EXPECT_LT(sums.unit[0], std::ldexp(extremes_of(bed.view()).volume, -46));
}

TEST(ParticleProfile, DoesNotDependOnTheOrder) {
  const Bed bed = random_bed();
  const ParticleProfile here = particle_profile(bed.view(), 2, column);
  for (unsigned seed : {1u, 2u, 3u}) {
    const Bed other = shuffled(bed, seed);
    const ParticleProfile there = particle_profile(other.view(), 2, column);
    EXPECT_EQ(here.solids.fraction, there.solids.fraction);
    EXPECT_EQ(here.velocity, there.velocity);
    EXPECT_EQ(here.temperature, there.temperature);
  }
}

// As on three ranks: the extremes are agreed, then the whole numbers are added up.
TEST(ParticleProfile, PartsAddUpToTheBit) {
  const Bed bed = random_bed();
  std::array<Bed, 3> parts;
  for (std::size_t i = 0; i < bed.p.id.size(); ++i)
    parts[i * i % 3].add(bed.p.species[i], bed.p.radius[i], bed.p.position[i], bed.p.velocity[i]);
  ParticleExtremes all;
  for (const Bed& part : parts) {
    const ParticleExtremes one = extremes_of(part.view());
    all = {all.particles + one.particles, std::max(all.volume, one.volume), std::max(all.momentum, one.momentum),
           std::max(all.energy, one.energy)};
  }
  ParticleSums total = particle_sums(parts[0].view(), 2, column, all);
  for (std::size_t n : {1u, 2u}) {
    const ParticleSums more = particle_sums(parts[n].view(), 2, column, all);
    for (std::size_t i = 0; i < total.sum.size(); ++i) total.sum[i] += more.sum[i];
  }
  EXPECT_EQ(total.sum, particle_sums(bed.view(), 2, column, extremes_of(bed.view())).sum);
}

TEST(ParticleProfile, NothingGivesAnEmptyBed) {
  const Bed bed;
  const ParticleProfile profile = particle_profile(bed.view(), 2, column);
  EXPECT_FALSE(bed_height(profile.solids));
  EXPECT_EQ(profile.solids.fraction[1], std::vector<double>(100, 0.0));
}

// Two layers of spheres on a lattice of 2 mm: fine ones (D 1 mm) at 1 .. 59 mm, coarse ones (D 2 mm) at 61 .. 119 mm,
// in volumes 1 : 8. The continuum's measures find the same: centres at 30 and 90 mm, the top at 120 mm within a slab of
// 2 mm. Both species lie apart, in volumes 1 : 8: the interface is at 60 mm.
TEST(ParticleProfile, IsMeasuredAsAContinuumIs) {
  Bed bed;
  for (int level = 0; level < 60; ++level)
    for (int across = 0; across < 30; ++across)
      bed.add(level >= 30, level >= 30 ? 1e-3 : 0.5e-3, {0.001 + 0.002 * across, 0.001 + 0.002 * level, 0.001});
  const ParticleProfile profile = particle_profile(bed.view(), 2, {0.06 * 0.002, 0.2, 100});
  EXPECT_NEAR(*centre(profile.solids, 0), 0.030, 1e-15);
  EXPECT_NEAR(*centre(profile.solids, 1), 0.090, 1e-15);
  EXPECT_NEAR(profile.solids.fraction[1][40], pi / 6, rounding);  // touching spheres on a cubic lattice
  EXPECT_NEAR(*bed_height(profile.solids), 0.120, 1e-3);
  EXPECT_NEAR(*interface_height(profile.solids), 0.060, rounding);
  EXPECT_NEAR(*mixing(profile.solids), 0, rounding);
}

}  // namespace
}  // namespace polybed::measures
