// Plans, blocks and fits of the calibration: no box is run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../core/scratch.hpp"
#include "closures/kinetic_theory.hpp"
#include "core/error.hpp"
#include "multiscale/calibrate/bed_table.hpp"
#include "multiscale/calibrate/box_result.hpp"
#include "multiscale/calibrate/fit.hpp"
#include "multiscale/calibrate/reference.hpp"

namespace polybed::multiscale {
namespace {

core::Scene dry_scene() {
  core::Scene scene;
  scene.fluid.name = "none";
  scene.species.resize(1);
  scene.species[0].diameter = 1e-3;
  scene.species[0].density = 2500;
  scene.bed.volume_share = {1};
  scene.dem.friction = 0;
  scene.calibrate.solids_fraction = {0.1, 0.2, 0.3, 0.4, 0.45};
  scene.calibrate.restitution = {0.8, 0.9};
  return scene;
}

/// Boxes of a plan whose pressure is that of chi_eff = chi_CS (1 + a S), S = 0.5 everywhere, with an error of their
/// own.
std::vector<BoxResult> synthetic(const Plan& plan, double a, double scatter) {
  std::vector<BoxResult> boxes;
  for (const BoxPoint& p : plan.boxes) {
    BoxResult b;
    b.point = p;
    b.shear_rate = 10;
    b.diameter = 1e-3;
    b.theta = {std::pow(b.shear_rate * b.diameter / 0.5, 2), 0};
    const double chi = closures::radial_carnahan_starling(p.phi).value;
    const double ratio = closures::kinetic_pressure(p.phi, chi * (1 + a * 0.5), p.restitution) /
                         closures::kinetic_pressure(p.phi, chi, p.restitution);
    b.pressure_ratio = {ratio * (1 + (p.seed == 1 ? scatter : -scatter)), 0.001};
    b.viscosity_ratio = b.dissipation_ratio = b.temperature_ratio = {1, 0.001};
    boxes.push_back(b);
  }
  return boxes;
}

TEST(CalibratePlan, EveryPointWithItsSeeds) {
  const Plan plan = plan_of(dry_scene());
  EXPECT_EQ(plan.regime.name, "dry");
  ASSERT_EQ(plan.boxes.size(), 5u * 2 * 2);
  EXPECT_EQ(plan.boxes[0].seed, 1);
  EXPECT_EQ(plan.boxes[1].seed, 2);
  EXPECT_EQ(plan.boxes[2].restitution, 0.9);
  EXPECT_EQ(plan.boxes[4].phi, 0.2);
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
}

TEST(CalibratePlan, AnythingThatABoxDependsOnChangesItsName) {
  const core::Scene scene = dry_scene();
  const BoxPoint point = plan_of(scene).boxes[0];
  core::Scene longer = scene;
  longer.calibrate.strain *= 2;
  BoxPoint other = point;
  other.seed = 7;
  EXPECT_EQ(box_hash(scene, point), box_hash(scene, point));
  EXPECT_NE(box_hash(scene, point), box_hash(longer, point));
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

TEST(CalibrateFit, ASyntheticTableIsRecovered) {
  const Plan plan = plan_of(dry_scene());
  const fluid::SolidsTable t = fitted(plan, synthetic(plan, 0.18, 0.001));
  for (const double a : structure_coefficients(t)) EXPECT_NEAR(a, 0.18, 1e-12);  // scatter cancels in the mean
  EXPECT_NO_THROW(require_usable(t));
  EXPECT_EQ(t.pressure.seeds[0], 2);
  // Two boxes 0.1 % off to both sides: s/sqrt(2) = 0.1 %, Student's factor of one degree of freedom is 1.837.
  EXPECT_NEAR(t.pressure.error[0] / t.pressure.value[0], 1.837e-3, 1e-12);
}

// 1 1 1.2 1 at 0.1 to 0.4: without 0.3 the curve is 1 there, 0.2/1.2 off. Its knots at 0.2 and 0.4 have errors of 0.01
// and move it by half of that, the point has 0.01: 2 sqrt(1.5e-4) of 1.2 is taken off. Without 0.2 it is 1.1, less off.
TEST(CalibrateFit, ACurveIsTestedWhereAPointIsLeftOut) {
  core::Scene scene = dry_scene();
  scene.calibrate.solids_fraction = {0.1, 0.2, 0.3, 0.4};
  scene.calibrate.restitution = {0.9};
  scene.calibrate.seeds = 1;
  const Plan plan = plan_of(scene);
  std::vector<BoxResult> boxes = synthetic(plan, 0, 0);
  for (BoxResult& b : boxes) b.pressure_ratio = {b.point.phi == 0.3 ? 1.2 : 1, 0.01};
  const fluid::SolidsTable t = fitted(plan, boxes);
  EXPECT_NEAR(t.left_out, 0.2 / 1.2, 1e-12);
  EXPECT_NEAR(t.residual, (0.2 - 2 * std::sqrt(1.5e-4)) / 1.2, 1e-12);
  EXPECT_THROW(require_usable(t), core::NumericsError);
  for (BoxResult& b : boxes) b.pressure_ratio.error = 0.08;  // two errors of both are then 0.196
  EXPECT_NO_THROW(require_usable(fitted(plan, boxes)));
}

/// Boxes of a plan of three seeds, `scatter` above, `scatter` below and at the mean.
std::vector<BoxResult> three_seeds(const Plan& plan, double scatter) {
  std::vector<BoxResult> boxes = synthetic(plan, 0.18, scatter);
  for (BoxResult& b : boxes)
    if (b.point.seed == 3) b.pressure_ratio.mean /= 1 - scatter;
  return boxes;
}

// s is the scatter, the standard error 1.321 s/sqrt(3): 0.06 gives 4.6 %, 0.07 gives 5.3 % and a seed more at that
// point alone, until there are ten.
TEST(CalibrateFit, SeedsAreAddedWhereTheyScatter) {
  core::Scene scene = dry_scene();
  scene.calibrate.seeds = 3;
  Plan plan = plan_of(scene);
  std::vector<BoxResult> boxes = three_seeds(plan, 0.06);
  EXPECT_FALSE(add_seeds(plan, fitted(plan, boxes)));
  const std::vector<BoxResult> worse = three_seeds(plan, 0.07);
  std::copy(worse.begin() + 9, worse.begin() + 12, boxes.begin() + 9);  // of the fourth point
  const fluid::SolidsTable scattered = fitted(plan, boxes);
  EXPECT_NEAR(greatest_error(scattered), 1.321 * 0.07 / std::sqrt(3.0), 1e-12);
  EXPECT_THROW(require_usable(scattered), core::NumericsError);
  ASSERT_TRUE(add_seeds(plan, scattered));
  EXPECT_EQ(plan.seeds, (std::vector<int>{3, 3, 3, 4, 3, 3, 3, 3, 3, 3}));
  ASSERT_EQ(plan.boxes.size(), 31u);
  EXPECT_EQ(plan.boxes[12].seed, 4);
  EXPECT_EQ(plan.boxes[12].phi, plan.boxes[11].phi);
  // A fourth at the mean: s = 0.07 sqrt(2/3), 1.197 s/2.
  boxes.insert(boxes.begin() + 12, boxes[11]);
  const fluid::SolidsTable t = fitted(plan, boxes);
  EXPECT_NEAR(t.pressure.error[3] / t.pressure.value[3], 1.197 * 0.07 * std::sqrt(2.0 / 3) / 2, 1e-12);
  EXPECT_EQ(t.pressure.seeds[3], 4);
  EXPECT_NO_THROW(require_usable(t));
  plan.seeds[3] = most_seeds;
  EXPECT_FALSE(add_seeds(plan, scattered));
}

// 1, 1.1, 1.2: s = 0.1, 1.321 x 0.1/sqrt(3) whatever the boxes say; of 1 and 1.1 1.837 x 0.05 = 0.09, or the boxes'
// 0.2/sqrt(2); of one its own.
TEST(CalibrateBlocks, ThreeSeedsTellTheirErrorByTheirScatter) {
  const std::vector<Estimate> seeds{{1, 0.2}, {1.1, 0.2}, {1.2, 0.2}};
  EXPECT_NEAR(mean_of_seeds(seeds).mean, 1.1, 1e-14);
  EXPECT_NEAR(mean_of_seeds(seeds).error, 1.321 * 0.1 / std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(mean_of_seeds({seeds[0], seeds[1]}).error, 0.2 / std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(mean_of_seeds({{1, 0.02}, {1.1, 0.02}}).error, 1.837 * 0.05, 1e-14);
  EXPECT_EQ(mean_of_seeds({seeds[0]}).error, 0.2);
}

// Of one degree of freedom, Cauchy's, it is tan(0.6827 pi/2) = 1.837; from tables 1.059 at 9 and 1.053 at 10, 1 at
// many.
TEST(CalibrateBlocks, StudentsOneSigma) {
  EXPECT_NEAR(student_one_sigma(1), std::tan(0.682689 * std::acos(-1.0) / 2), 5e-4);
  EXPECT_EQ(student_one_sigma(3), 1.197);
  EXPECT_EQ(student_one_sigma(9), 1.059);
  EXPECT_NEAR(student_one_sigma(10), 1.0526, 2e-4);
  EXPECT_NEAR(student_one_sigma(100000), 1, 1e-5);
  EXPECT_THROW((void)student_one_sigma(0), std::invalid_argument);
}

TEST(CalibrateFit, APressureThatFallsIsRefusedAndItsPlaceNamed) {
  const Plan plan = plan_of(dry_scene());
  std::vector<BoxResult> boxes = synthetic(plan, 0.18, 0);
  for (BoxResult& b : boxes)
    if (b.point.phi == 0.3 && b.point.restitution == 0.8) b.pressure_ratio.mean *= 0.3;
  const fluid::SolidsTable t = fitted(plan, boxes);
  const std::vector<std::string> falls = falls_of(t);
  ASSERT_EQ(falls.size(), 1u);
  EXPECT_NE(falls[0].find("e = 0.8"), std::string::npos);
  try {
    require_usable(t);
    FAIL() << "accepted";
  } catch (const core::NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("phi = 0.2"), std::string::npos) << error.what();
  }
}

TEST(CalibrateFit, SeedsThatDisagreeAreRefused) {
  const Plan plan = plan_of(dry_scene());
  EXPECT_NO_THROW(require_usable(fitted(plan, synthetic(plan, 0.18, 0.027))));  // 1.837 x 0.027 = 4.96 %
  EXPECT_THROW(require_usable(fitted(plan, synthetic(plan, 0.18, 0.028))), core::NumericsError);
}

// A dilute gas in shear grows hotter as it thins: without a fluid p at fixed gamma falls up to phi of about 0.17.
TEST(CalibrateFit, TheFallInShearOfADiluteGasIsTold) {
  const Plan plan = plan_of(dry_scene());
  const double up_to = falls_in_shear_up_to(fitted(plan, synthetic(plan, 0, 0)));
  EXPECT_GT(up_to, 0.1);
  EXPECT_LT(up_to, 0.2);
}

// p/(mu gamma V) = 2 (1 + 0.3 St) at St 1, 3, 10: lambda 0.3 by least squares, exactly.
TEST(CalibrateFit, InertiaOfAWetTable) {
  fluid::SolidsTable t;
  t.regime = "wet";
  t.phi = {0.2, 0.4};
  t.stokes = {1, 3, 10};
  t.restitution = t.friction = t.share = {0};
  std::vector<double> p;
  for (std::size_t n = 0; n < 6; ++n) p.push_back(2 * (1 + 0.3 * t.stokes[n % 3]));
  EXPECT_NEAR(fitted_inertia(t, p), 0.3, 1e-12);
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

// With friction the reference is at e_eff = e - 1.5 mu exp(-3 mu): 0.717 of 0.9 and 0.3. A table whose boxes press as
// smooth spheres of that restitution do then has a ratio of 1 and no structure.
TEST(CalibrateFit, RoughSpheresAreHeldAgainstSmoothOnesThatLoseAsMuch) {
  core::Scene scene = dry_scene();
  scene.dem.friction = 0.3;
  scene.calibrate.restitution = {0.9};
  const Plan plan = plan_of(scene);
  const fluid::SolidsTable t = fitted(plan, synthetic(plan, 0, 0));
  EXPECT_NEAR(t.reference_restitution(0.9, 0.3), 0.717044, 1e-6);
  for (const double a : structure_coefficients(t)) EXPECT_NEAR(a, 0, 1e-12);
  fluid::SolidsTable before = t;
  before.reference = "GD-CS";  // of files that are older
  EXPECT_EQ(before.reference_restitution(0.9, 0.3), 0.9);
  scene.calibrate.restitution = {0.15};
  EXPECT_THROW((void)plan_of(scene), core::CaseError) << "0.15 - 0.183 is no restitution";
}

TEST(CalibratePlan, DryBoxesOfTwoSpeciesAreAlsoPushedApart) {
  core::Scene scene = dry_scene();
  scene.species.push_back(scene.species[0]);
  scene.species[1].diameter *= 2;
  scene.bed.volume_share = {0.5, 0.5};
  scene.calibrate.share = {0.3, 0.5};
  const Plan plan = plan_of(scene);
  ASSERT_EQ(plan.boxes.size(), 2 * 5u * 2 * 2 * 2);
  EXPECT_EQ(plan.least_seeds(), 2);
  EXPECT_FALSE(plan.boxes[39].pushed);
  EXPECT_TRUE(plan.boxes[40].pushed);
  EXPECT_EQ(plan.boxes[40].phi, plan.boxes[0].phi);
  EXPECT_NE(box_hash(scene, plan.boxes[0]), box_hash(scene, plan.boxes[40]));
  scene.calibrate.share = {0, 0.5};
  EXPECT_THROW((void)plan_of(scene), core::CaseError) << "one species alone exchanges nothing";
}

// Two seeds a point: the mean of 0.8 and 0.9 is 0.85. The first point's boxes drift at 0.2 and -0.3, all others at 0.4:
// up to 0.3 all points are measured.
TEST(CalibrateFit, ExchangeAndTheDriftThatAllPointsHad) {
  core::Scene scene = dry_scene();
  scene.species.push_back(scene.species[0]);
  scene.species[1].diameter *= 2;
  scene.bed.volume_share = {0.5, 0.5};
  scene.calibrate.share = {0.5};
  const Plan plan = plan_of(scene);
  std::vector<BoxResult> boxes = synthetic(plan, 0.18, 0);
  for (BoxResult& b : boxes) {
    if (!b.point.pushed) continue;
    b.exchange_ratio = {b.point.seed == 1 ? 0.8 : 0.9, 0.01};
    b.slip = 0.4;
  }
  boxes[boxes.size() / 2].slip = 0.2;
  boxes[boxes.size() / 2 + 1].slip = -0.3;
  fluid::SolidsTable t = fitted(plan, boxes);
  ASSERT_EQ(t.exchange.value.size(), t.size());
  EXPECT_NEAR(t.exchange.value[0], 0.85, 1e-14);
  EXPECT_EQ(t.exchange_drift, 0.3);
  EXPECT_NO_THROW(require_usable(t));
  t.exchange.value[3] = -0.1;
  EXPECT_THROW(require_usable(t), core::NumericsError) << "species that are sped up by each other";
}

// Two points of two seeds: p 1.00 and 1.02, s/sqrt(2) = 0.01, times 1.837; errors of the boxes 0.002/sqrt 2.
TEST(CalibrateBed, BothWaysTheirErrorsAndTheirDifference) {
  Plan plan;
  plan.axes = {{0.3, 0.5}, {0}, {0.9}, {0.3}, {0}};
  std::vector<BoxResult> boxes(4);
  for (std::size_t n = 0; n < 4; ++n) {
    boxes[n].bed_phi = n < 2 ? 0.28 : 0.46;
    boxes[n].bed_pressure = {(n < 2 ? 1.0 : 3.0) + (n % 2 == 0 ? 0 : 0.02), 0.002};
    boxes[n].bed_balance = {1.03 * boxes[n].bed_pressure.mean, 0.002};
    boxes[n].theta = {2e-6, 0};
    boxes[n].velocity = n < 2 ? 0.02 : 0.01;
  }
  const BedTable t = bed_table(plan, boxes, 4e-6);
  ASSERT_EQ(t.phi.size(), 2u);
  EXPECT_NEAR(t.pressure[0], 1.01, 1e-14);
  EXPECT_NEAR(t.error[0], 0.01837, 1e-14);
  EXPECT_NEAR(t.difference(0), 0.03, 1e-14);
  EXPECT_NEAR(t.temperature[1], 0.5, 1e-14);
  EXPECT_EQ(t.velocity[1], 0.01);
  EXPECT_NO_THROW(require_usable(t));
  BedTable off = t;
  off.balance[1] *= 1.1;
  EXPECT_THROW(require_usable(off), core::NumericsError);
  BedTable falling = t;
  falling.pressure[1] = falling.balance[1] = 0.9;
  EXPECT_THROW(require_usable(falling), core::NumericsError);
}

TEST(CalibrateBox, ItsFileIsReadBackAndNoOther) {
  const test::Scratch scratch;
  BoxResult b;
  b.point = {"wet", 0.4, 3, 0.9, 0.3, 0, false, false, 5};
  b.hash = "0123";
  b.pressure = {1.0 / 3, 0.01};
  b.balance = 0.999;
  write_box(scratch.path() / "box.json", b);
  const auto back = read_box(scratch.path() / "box.json", "0123");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->pressure.mean, 1.0 / 3);
  EXPECT_EQ(back->point.seed, 5);
  EXPECT_EQ(back->balance, 0.999);
  EXPECT_FALSE(read_box(scratch.path() / "box.json", "4567")) << "of another box";
  EXPECT_FALSE(read_box(scratch.path() / "none.json", "0123"));
}

}  // namespace
}  // namespace polybed::multiscale
