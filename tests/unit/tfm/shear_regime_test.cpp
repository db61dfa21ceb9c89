// Dry or wet: the shear rate times the relaxation time of known scenes.
#include "tfm/shear_regime.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace polybed::tfm {
namespace {

/// A scene of the specification's golden table: diameter and density of one species, the liquid, velocity, width.
struct Golden {
  const char* name;
  double diameter, density, fluid_density, viscosity, velocity, voidage, width, expected;
};

core::Scene scene_of(const Golden& g) {
  core::Scene scene;
  scene.column.size = {g.width, 1, 0.1};
  scene.fluid.name = "fluid";
  scene.fluid.density = g.fluid_density;
  scene.fluid.viscosity = g.viscosity;
  scene.species.resize(1);
  scene.species[0].diameter = g.diameter;
  scene.species[0].density = g.density;
  scene.inlet.superficial_velocity = {{0, g.velocity}};
  scene.effects["drag"] = "cello";
  return scene;
}

const Golden systems[] = {
    {"A1", 0.645e-3, 3950, 1070, 0.14, 1.8e-3, 0.76, 38.1e-3, 1.0e-4},
    {"A2", 1.079e-3, 2910, 1070, 0.14, 1.8e-3, 0.76, 38.1e-3, 2.1e-4},
    {"B1", 0.807e-3, 1395, 999.19, 1.14e-3, 30e-3, 0.87, 60e-3, 0.062},
    {"B2", 2.010e-3, 1170, 999.19, 1.14e-3, 30e-3, 0.87, 60e-3, 0.23},
    {"C1", 0.214e-3, 2450, 996.59, 0.85e-3, 12.5e-3, 0.84, 16.8e-3, 0.020},
    {"C2", 0.776e-3, 1500, 996.59, 0.85e-3, 12.5e-3, 0.84, 16.8e-3, 0.14},
    {"G", 0.5e-3, 2500, 1.2, 1.8e-5, 0.6, 0.45, 0.1, 33},
    {"F", 0.06e-3, 1500, 1.2, 1.8e-5, 10e-3, 0.45, 0.1, 0.050},
};

// 5 %: the rounding of the printed table.
TEST(ShearRegime, GoldenTable) {
  for (const Golden& g : systems)
    EXPECT_NEAR(regime_numbers(scene_of(g), 0, g.velocity, g.voidage).shear_times_relaxation, g.expected,
                0.05 * g.expected)
        << g.name;
  const RegimeNumbers b = regime_numbers(scene_of(systems[2]), 0, 30e-3, 0.87);
  EXPECT_NEAR(b.stokes_least, 1.0, 0.05);
}

TEST(ShearRegime, GasIsDryLiquidIsWetAndTheCaseMaySayOtherwise) {
  EXPECT_EQ(shear_regime(scene_of(systems[6])).kind, core::BoxRegime::dry);
  core::Scene liquid = scene_of(systems[2]);
  EXPECT_EQ(shear_regime(liquid).kind, core::BoxRegime::wet);
  EXPECT_NE(shear_regime(liquid).reason.find("gamma tau_p"), std::string::npos);
  EXPECT_NE(shear_regime(liquid).reason.find("St*"), std::string::npos);
  liquid.calibrate.regime = core::BoxRegime::dry;
  EXPECT_EQ(shear_regime(liquid).kind, core::BoxRegime::dry);
  liquid.calibrate.regime = core::BoxRegime::automatic;
  liquid.inlet.superficial_velocity.clear();
  EXPECT_EQ(shear_regime(liquid).kind, core::BoxRegime::automatic) << "nothing moves the bed";
  core::Scene none = scene_of(systems[2]);
  none.fluid.name = "none";
  EXPECT_EQ(shear_regime(none).kind, core::BoxRegime::dry);
  core::Scene lawless = scene_of(systems[2]);
  lawless.effects.clear();
  EXPECT_THROW((void)shear_regime(lawless), core::CaseError);
}

}  // namespace
}  // namespace polybed::tfm
