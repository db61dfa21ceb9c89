// Plans and blocks of the calibration, and how its tables run: no box is run.
#include <gtest/gtest.h>

#include <cmath>

#include "closures/kinetic_theory.hpp"
#include "core/error.hpp"
#include "multiscale/calibrate/box_result.hpp"
#include "multiscale/calibrate/reference.hpp"
#include "multiscale/calibrate/table_shape.hpp"

namespace polybed::multiscale {
namespace {

core::Scene dry_scene() {
  core::Scene scene;
  scene.fluid.name = "none";
  scene.species.resize(1);
  scene.species[0].diameter = 1e-3;
  scene.species[0].density = 2500;
  scene.bed.volume_share = {1};
  core::set_friction(scene, 0);
  scene.calibrate.solids_fraction = {0.1, 0.2, 0.3, 0.4, 0.45};
  scene.calibrate.restitution = {0.8, 0.9};
  return scene;
}

TEST(CalibratePlan, WrongAxesAreRefused) {
  core::Scene scene = dry_scene();
  scene.calibrate.solids_fraction = {0.3, 0.2};
  EXPECT_THROW((void)plan_of(scene), core::CaseError);
  scene.calibrate.solids_fraction = {0.3, 0.63};  // smooth spheres jam at 0.636
  EXPECT_THROW((void)plan_of(scene), core::CaseError);
  scene = dry_scene();
  scene.calibrate.regime = core::BoxRegime::wet;
  EXPECT_THROW((void)plan_of(scene), core::CaseError);
  scene = dry_scene();
  scene.calibrate.share = {0.3, 0.5};
  EXPECT_THROW((void)plan_of(scene), core::CaseError) << "one species has no share";
  scene.species.push_back(scene.species[0]);
  scene.bed.volume_share = {0.5, 0.5};
  EXPECT_TRUE(plan_of(scene).binary);
  scene.calibrate.share = {0, 0.5};
  EXPECT_THROW((void)plan_of(scene), core::CaseError) << "one species alone exchanges nothing";
  scene = dry_scene();
  core::set_friction(scene, 0.3);
  scene.calibrate.restitution = {0.15};
  EXPECT_THROW((void)plan_of(scene), core::CaseError) << "0.15 - 0.183 is no restitution";
}

TEST(CalibratePlan, AxesAsTheCaseSays) {
  const Plan plan = plan_of(dry_scene());
  EXPECT_EQ(plan.regime.kind, core::BoxRegime::dry);
  EXPECT_EQ(plan.axes.phi, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.45}));
  EXPECT_EQ(plan.axes.restitution, (std::vector<double>{0.8, 0.9}));
  EXPECT_EQ(plan.axes.stokes, std::vector<double>{0});
  EXPECT_FALSE(plan.binary);
}

TEST(CalibratePlan, AnythingThatABoxDependsOnChangesItsName) {
  const core::Scene scene = dry_scene();
  const BoxPoint point{core::BoxRegime::dry, 0.1, 0, 0.8, 0, 0};
  core::Scene longer = scene;
  longer.calibrate.strain *= 2;
  BoxPoint other = point;
  other.seed = 7;
  EXPECT_EQ(box_hash(scene, point), box_hash(scene, point));
  EXPECT_NE(box_hash(scene, point), box_hash(longer, point));
  EXPECT_NE(box_hash(scene, point), box_hash(scene, other));
  other = point;
  other.pushed = true;
  EXPECT_NE(box_hash(scene, point), box_hash(scene, other));
  longer = scene;
  longer.run.until = 99;  // of the case, no matter of a box
  EXPECT_EQ(box_hash(scene, point), box_hash(longer, point));
}

// 20 blocks 1, -1, 1, ...: mean 0; of single blocks sqrt(20/(20 19)), of pairs 0. Slow: 10 of 1, 10 of -1.
TEST(CalibrateBlocks, TheErrorIsThatOfTheSlowestBlocks) {
  std::vector<double> fast, slow;
  for (int n = 0; n < 20; ++n) {
    fast.push_back(n % 2 == 0 ? 1 : -1);
    slow.push_back(n < 10 ? 1 : -1);
  }
  EXPECT_NEAR(estimate_of(fast).error, std::sqrt(20.0 / (20 * 19)), 1e-15);
  EXPECT_FALSE(error_grows(fast));
  // 5 blocks of 4: 1, 1, 0, -1, -1: squares 4, sqrt(4/20); 10 of 2: sqrt(10/90); the former is more.
  EXPECT_NEAR(estimate_of(slow).error, std::sqrt(4.0 / 20), 1e-15);
  EXPECT_TRUE(error_grows(slow));
}

