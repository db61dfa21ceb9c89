#include "core/case/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace polybed::core {
namespace {

struct Reading {
  const char* text;
  double value;
  Dimension dimension;
  friend void PrintTo(const Reading& reading, std::ostream* out) { *out << reading.text; }
};

class UnitReads : public testing::TestWithParam<Reading> {};

// Exact: a prefix shifts the decimal exponent, so that the number is rounded once.
TEST_P(UnitReads, GivesSi) {
  const auto q = parse_quantity(GetParam().text);
  ASSERT_TRUE(q) << GetParam().text;
  EXPECT_EQ(q->value, GetParam().value) << GetParam().text;
  EXPECT_EQ(q->dimension, GetParam().dimension) << GetParam().text;
}

INSTANTIATE_TEST_SUITE_P(
    Units, UnitReads,
    testing::Values(Reading{"0.807 mm", 0.000807, dimension::length}, Reading{"1395 kg/m3", 1395, dimension::density},
                    Reading{"1.17 g/cm3", 1170, dimension::density}, Reading{"15 degC", 288.15, dimension::temperature},
                    Reading{"1.14e-3 Pa s", 1.14e-3, dimension::viscosity},
                    Reading{"1.14 mPa s", 1.14e-3, dimension::viscosity},
                    Reading{"37 mm/s", 0.037, dimension::velocity}, Reading{"9.81 m/s2", 9.81, dimension::acceleration},
                    Reading{"9.81 m s-2", 9.81, dimension::acceleration}, Reading{"2 min", 120, dimension::time},
                    Reading{"1.5 bar", 150000, dimension::pressure}, Reading{"0.05 Pa", 0.05, dimension::pressure},
                    Reading{"62 %", 0.62, dimension::none}, Reading{"1e3", 1000, dimension::none},
                    Reading{"-3 mm", -0.003, dimension::length}, Reading{"500 micron", 5e-4, dimension::length},
                    Reading{"2 ft", 0.6096, dimension::length}, Reading{"10 in", 0.254, dimension::length},
                    Reading{"2 lb", 0.90718474, {0, 1, 0, 0}}, Reading{"90 ml/s", 9e-5, dimension::volume_rate},
                    Reading{"60 gal/min", 3.785411784e-3, dimension::volume_rate},
                    Reading{"12 cP", 12e-3, dimension::viscosity}, Reading{"1050 mbar", 1050e2, dimension::pressure},
                    Reading{"75 L/h", 75e-3 / 3600, dimension::volume_rate},
                    Reading{"3.5 m3/d", 3.5 / 86400, dimension::volume_rate},
                    Reading{"5 gpm/ft2", 5 * (3.785411784e-3 / 60) / (0.3048 * 0.3048), dimension::velocity}));

TEST(Units, WhatIsNoQuantityIsRefused) {
  for (const char* text : {"", "mm", "3 parsec", "3 mm mmm", "abc", "1 m/", "1,5 mm", "3 m^", "--3 m", "3 m99"})
    EXPECT_FALSE(parse_quantity(text)) << text;
}

TEST(Units, TellWhetherAUnitWasGiven) {
  EXPECT_FALSE(parse_quantity("12")->has_unit);
  EXPECT_TRUE(parse_quantity("12 m")->has_unit);
}

TEST(Units, DegreesAreShiftedAloneOnly) {
  EXPECT_DOUBLE_EQ(parse_quantity("0 degC")->value, 273.15);
  EXPECT_FALSE(parse_quantity("1 W/degC"));
}

TEST(Units, NamesReadBack) {
  for (const Dimension d :
       {dimension::length, dimension::density, dimension::viscosity, dimension::velocity, dimension::pressure,
        dimension::acceleration, dimension::per_pressure, dimension::stiffness, dimension::energy, dimension::rate}) {
    const auto q = parse_quantity("1 " + unit_name(d));
    ASSERT_TRUE(q) << unit_name(d);
    EXPECT_EQ(q->dimension, d) << unit_name(d);
    EXPECT_EQ(q->value, 1.0) << unit_name(d);
  }
  EXPECT_EQ(unit_name(dimension::none), "1");
  EXPECT_EQ(unit_name(dimension::stiffness), "N/m");
  EXPECT_EQ(unit_name(dimension::energy), "J");
}

}  // namespace
}  // namespace polybed::core
