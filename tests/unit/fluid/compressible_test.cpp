#include "fluid/compressible.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/numerics/operators.hpp"
#include "fluid/fluid_mass.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::fluid {
namespace {

constexpr double atmosphere = 101325;

core::Fluid air_at(double pressure) {
  core::Fluid fluid;
  fluid.name = "air";
  fluid.temperature = 293.15;
  fluid.equation_of_state = core::Compressibility::ideal_gas;
  fluid.outlet_pressure = pressure;
  return fluid;
}

core::Fluid water_at(double pressure) {
  core::Fluid fluid;
  fluid.name = "water";
  fluid.density = 998.207;
  fluid.viscosity = 1e-3;
  fluid.equation_of_state = core::Compressibility::tait;
  fluid.outlet_pressure = pressure;
  return fluid;
}

TEST(EquationOfState, HasTheSoundOfWater) {  // two digits more than the closure's own test
  EXPECT_NEAR(speed_of_sound(equation_of_state(water_at(atmosphere), 998.207), atmosphere), 1450.683, 1e-3);
}

// Air of 20 degC at 10 bar: 1e6/(287.05 * 293.15) = 11.883725 kg/m3; sound does not depend on the pressure.
TEST(EquationOfState, GoesThroughTheOutletsPressure) {
  const core::Fluid fluid = air_at(1e6);
  const double density = relevance::fluid_constants(fluid).density;
  EXPECT_NEAR(density, 11.883725, 1e-5);
  EXPECT_NEAR(speed_of_sound(equation_of_state(fluid, density), 1e6), 290.084, 1e-3);
  EXPECT_NEAR(speed_of_sound(equation_of_state(fluid, density), 2e6), 290.084, 1e-3);
}

// Water from its temperature is dense as the tables say at 1 atm, and 1.0046937 times that 10 MPa above (by hand, as in
// the closure's test); a density given is that at the outlet.
TEST(EquationOfState, OfWaterStartsFromItsTables) {
  core::Fluid fluid = water_at(atmosphere + 1e7);
  EXPECT_DOUBLE_EQ(relevance::fluid_constants(fluid).density, 998.207);
  fluid.density.reset();
  fluid.temperature = 293.15;
  const double deep = relevance::fluid_constants(fluid).density;
  fluid.outlet_pressure = atmosphere;
  EXPECT_NEAR(deep / relevance::fluid_constants(fluid).density, 1.0046937, 1e-7);
}

/// A column of air of 4 x 6 cells of 10 mm, without weight, its fluid alone.
class Column : public testing::Test {
 protected:
  Column() : solids_(grid_, {2000.0}), fluid_(grid_) { std::fill(fluid_.voidage.begin(), fluid_.voidage.end(), 1.0); }
  Compressible make(bool closed, double gravity = 0) {
    boundaries_ = Boundaries(grid_, closed ? Ends::walls : Ends::outlet);
    const double density = relevance::fluid_constants(air_at(atmosphere)).density;
    Compressible air(grid_, boundaries_, equation_of_state(air_at(atmosphere), density), atmosphere, density, gravity);
    air.make_fields(fluid_);
    return air;
  }
  static core::Grid small() {
    core::Grid grid;
    grid.cells = {4, 6, 1};
    grid.spacing = {0.01, 0.01, 0.002};
    return grid;
  }
  core::Grid grid_ = small();
  Boundaries boundaries_;
  Interphase solids_;
  FluidState fluid_;
};

// A piston: what enters a cell at 0.1 m/s and does not leave raises P at P u/h = 101325 * 0.1/0.01 = 1.01325e6 Pa/s,
// with half of it as voidage at twice that.
TEST_F(Column, APistonRaisesThePressure) {
  const Compressible air = make(false);
  const auto cell = std::size_t(grid_.index(1, 0));
  for (const double eps : {1.0, 0.5}) {
    std::fill(fluid_.voidage.begin(), fluid_.voidage.end(), eps);
    ASSERT_TRUE(air.set_density(fluid_));
    fluid_.compression.flux[1][cell] = 0.1;
    air.set_pressure_rate(solids_, fluid_);
    EXPECT_NEAR(fluid_.compression.pressure_rate[cell], 1.01325e6 / eps, 1e-3);
  }
}

TEST_F(Column, APressureWithoutADensityIsRefused) {
  const Compressible air = make(true);
  fluid_.pressure[std::size_t(grid_.index(2, 3))] = -1.1e5;
  EXPECT_FALSE(air.set_density(fluid_));
  fluid_.pressure[std::size_t(grid_.index(2, 3))] = std::nan("");
  EXPECT_FALSE(air.set_density(fluid_));
  fluid_.pressure[std::size_t(grid_.index(2, 3))] = -1.0e5;
  EXPECT_TRUE(air.set_density(fluid_));
}

// Air twice as dense as at the outlet carries half its weight in the net pressure: -(1 - 1/2) 9.81.
TEST_F(Column, WhatIsDenserThanAtTheOutletSinks) {
  const Compressible air = make(true, 9.81);
  for (int j = -2; j < 8; ++j)
    for (int i = -2; i < 6; ++i)
      fluid_.pressure[std::size_t(grid_.index(i, j))] = 2 * atmosphere - air.total_pressure(0, j);
  ASSERT_TRUE(air.set_density(fluid_));
  core::FaceField acceleration = core::make_face_field(grid_);
  air.add_gravity(fluid_, acceleration);
  EXPECT_NEAR(acceleration[1][std::size_t(grid_.index(1, 3))], -0.5 * 9.81, 1e-12);
  EXPECT_EQ(acceleration[1][std::size_t(grid_.index(1, 0))], 0);  // a wall
}

// Any fields at all: the rate of the mass in the column, sum of d(eps rho)/dt = kappa rho dp/dt - rho sum dphi_j/dt, is
// what flows in less what flows out, to the round-off of a sum of 24 terms, with solids through both ends.
TEST_F(Column, MassChangesByWhatFlowsInAndOut) {
  const Compressible air = make(false, 9.81);
  unsigned seed = 1;
  const auto dice = [&] { return double((seed = seed * 1664525U + 1013904223U) >> 8) / (1 << 24); };
  for (double& p : fluid_.pressure) p = 3e4 * (dice() - 0.5);
  for (double& eps : fluid_.voidage) eps = 0.3 + 0.5 * dice();
  core::FaceField solids_flux = core::make_face_field(grid_);
  for (int axis = 0; axis < 2; ++axis) {
    const auto a = std::size_t(axis);
    core::for_each_row(grid_, boundaries_.moving_faces(axis, true), [&](core::Index begin, core::Index end) {
      for (core::Index f = begin; f < end; ++f) fluid_.flux[a][std::size_t(f)] = dice() - 0.5;
    });
    core::for_each_row(grid_, boundaries_.moving_faces(axis, true), [&](core::Index begin, core::Index end) {
      for (core::Index f = begin; f < end; ++f) solids_flux[a][std::size_t(f)] = dice() - 0.5;
    });
  }
  for (int i = 0; i < 4; ++i) {
    fluid_.flux[1][std::size_t(grid_.index(i, 0))] = dice();
    solids_flux[1][std::size_t(grid_.index(i, 0))] = dice();
  }
  core::divergence(grid_, solids_flux, solids_.fraction_rate[0]);
  for (double& rate : solids_.fraction_rate[0]) rate = -rate;
  ASSERT_TRUE(air.set_density(fluid_));
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t f = 0; f < solids_flux[a].size(); ++f)
      fluid_.compression.flux[a][f] = fluid_.flux[a][f] - solids_flux[a][f];
  air.set_pressure_rate(solids_, fluid_);
  double change = 0, size = 0;
  const Compression& own = fluid_.compression;
  core::for_each_row(grid_, [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      const double rate = own.density[c] * (own.kappa[c] * own.pressure_rate[c] - solids_.fraction_rate[0][c]);
      change += rate * grid_.cell_volume();
      size += std::abs(rate) * grid_.cell_volume();
    }
  });
  const MassFlow flow = mass_flow(grid_, boundaries_, fluid_, fluid_.compression.flux);
  EXPECT_GT(std::abs(flow.in), 0);
  EXPECT_NEAR(change, flow.in - flow.out, 1e-14 * size);
}

// 2 to 4 kg/s within half a second: 1.5 kg, by the middle of it 0.25 * (2 + 3)/2 = 0.625 kg.
TEST(FluidLedger, TakesTheFlowAsLinearWithinAStep) {
  FluidLedger ledger;
  ledger.begin(1.0, {10, 0, 0}, {2, 0});
  ledger.advance(1.5, {4, 1});
  EXPECT_DOUBLE_EQ(ledger.at(1.5).in, 1.5);
  EXPECT_DOUBLE_EQ(ledger.at(1.25).in, 0.625);
  EXPECT_DOUBLE_EQ(ledger.at(1.5).out, 0.25);
  EXPECT_DOUBLE_EQ(ledger.at(1.5).error(11.25), 0);
  EXPECT_NEAR(ledger.at(1.5).error(11.35), 0.01, 1e-15);
}

}  // namespace
}  // namespace polybed::fluid
