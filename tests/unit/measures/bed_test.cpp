#include "measures/bed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace polybed::measures {
namespace {

constexpr double slab = 2e-3;

/// phi_j(z) from functions, 100 slabs of 2 mm, sampled at the centres.
template <class... Phi>
Profile profile_of(Phi... phi) {
  Profile p;
  p.slab = slab;
  (p.fraction.push_back([&] {
    std::vector<double> values(100);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = phi((double(k) + 0.5) * slab);
    return values;
  }()),
   ...);
  return p;
}

double step(double z, double from, double to, double value) { return z > from && z < to ? value : 0.0; }

TEST(Measures, OfAUniformBed) {
  const Profile p = profile_of([](double z) { return step(z, 0, 0.1, 0.5); });
  EXPECT_NEAR(*bed_height(p), 0.1, slab / 2);  // the step lies between two centres
  EXPECT_NEAR(*centre(p, 0), 0.05, 1e-15);
  EXPECT_NEAR(*volume_quantile(p, 0.25), 0.025, 1e-15);
  EXPECT_FALSE(mixing(p));
  EXPECT_FALSE(interface_height(p));
}

// A dense lower layer must not decide: half of the mean of both, 0.45, is more than the upper layer's 0.3.
TEST(Measures, TheHeightIsThatOfTheTopNotOfTheInterface) {
  const Profile p =
      profile_of([](double z) { return step(z, 0, 0.06, 0.6); }, [](double z) { return step(z, 0.06, 0.16, 0.3); });
  EXPECT_NEAR(*bed_height(p), 0.16, slab / 2);
}

TEST(Measures, TheInterfaceLiesBetweenTwoLayers) {
  const Profile p =
      profile_of([](double z) { return step(z, 0, 0.06, 0.6); }, [](double z) { return step(z, 0.06, 0.16, 0.3); });
  EXPECT_NEAR(*interface_height(p), 0.06, 1e-12);
  EXPECT_NEAR(*mixing(p), 0.0, 1e-12);
  EXPECT_NEAR(*centre(p, 0), 0.03, 1e-12);
  EXPECT_NEAR(*centre(p, 1), 0.11, 1e-12);
}

// A trace in the lowest of 100 slabs, 1/25 of the volume in it and 1/25 above: F of the trace is 1 there, that of the
// other 1/26. By hand: h of the slab is 2/27 of 1, |F_i - F_j| rises to 25/26 in it and falls to 0, so that twice the
// integral is 25/26. Half of the slab belongs to the trace and half to the rest: the interface is near its top.
TEST(Measures, ATraceBelowTheRestIsSeparated) {
  Profile p{slab, {std::vector<double>(100, 0.0), std::vector<double>(100, 0.0)}, {}};
  p.fraction[0][0] = 0.25;
  for (std::size_t k = 0; k < 26; ++k) p.fraction[1][k] = 0.25;
  EXPECT_NEAR(*mixing(p), 1.0 / 26, 1e-12);
  EXPECT_NEAR(*interface_height(p), slab, slab / 2);
}

// Three layers of two species, half of the outer one on either side: F of the outer one leads by 1/2 and then lags by
// 1/2, so that twice the integral is 1/2. Their centres are at one height.
TEST(Measures, ASandwichIsNotMixed) {
  const Profile p = profile_of([](double z) { return step(z, 0, 0.04, 0.5) + step(z, 0.12, 0.16, 0.5); },
                               [](double z) { return step(z, 0.04, 0.12, 0.5); });
  EXPECT_NEAR(*mixing(p), 0.5, 1e-12);
}

TEST(Measures, AMixedBedIsMixed) {
  const Profile p =
      profile_of([](double z) { return step(z, 0, 0.1, 0.3); }, [](double z) { return step(z, 0, 0.1, 0.2); });
  EXPECT_NEAR(*mixing(p), 1.0, 1e-12);
  EXPECT_NEAR(*interface_height(p), 0.1, 1e-12);  // one layer: its top is the bed's
}

// A mixed bed of 0.1 m below a trace of both species that reaches 0.18 m: 1e-4 * 0.08 of 0.05, less than a slice.
TEST(Measures, ATraceInTheFreeboardLiftsNoInterfaceOutOfTheBed) {
  const auto phi = [](double z) { return step(z, 0, 0.1, 0.25) + step(z, 0.1, 0.18, 1e-4); };
  const Profile p = profile_of(phi, phi);
  EXPECT_GT(*volume_quantile(p, 1.0), 0.17);
  EXPECT_NEAR(*interface_height(p), 0.1, 1e-6);  // of the step between two centres, which the trace moves by 0.4 um
}

TEST(Measures, OfAnEmptyBedAreEmpty) {
  const Profile p = profile_of([](double) { return 0.0; }, [](double) { return 0.0; });
  EXPECT_FALSE(bed_height(p));
  EXPECT_FALSE(centre(p, 0));
  EXPECT_FALSE(volume_quantile(p, 0.5));
  EXPECT_FALSE(interface_height(p));
  EXPECT_FALSE(mixing(p));
}

TEST(Measures, AFullColumnIsAsHighAsTheColumn) {
  const Profile p = profile_of([](double) { return 0.4; });
  EXPECT_DOUBLE_EQ(*bed_height(p), 0.2);
}

// The same bed as cells and as 20 000 particles of 0.1 mm counted into the slabs: within the slab, and within
// the noise of counting, 0.3 m/sqrt(20 000) < 1 mm in a centre.
TEST(Measures, CellsAndParticlesGiveTheSame) {
  const auto phi = [](double z) { return z < 0.12 ? 0.5 - 2 * z : 0.0; };
  const Profile cells = profile_of(phi);
  Profile particles = profile_of([](double) { return 0.0; });
  std::mt19937 random(5);
  std::uniform_real_distribution<double> height(0, 0.12), chance(0, 0.5);
  int placed = 0;
  while (placed < 20'000) {
    const double z = height(random);
    if (chance(random) > phi(z)) continue;
    particles.fraction[0][std::size_t(z / slab)] += 1;
    ++placed;
  }
  double volume = 0;
  for (double v : cells.fraction[0]) volume += v;
  for (double& v : particles.fraction[0]) v *= volume / placed;
  EXPECT_NEAR(*bed_height(particles), *bed_height(cells), slab);
  EXPECT_NEAR(*centre(particles, 0), *centre(cells, 0), 1e-3);
  EXPECT_NEAR(*volume_quantile(particles, 0.9), *volume_quantile(cells, 0.9), slab);
}

TEST(Measures, ThePressureDropContinuesToBothEnds) {
  Profile p = profile_of([](double) { return 0.1; });
  p.pressure.resize(100);
  for (std::size_t k = 0; k < 100; ++k) p.pressure[k] = 50 - 200 * p.centre(k);
  EXPECT_NEAR(pressure_drop(p), 200 * 0.2, 1e-10);  // exact for a straight line
}

// Pressure falls by 100 Pa over 0.1 m of bed and stays at 5 Pa above it: the lines 105 - 1000 z and 5 cross at 0.1 m.
TEST(Measures, TheHeightByPressureIsWhereTheLinesCross) {
  Profile p = profile_of([](double z) { return step(z, 0, 0.1, 0.5); });
  for (std::size_t k = 0; k < p.slabs(); ++k) p.pressure.push_back(std::max(5.0, 105 - 1000 * p.centre(k)));
  ASSERT_TRUE(bed_height_by_pressure(p));
  EXPECT_NEAR(*bed_height_by_pressure(p), 0.1, 1e-12);  // rounding
  const auto gradients = [](double z) { return std::max({5.0, 15 - 200 * (z - 0.05), 65 - 1000 * z}); };
  for (std::size_t k = 0; k < p.slabs(); ++k) p.pressure[k] = gradients(p.centre(k));
  EXPECT_TRUE(bed_height_by_pressure(p));  // of one species
  Profile layers =
      profile_of([](double z) { return step(z, 0, 0.05, 0.5); }, [](double z) { return step(z, 0.05, 0.1, 0.5); });
  layers.pressure = p.pressure;
  EXPECT_FALSE(bed_height_by_pressure(layers));  // the upper one with a fifth of the gradient
  p.pressure.clear();
  EXPECT_FALSE(bed_height_by_pressure(p));
}

// Slabs of 2, 4, 6 as 1.5 times as thick ones: the first holds 2 and half of 4, 8/3; the second half of 4 and 6, 16/3.
TEST(Profile, OnOtherSlabsKeepsVolumes) {
  const Profile p{1, {{2, 4, 6}}, {3, 3, 3}};
  const Profile other = on_slabs(p, 1.5, 2);
  EXPECT_NEAR(other.fraction[0][0], (2 + 0.5 * 4) / 1.5, 1e-14);
  EXPECT_NEAR(other.fraction[0][1], (0.5 * 4 + 6) / 1.5, 1e-14);
  EXPECT_NEAR(other.pressure[1], 3, 1e-14);
  const Profile finer = on_slabs(p, 0.5, 6);
  EXPECT_NEAR(finer.fraction[0][2], 4, 1e-14);
  EXPECT_NEAR(on_slabs(p, 1, 3).fraction[0][2], 6, 1e-14);
}

// In a column of areas 1, 2 and 3 over slabs of 1 m, phi = 0.6, 0.3 and 0.2: each slab has a volume of 0.6. A half lies
// below the middle of the second, the centre of volume in its middle.
TEST(Measures, WeighHeightsByTheCrossSection) {
  Profile p{1, {{0.6, 0.3, 0.2}}, {}, {1, 2, 3}};
  EXPECT_NEAR(*volume_quantile(p, 0.5), 1.5, 1e-15);
  EXPECT_NEAR(*volume_quantile(p, 1.0 / 3), 1, 1e-14);
  EXPECT_NEAR(*centre(p, 0), 1.5, 1e-15);
  // By hand: slabs of 1.5 m have areas 4/3 and 8/3 and volumes of 0.9.
  const Profile other = on_slabs(p, 1.5, 2);
  EXPECT_NEAR(other.areas[0], 4.0 / 3, 1e-14);
  EXPECT_NEAR(other.fraction[0][0], 0.9 / 2, 1e-14);
  EXPECT_NEAR(other.fraction[0][1], 0.9 / 4, 1e-14);
}

TEST(Measures, DistanceOfTwoProfiles) {
  const Profile low = profile_of([](double z) { return step(z, 0, 0.1, 0.5); });
  const Profile shifted = profile_of([](double z) { return step(z, 0.02, 0.12, 0.5); });
  EXPECT_EQ(*profile_distance(low, low, 0), 0);
  EXPECT_NEAR(*profile_distance(shifted, low, 0), 0.4, 1e-12);  // a fifth is missing below, as much is too much above
  EXPECT_NEAR(*profile_distance(profile_of([](double) { return 0.0; }), low, 0), 1, 1e-12);
  EXPECT_FALSE(profile_distance(low, profile_of([](double) { return 0.0; }), 0));
  Profile others = low;
  others.slab *= 2;
  EXPECT_THROW((void)profile_distance(low, others, 0), std::invalid_argument);
}

TEST(Measures, DistanceOfTwoOrders) {
  const auto below = [](double z) { return step(z, 0, 0.06, 0.5); };
  const auto above = [](double z) { return step(z, 0.06, 0.12, 0.5); };
  const auto half = [](double z) { return step(z, 0, 0.12, 0.25); };
  const Profile layered = profile_of(below, above), inverted = profile_of(above, below), mixed = profile_of(half, half);
  EXPECT_NEAR(*composition_distance(layered, layered), 0, 1e-12);
  EXPECT_NEAR(*composition_distance(layered, inverted), 1, 1e-12);
  EXPECT_NEAR(*composition_distance(mixed, layered), 0.5, 1e-12);
  // The same order at half the density: the height does not count.
  const Profile expanded =
      profile_of([](double z) { return step(z, 0, 0.1, 0.3); }, [](double z) { return step(z, 0.1, 0.2, 0.3); });
  EXPECT_NEAR(*composition_distance(expanded, layered), 0, 1e-12);
  EXPECT_FALSE(composition_distance(profile_of(half), profile_of(half)));
}

}  // namespace
}  // namespace polybed::measures
