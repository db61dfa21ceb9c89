#include "tfm/well_posedness.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polybed::tfm {
namespace {

/// Three cells above each other of 1 x 2 mm, fluid of 1000 kg/m3, a stress of no slope.
Constants column(std::vector<double> density) {
  Constants constants;
  constants.grid.cells = {1, 3, 1};
  constants.grid.spacing = {1e-3, 2e-3, 1e-3};
  constants.fluid = {1000, 1e-3};
  constants.diameter.assign(density.size(), 1e-3);
  constants.name.assign(density.size(), "solid");
  constants.density = std::move(density);
  return constants;
}

Fields with_stress(const Constants& constants) {
  Fields fields(constants);
  fields.stress.pressure = fields.stress.slope = core::make_field(constants.grid);
  return fields;
}

void set_upward(const Constants& constants, core::FaceField& velocity, double u) {
  for (int j = 0; j <= constants.grid.cells[1]; ++j) velocity[1][std::size_t(constants.grid.index(0, j))] = u;
}

std::size_t cell(const Constants& constants, int j) { return std::size_t(constants.grid.index(0, j)); }

// phi 0.5 of 2000 kg/m3 at a slip of 0.1 m/s: G_crit = 0.5*2000*1000*0.01/(0.5*2000 + 0.5*1000) = 6.6667 Pa by hand.
TEST(WellPosedness, OfOneSolidByHand) {
  const Constants constants = column({2000});
  Fields fields = with_stress(constants);
  set_upward(constants, fields.fluid.velocity, 0.1);
  fields.solids.fraction[0][cell(constants, 0)] = 0.5;
  fields.solids.fraction[0][cell(constants, 1)] = 0.5;
  fields.solids.fraction[0][cell(constants, 2)] = 0.005;  // less than counts as bed
  fields.stress.slope[cell(constants, 0)] = 10;
  fields.stress.slope[cell(constants, 1)] = 2;
  const WellPosedness found = well_posedness(constants, fields);
  EXPECT_NEAR(found.critical_slope, 20.0 / 3, 1e-14);
  EXPECT_NEAR(found.least, 0.3, 1e-15);
  EXPECT_EQ(found.place[1], 3e-3);
  EXPECT_EQ(found.share_below, 0.5);
}

// 0.2 of 1000 kg/m3 at 0.02 m/s and 0.3 of 2000 kg/m3 at -0.01 m/s: together 0.5 of 1600 kg/m3, whose centre of mass
// moves at (0.2*1000*0.02 - 0.3*2000*0.01)/800 = -0.0025 m/s. With the fluid at 0.0975 m/s the slip is 0.1 m/s and
// G_crit = 0.5*1600*1000*0.01/(0.5*1600 + 0.5*1000) = 6.1538 Pa.
TEST(WellPosedness, OfTwoSolidsByTheirCentreOfMass) {
  const Constants constants = column({1000, 2000});
  Fields fields = with_stress(constants);
  set_upward(constants, fields.fluid.velocity, 0.0975);
  set_upward(constants, fields.solids.velocity[0], 0.02);
  set_upward(constants, fields.solids.velocity[1], -0.01);
  fields.solids.fraction[0][cell(constants, 1)] = 0.2;
  fields.solids.fraction[1][cell(constants, 1)] = 0.3;
  const WellPosedness found = well_posedness(constants, fields);
  EXPECT_NEAR(found.critical_slope, 8000.0 / 1300, 1e-13);
  EXPECT_EQ(found.least, 0);
}

// Where no stress acts, all cells are equally ill-posed: the one with the fastest slip is told.
TEST(WellPosedness, WithoutStressTheFastestSlipIsTold) {
  const Constants constants = column({2000});
  Fields fields(constants);
  for (int j = 0; j < 3; ++j) fields.solids.fraction[0][cell(constants, j)] = 0.5;
  for (int j = 0; j <= 3; ++j) fields.fluid.velocity[1][cell(constants, j)] = 0.1 * j;
  const WellPosedness found = well_posedness(constants, fields);
  EXPECT_EQ(found.least, 0);
  EXPECT_EQ(found.place[1], 5e-3);
  EXPECT_EQ(found.share_below, 1);
}

TEST(WellPosedness, NothingSlipsInABedAtRest) {
  const Constants constants = column({2000});
  Fields fields = with_stress(constants);
  fields.solids.fraction[0][cell(constants, 0)] = 0.5;
  const WellPosedness found = well_posedness(constants, fields);
  EXPECT_TRUE(std::isinf(found.least));
  EXPECT_EQ(found.share_below, 0);
}

}  // namespace
}  // namespace polybed::tfm
