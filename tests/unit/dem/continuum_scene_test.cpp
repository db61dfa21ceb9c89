// The particle model refuses what only the continuum model can run, naming the key.
#include "dem/rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"

namespace polybed::dem {
namespace {

TEST(ContinuumScene, IsToldWithAllItsKeysAtOnce) {
  core::Scene scene;
  EXPECT_NO_THROW(core::refuse(model_rules(), scene));
  scene.column.outlet = core::Outlet::open;
  scene.feeds.emplace_back();
  scene.fluid.name = "air";
  scene.fluid.equation_of_state = core::Compressibility::ideal_gas;
  try {
    core::refuse(model_rules(), scene);
    FAIL() << "not refused";
  } catch (const core::CaseError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr(
                    "column.outlet = \"open\" in a compressible fluid: polybed tfm can run it, polybed dem cannot"));
    EXPECT_THAT(error.what(),
                testing::HasSubstr("[[feed]] in a compressible fluid: polybed tfm can run it, polybed dem cannot"));
  }
}

}  // namespace
}  // namespace polybed::dem
