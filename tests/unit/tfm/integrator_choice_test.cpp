#include <gtest/gtest.h>

#include "core/error.hpp"
#include "scenes/record.hpp"
#include "tfm/model.hpp"

namespace polybed::tfm {
namespace {

std::string chosen(const core::Scene& scene) {
  core::Timers timers;
  return std::string(core::name_of(Model(scene, timers).integrator_kind()));
}

/// 4 x 20 cells of 2 mm of glass in water at 10 mm/s.
core::Scene glass(double diameter) {
  core::Scene scene = scenes::uniform_bed(diameter, 2500, 998.207, 1.00157e-3, 0.5, 20, 0.04);
  scene.inlet.superficial_velocity = {{0.0, 0.01}};
  scene.tfm.integrator = core::TfmIntegrator::automatic;
  scene.tfm.rtol = 1e-3;
  return scene;
}

// However fine the particles: the drag is what binds explicit steps, and it is taken implicitly.
TEST(IntegratorChoice, LiquidBedsTakeTheDragAloneImplicitly) {
  core::Scene coarse = glass(0.8e-3);
  coarse.inlet.superficial_velocity = {{0.0, 0.03}};
  EXPECT_EQ(chosen(coarse), "imex");
  EXPECT_EQ(chosen(glass(0.3e-3)), "imex");
}

// Elastic waves of a bed that stays packed cross a cell of 2 mm in 0.1 ms; an implicit step is 7 ms.
TEST(IntegratorChoice, ABedThatStaysPackedIsForImplicitSteps) {
  core::Scene scene = glass(0.8e-3);
  scene.effects["solids_stress"] = "frictional";
  scene.bed.solids_fraction = scene.bed.start_solids_fraction = 0.6;
  scene.inlet.superficial_velocity = {{0.0, 1e-3}};
  EXPECT_EQ(chosen(scene), "implicit");
}

TEST(IntegratorChoice, WithoutADragAllIsExplicit) {
  core::Scene scene = glass(0.8e-3);
  scene.effects["drag"] = "none";
  EXPECT_EQ(chosen(scene), "explicit");
  scene.tfm.integrator = core::TfmIntegrator::split_steps;
  EXPECT_THROW(chosen(scene), core::CaseError);
}

TEST(IntegratorChoice, GasAndSettlingBedsAreForImplicitSteps) {
  core::Scene gas = glass(0.8e-3);
  gas.fluid.density = 1.2;
  gas.fluid.viscosity = 1.8e-5;
  EXPECT_EQ(chosen(gas), "implicit");
  core::Scene settling = glass(0.8e-3);
  settling.column.closed = true;
  settling.inlet.superficial_velocity = {{0.0, 0.0}};
  EXPECT_EQ(chosen(settling), "implicit");
}

TEST(IntegratorChoice, CompressibleFluidsAreForImplicitSteps) {
  core::Scene scene = glass(0.8e-3);
  scene.fluid.equation_of_state = core::Compressibility::tait;
  EXPECT_EQ(chosen(scene), "implicit");
  scene.tfm.integrator = core::TfmIntegrator::explicit_steps;
  EXPECT_EQ(chosen(scene), "explicit");
}

TEST(IntegratorChoice, TheCaseHasTheLastWord) {
  core::Scene scene = glass(0.2e-3);
  scene.tfm.integrator = core::TfmIntegrator::explicit_steps;
  EXPECT_EQ(chosen(scene), "explicit");
}

TEST(IntegratorChoice, ACoarseToleranceIsRefusedToImplicitSteps) {
  core::Scene scene = glass(0.2e-3);
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  scene.tfm.rtol = 1e-2;
  EXPECT_THROW(chosen(scene), core::CaseError);
}

// What a model runs with is what it says: at the face of a solids front the orders differ.
TEST(Momentum, OfTheModelIsThatOfTheScene) {
  core::Timers timers;
  core::Scene scene = glass(0.8e-3);
  scene.effects["solids_stress"] = "frictional";  // it falls together in 0.015 s
  scene.tfm.max_packing = 0.62;
  scene.fluid.density = 1.2;
  scene.fluid.viscosity = 1.8e-5;
  const auto velocities = [&](core::Momentum form) {
    scene.scheme.momentum = form;
    Model model(scene, timers);
    scenes::advance(model, 0.02);
    return model.fields().solids.velocity[0][1];
  };
  EXPECT_EQ(velocities(core::Momentum::automatic), velocities(core::Momentum::conservative));
  EXPECT_NE(velocities(core::Momentum::automatic), velocities(core::Momentum::conservative_limited));
}

}  // namespace
}  // namespace polybed::tfm
