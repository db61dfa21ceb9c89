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

// An implicit step is expected to replace 0.9 explicit ones at 0.8 mm and 3.6 at 0.3 mm, each at a velocity that
// expands its bed to a fraction of 0.3; the rule changes over at 1.5.
TEST(IntegratorChoice, FineParticlesAreForImplicitSteps) {
  core::Scene coarse = glass(0.8e-3);
  coarse.inlet.superficial_velocity = {{0.0, 0.03}};
  EXPECT_EQ(chosen(coarse), "explicit");
  EXPECT_EQ(chosen(glass(0.3e-3)), "implicit");
}

// The same particles on cells of a twelfth: an implicit step is bound to the time in which the fluid crosses one.
TEST(IntegratorChoice, FinerCellsAreForExplicitSteps) {
  core::Scene scene = glass(0.3e-3);
  scene.column.cells[1] *= 12;
  EXPECT_EQ(chosen(scene), "explicit");
}

// Implicit steps follow the tolerance, explicit ones the limit of stability.
TEST(IntegratorChoice, ATightToleranceIsForExplicitSteps) {
  core::Scene scene = glass(0.3e-3);
  scene.tfm.rtol = 1e-6;
  EXPECT_EQ(chosen(scene), "explicit");
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
  scene.tfm.rtol = 1e-2;
  EXPECT_THROW(chosen(scene), core::CaseError);
}

TEST(MomentumForm, KeepsMomentumUnlessTheCaseSaysOtherwise) {
  core::Scene scene = glass(0.8e-3);
  EXPECT_EQ(momentum_form(scene).form, core::Momentum::conservative);
  for (const core::Momentum asked :
       {core::Momentum::upwind, core::Momentum::limited, core::Momentum::conservative_limited}) {
    scene.scheme.momentum = asked;
    EXPECT_EQ(momentum_form(scene).form, asked);
  }
}

// What a model runs with is what it says: at the face of a solids front the forms differ.
TEST(MomentumForm, OfTheModelIsThatOfTheScene) {
  core::Timers timers;
  core::Scene scene = glass(0.8e-3);
  scene.fluid.density = 1.2;
  scene.fluid.viscosity = 1.8e-5;
  const auto velocities = [&](core::Momentum form) {
    scene.scheme.momentum = form;
    Model model(scene, timers);
    scenes::advance(model, 0.02);
    return model.fields().solids.velocity[0][1];
  };
  EXPECT_EQ(velocities(core::Momentum::automatic), velocities(core::Momentum::conservative));
  EXPECT_NE(velocities(core::Momentum::automatic), velocities(core::Momentum::upwind));
}

}  // namespace
}  // namespace polybed::tfm
