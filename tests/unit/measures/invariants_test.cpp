#include "measures/invariants.hpp"

#include <gtest/gtest.h>

#include "measures/profile.hpp"

namespace polybed::measures {
namespace {

core::Grid small() {
  core::Grid grid;
  grid.cells = {4, 6, 1};
  grid.spacing = {0.01, 0.01, 0.002};
  return grid;
}

TEST(Profile, IsTheMeanOfTheOwnedCellsOfALayer) {
  const core::Grid grid = small();
  core::Field field = core::make_field(grid, -99.0);  // ghosts must not count
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 4; ++i) field[std::size_t(grid.index(i, j))] = i + 10.0 * j;
  const auto mean = lateral_mean(grid, field);
  ASSERT_EQ(mean.size(), 6U);
  for (std::size_t j = 0; j < 6; ++j) EXPECT_DOUBLE_EQ(mean[j], 1.5 + 10.0 * double(j));
}

/// A bed in which one invariant is broken by a known amount.
class Watch : public testing::Test {
 protected:
  Watch() : solids_(grid_, {2000.0}), fluid_(grid_) {
    for (auto& phi : solids_.fraction) phi.assign(phi.size(), 0.3);
    fluid_.voidage.assign(fluid_.voidage.size(), 0.7);
  }
  Watched now() { return {grid_, solids_, fluid_, above_, 0.1}; }
  InvariantValues see(double rtol = 1e-3) {
    invariants_ = Invariants({0.3 * 2000 * 24 * grid_.cell_volume()}, {"sand"}, rtol);
    return invariants_.see(now(), solids_.density, 0.0, 2.0);
  }
  core::Grid grid_ = small();
  fluid::Interphase solids_;
  fluid::FluidState fluid_;
  Invariants invariants_{{1.0}, {"sand"}, 1e-3};
  double above_ = 0;  ///< how far the packing is exceeded, as the solids stress tells
};

TEST_F(Watch, ABedAtRestBreaksNothing) {
  const InvariantValues now = see();
  EXPECT_LT(now.mass_error, 1e-15);
  EXPECT_EQ(now.fraction_below, 0);
  EXPECT_EQ(now.packing_above, 0);
  EXPECT_LE(invariants_.nearest().share(), 1);
}

TEST_F(Watch, LostMassIsSeen) {
  solids_.fraction[0][std::size_t(grid_.index(1, 1))] -= 1e-6;
  EXPECT_NEAR(see().mass_error, 1e-6 / (0.3 * 24), 1e-12);
  EXPECT_EQ(invariants_.nearest().name, "mass");
  EXPECT_GT(invariants_.nearest().share(), 1);
  EXPECT_EQ(invariants_.nearest().time, 2.0);
}

TEST_F(Watch, AFractionOutOfBoundsIsSeen) {
  solids_.fraction[0][std::size_t(grid_.index(0, 0))] = -0.01;
  solids_.fraction[0][std::size_t(grid_.index(3, 5))] = 0.65;
  fluid_.voidage[std::size_t(grid_.index(3, 5))] = 0.35;
  above_ = 0.05;
  const InvariantValues now = see();
  EXPECT_DOUBLE_EQ(now.fraction_below, 0.01);
  EXPECT_DOUBLE_EQ(now.most_solids, 0.65);
  EXPECT_EQ(now.packing_above, 0.05);
  EXPECT_EQ(invariants_.worst()[2].value, 0.05);
}

TEST_F(Watch, AVolumeFluxThatDivergesIsSeen) {
  fluid_.flux[1][std::size_t(grid_.index(2, 3))] = 0.003;  // |div J| h / U = 0.003 / 0.1
  EXPECT_NEAR(see().divergence, 0.03, 1e-12);
}

// A law is broken beyond ten limits, what only warns never is; of several the one furthest beyond is named.
TEST(WorstInvariant, ALawIsBrokenTenfoldBeyondItsLimit) {
  std::vector<WorstInvariant> worst{{.name = "mass", .limit = 1e-3, .judged = true, .remedy = "stop"},
                                    {.name = "divergence", .limit = 1e-3},
                                    {.name = "count", .limit = 0, .judged = true}};
  worst[0].keep(0.0099, 1.5);
  worst[1].keep(1.0, 1.5);
  EXPECT_EQ(broken_law(worst), nullptr);
  worst[0].keep(0.0101, 2.5, "species sand");
  worst[0].keep(0.005, 3.5);
  ASSERT_EQ(broken_law(worst), &worst[0]);
  EXPECT_EQ(worst[0].text(),
            "t = 2.5 s: a conservation law is broken: mass (species sand) is off by 0.0101, the limit is 0.001; stop");
  worst[2].keep(1, 2.5);  // nothing is allowed: the furthest beyond that there is
  EXPECT_EQ(broken_law(worst), &worst[2]);
}

// Mass that leaks from one of two species: the law names it.
TEST_F(Watch, TheSpeciesThatLosesMassIsNamed) {
  solids_ = fluid::Interphase(grid_, {2000.0, 1000.0});
  for (auto& phi : solids_.fraction) phi.assign(phi.size(), 0.3);
  fluid_.voidage.assign(fluid_.voidage.size(), 0.4);
  const double volume = 0.3 * 24 * grid_.cell_volume();
  Invariants invariants({2000 * volume, 1000 * volume}, {"heavy", "light"}, 1e-3);
  (void)invariants.see(now(), solids_.density, 0.0, 1.0);
  EXPECT_EQ(broken_law(invariants.worst()), nullptr);
  solids_.fraction[1][std::size_t(grid_.index(1, 1))] -= 1e-6;
  (void)invariants.see(now(), solids_.density, 0.0, 2.0);
  ASSERT_NE(broken_law(invariants.worst()), nullptr);
  EXPECT_EQ(broken_law(invariants.worst())->place, "species light");
}

TEST(Ledger, ErrorIsRelativeToAllThereEverWas) {
  EXPECT_EQ(ledger_error(2, 3, 1, 4), 0);
  EXPECT_DOUBLE_EQ(ledger_error(2, 3, 1, 4.5), 0.1);
  EXPECT_EQ(ledger_error(0, 0, 0, 0), 0);
}

}  // namespace
}  // namespace polybed::measures
