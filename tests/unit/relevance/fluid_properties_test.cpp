#include "relevance/fluid_properties.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace polybed::relevance {
namespace {

TEST(Properties, AFluidWithoutPropertiesIsRefusedByName) {
  core::Fluid honey;
  honey.name = "honey";
  EXPECT_THROW((void)fluid_constants(honey), core::CaseError);
  honey.density = 1400;
  honey.viscosity = 10;
  EXPECT_EQ(fluid_constants(honey).density, 1400);
}

TEST(Properties, WhatIsGivenOverridesWhatIsKnown) {
  core::Fluid water;
  water.name = "water";
  water.temperature = 288.15;
  const double density = fluid_constants(water).density;
  EXPECT_NEAR(density, 999.1, 0.05);  // CRC: 999.10 kg/m3 at 15 degC
  water.viscosity = 2e-3;
  EXPECT_EQ(fluid_constants(water).viscosity, 2e-3);
  EXPECT_EQ(fluid_constants(water).density, density);
}

TEST(Properties, BeyondTheTablesTheMessageSaysWhatToGive) {
  core::Fluid water;
  water.name = "water";
  water.temperature = 333.15;
  try {
    (void)fluid_constants(water);
    FAIL() << "taken";
  } catch (const core::CaseError& error) {
    const std::string told = error.what();
    EXPECT_NE(told.find("outside 0 to 40 degC; beyond it give fluid.density and fluid.viscosity"), std::string::npos)
        << told;
  }
}

}  // namespace
}  // namespace polybed::relevance
