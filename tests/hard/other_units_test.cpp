// Scenes told in other units.
#include "hard/other_units.hpp"

#include <gtest/gtest.h>

#include "hard/scenes.hpp"

namespace polybed::hard {
namespace {

// By hand: water is 0.998207e-3 g/mm3, its viscosity 1.00157e-6 g/(mm ms), gravity 9.81e-3 mm/ms2, 1 Pa 1e-6 g/(mm
// ms2).
TEST(OtherUnits, HaveTheNumbersThatAHandFinds) {
  core::Scene scene = two_species(20, 0.06, false);
  scene.inlet.superficial_velocity = {{0.0, 0.02}, {0.1, 0.03}};
  const core::Scene other = in_units(scene, {"mm, g, ms", 1e3, 1e3, 1e3});
  EXPECT_DOUBLE_EQ(other.column.size[1], 60);
  EXPECT_DOUBLE_EQ(other.column.gravity, 9.81e-3);
  EXPECT_DOUBLE_EQ(*other.fluid.density, 0.998207e-3);
  EXPECT_DOUBLE_EQ(*other.fluid.viscosity, 1.00157e-6);
  EXPECT_DOUBLE_EQ(other.species[1].diameter, 2.01);
  EXPECT_DOUBLE_EQ(other.species[1].density, 1170e-6);
  EXPECT_DOUBLE_EQ(other.bed.static_height, 1e3 * scene.bed.static_height);
  EXPECT_DOUBLE_EQ(other.inlet.superficial_velocity[1].first, 100);
  EXPECT_DOUBLE_EQ(other.inlet.superficial_velocity[1].second, 0.03);
  EXPECT_DOUBLE_EQ(other.tfm.frictional_pressure, 0.05e-6);  // a default of the program
  EXPECT_DOUBLE_EQ(other.tfm.rtol, scene.tfm.rtol);
  EXPECT_EQ(other.column.cells, scene.column.cells);
}

// In centimetres, grams and seconds: 1 Pa is 10 dyn/cm2, 1 Pa s 10 P, 1 m2/s2 1e4 cm2/s2.
TEST(OtherUnits, OfCentimetresGramsAndSeconds) {
  const UnitSystem cgs{"cm, g, s", 1e2, 1e3, 1};
  EXPECT_DOUBLE_EQ(number_of_one(core::dimension::pressure, cgs), 10);
  EXPECT_DOUBLE_EQ(number_of_one(core::dimension::viscosity, cgs), 10);
  EXPECT_DOUBLE_EQ(number_of_one(core::dimension::speed_squared, cgs), 1e4);
  EXPECT_DOUBLE_EQ(number_of_one(core::dimension::none, cgs), 1);
}

}  // namespace
}  // namespace polybed::hard