// Of one size it is Garzo and Dufty; a size cut in two by name is the same. phi 0.3, e 0.9, theta 0.01 m2/s2, 1 mm,
// 2500 kg/m3: p = 2500 0.01 0.3 [1 + 3.8 0.3 2.4781341] = 28.688 Pa.
TEST(CalibrateReference, PressureByHandAndCutInTwo) {
  const ReferenceStress one = kinetic_reference({{1e-3, 2500, 0.3, 0.01}}, 0.9);
  EXPECT_NEAR(one.pressure, 28.688, 1e-3);
  const ReferenceStress two = kinetic_reference({{1e-3, 2500, 0.1, 0.01}, {1e-3, 2500, 0.2, 0.01}}, 0.9);
  EXPECT_NEAR(two.pressure, one.pressure, 1e-12 * one.pressure);
  EXPECT_NEAR(two.viscosity, one.viscosity, 1e-12 * one.viscosity);
  EXPECT_NEAR(two.dissipation, one.dissipation, 1e-12 * one.dissipation);
}

/// A table of smooth spheres whose pressure is that of chi_eff = chi_CS (1 + a S), S = 0.5 everywhere.
tfm::SolidsTable dry_table(double a, double friction = 0) {
  tfm::SolidsTable t;
  t.regime = core::BoxRegime::dry;
  t.reference = tfm::effective_reference;
  t.phi = {0.1, 0.2, 0.3, 0.4, 0.45};
  t.stokes = t.share = {0};
  t.friction = {friction};
  t.restitution = {0.8, 0.9};
  for (const double phi : t.phi)
    for (const double e : t.restitution) {
      const double chi = closures::radial_carnahan_starling(phi).value, at = t.reference_restitution(e, friction);
      t.pressure.value.push_back(closures::kinetic_pressure(phi, chi * (1 + a * 0.5), at) /
                                 closures::kinetic_pressure(phi, chi, at));
      t.shear_number.push_back(0.5);
    }
  t.viscosity.value = t.dissipation.value = std::vector<double>(t.size(), 1.0);
  return t;
}

TEST(TableShape, StructureIsRecovered) {
  const tfm::SolidsTable t = dry_table(0.18);
  ASSERT_EQ(structure_coefficients(t).size(), t.size());
  for (const double a : structure_coefficients(t)) EXPECT_NEAR(a, 0.18, 1e-12);
  EXPECT_TRUE(falls_of(t).empty());
}

TEST(TableShape, APressureThatFallsIsNamedWithItsPlace) {
  tfm::SolidsTable t = dry_table(0.18);
  t.pressure.value[t.index(2, 0, 0, 0, 0)] *= 0.3;
  const std::vector<std::string> falls = falls_of(t);
  ASSERT_EQ(falls.size(), 1u);
  EXPECT_NE(falls[0].find("phi = 0.2"), std::string::npos) << falls[0];
  EXPECT_NE(falls[0].find("e = 0.8"), std::string::npos) << falls[0];
}

// A dilute gas in shear grows hotter as it thins: without a fluid p at fixed gamma falls up to phi of about 0.17.
TEST(TableShape, TheFallInShearOfADiluteGas) {
  const double up_to = falls_in_shear_up_to(dry_table(0));
  EXPECT_GT(up_to, 0.1);
  EXPECT_LT(up_to, 0.2);
}

// With friction the reference is at e_eff = e - 1.5 mu exp(-3 mu): 0.717 of 0.9 and 0.3. A table whose boxes press as
// smooth spheres of that restitution do then has a ratio of 1 and no structure.
TEST(TableShape, RoughSpheresAreComparedWithSmoothOnesThatLoseAsMuch) {
  tfm::SolidsTable t = dry_table(0, 0.3);
  EXPECT_NEAR(t.reference_restitution(0.9, 0.3), 0.717044, 1e-6);
  for (const double a : structure_coefficients(t)) EXPECT_NEAR(a, 0, 1e-12);
  t.reference = "GD-CS";  // of files that are older
  EXPECT_EQ(t.reference_restitution(0.9, 0.3), 0.9);
}

}  // namespace
}  // namespace polybed::multiscale
