#include "tfm/step_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scenes/record.hpp"
#include "tfm/fast_drag.hpp"
#include "tfm/model.hpp"

namespace polybed::tfm {
namespace {

Constants spheres(double diameter, double density) {
  Constants constants;
  constants.gravity = 9.81;
  constants.fluid = {1000, 1e-3};
  constants.diameter = {diameter};
  constants.density = {density};
  constants.bed_share = {1.0};
  constants.name = {"solid"};
  constants.grid.spacing = {1e-3, 2e-3, 1e-3};
  return constants;
}

closures::DragLaw law_of(const char* name) { return closures::drag_law(name, closures::Guard::on); }

double scale_of(const std::vector<TimeScale>& scales, const std::string& process) {
  for (const TimeScale& scale : scales)
    if (scale.process == process) return scale.seconds;
  ADD_FAILURE() << process << " is missing";
  return 0;
}

// Stokes' drag has f = 1 at any voidage, so that the balance is eps = U/u_t; u_t = D^2 (rho_s - rho_f) g/(18 mu) =
// 1e-8 * 1000 * 9.81/0.018 = 5.45e-3 m/s by hand.
TEST(ExpandedFraction, StokesByHand) {
  const Constants constants = spheres(1e-4, 2000);
  EXPECT_NEAR(expanded_fraction(constants, law_of("stokes"), 0.7 * 5.45e-3, 0.6), 0.3, 1e-12);  // bisection to 2^-50
  EXPECT_EQ(expanded_fraction(constants, law_of("stokes"), 0.3 * 5.45e-3, 0.6), 0.6) << "the fluid does not carry it";
  EXPECT_EQ(expanded_fraction(constants, law_of("stokes"), 1.1 * 5.45e-3, 0.6), 0) << "a lone particle is carried away";
  EXPECT_EQ(expanded_fraction(spheres(1e-4, 900), law_of("stokes"), 1e-3, 0.6), 0) << "nothing pulls it down";
}

TEST(ExpandedFraction, FallsWithVelocity) {
  const Constants constants = spheres(1e-3, 2500);
  double before = 0.6;
  for (const double velocity : {0.02, 0.04, 0.08}) {
    const double now = expanded_fraction(constants, law_of("cello"), velocity, 0.6);
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(ExpectedStep, ByHand) {
  EXPECT_DOUBLE_EQ(explicit_step({{"drag", 0.5, 0}, {"convection", 0.2, 0}}), 1.4 * 0.2);
  // h = 1 mm: 1/(1/0.1 s + sqrt(4.905/0.001)/s) = 1/80.0357 s at rtol 1e-3, half of it taken; an eighth of rtol halves
  // it
  const double step = implicit_step(spheres(1e-3, 2000), 0.01, 1e-3);
  EXPECT_NEAR(step, 0.5 / 80.0357, 1e-6 * step);
  EXPECT_NEAR(implicit_step(spheres(1e-3, 2000), 0.01, 0.125e-3), 0.5 * step, 1e-12 * step);
}

// In a fluid at rest spheres of 0.1 mm fall 5 mm/s: a cell of 1 mm takes ten times as long as a free fall.
TEST(ImplicitStep, FollowsTheFallOfALoneParticleWhereNothingFlows) {
  const Constants constants = spheres(1e-4, 2000);
  const double falls = 1e-3 / terminal_velocity(constants, 0);
  EXPECT_NEAR(implicit_step(constants, 0, 1e-3), 0.5 * falls, 1e-12 * falls);
  EXPECT_GT(implicit_step(constants, 0, 1e-3), 10 * implicit_step(constants, 1e-9, 1e-3));
}

// The spheres of StokesByHand on cells of 1 mm at a voidage of 0.7. Drag: b = 18e-3 * 0.7/1e-8 = 1.26e6 kg/(m3 s). What
// is left explicit relaxes at 0.3 b (1/1000 - 1/2000)^2/(0.7/1000 + 0.3/2000) = 111.18/s, so steps are at most
// 1.4/111.18 s = 12.6 ms; the error test asks for 0.75/(5.45 + 70.0357) s = 9.9 ms, 1.5 times an implicit step.
TEST(SplitStepsPerImplicit, StokesByHand) {
  core::Scene scene = scenes::uniform_bed(1e-4, 2000, 1000, 1e-3, 0.6, 20, 0.02);
  scene.effects = {{"drag", "stokes"}};
  scene.tfm.rtol = 1e-3;
  core::Timers timers;
  const Model model(scene, timers);
  const auto replaced = [&](double velocity) {
    return split_steps_per_implicit(scene, model.constants(), model.effects(), velocity);
  };
  const double expected = 0.5 / 0.75;
  EXPECT_NEAR(replaced(0.7 * 5.45e-3), expected, 1e-5 * expected);
}

// The same in numbers: the slow part of the drag, and the least of both.
TEST(SplitStep, IsBoundByWhatTheSplitLeaves) {
  SlowDrag slow(0.7, 1000);
  slow.add(0.3, 1.26e6, 2000);
  EXPECT_NEAR(slow.rate(), 111.1764705882, 1e-9);
  const Constants constants = spheres(1e-3, 2000);
  EXPECT_DOUBLE_EQ(split_step(constants, {{"drag", 1e-3, 0}}, 0.01, 1e-3), 1.4e-3);
  EXPECT_DOUBLE_EQ(split_step(constants, {{"drag", 1.0, 0}}, 0.01, 1e-3), 1.5 * implicit_step(constants, 0.01, 1e-3));
}

/// The estimate against the fields of a packed bed at its start, of which it knows no cells: the same formulas for the
/// same even bed. What is left are walls and the top of the bed, which had no effect on four digits; 0.1 % is allowed.
TEST(TimeScalesOfBed, AreThoseOfTheFieldsAtTheStart) {
  core::Scene scene = scenes::binary_bed(8, 40, 0.03, 0.15);
  scene.bed.start_solids_fraction = scene.bed.solids_fraction;
  scene.effects["fluid_stress"] = "newtonian";
  core::Timers timers;
  Model model(scene, timers);
  model.show(0);
  const double viscosity = model.effects().fluid_stress->kinematic_viscosity();
  const std::vector<TimeScale> found = time_scales(model.constants(), model.fields(), viscosity);
  const std::vector<TimeScale> estimated = time_scales_of_bed(scene, model.constants(), model.effects(),
                                                              {scene.bed.solids_fraction, model.inlet().greatest()});
  ASSERT_EQ(found.size(), 5u);
  EXPECT_EQ(estimated.size(), found.size());
  for (const TimeScale& scale : found) {
    const double ratio = scale_of(estimated, scale.process) / scale.seconds;
    scenes::record(scale.process, ratio);
    EXPECT_GT(ratio, 0.999) << scale.process << " " << scale.seconds;
    EXPECT_LT(ratio, 1.001) << scale.process << " " << scale.seconds;
  }
}

/// Two unequal species in one cell, whose exchange coefficients stand in the fields: b = 6e5 and 2e4 kg/(m3 s), 2000
/// and 1000 kg/m3, fractions 0.2 and 0.1, voidage 0.7, fluid of 1000 kg/m3. By hand: the faster relaxes at 6e5/2000 =
/// 300/s, the fluid at (0.2 * 6e5 + 0.1 * 2e4)/(0.7 * 1000) = 174.2857/s; both species count, in whatever order they
/// stand.
TEST(TimeScales, DragOfEverySpeciesActsOnTheFluidInAnyOrder) {
  for (const bool swapped : {false, true}) {
    Constants constants = spheres(1e-3, 2000);
    constants.diameter = {1e-3, 1e-3};
    constants.density = swapped ? std::vector{1000.0, 2000.0} : std::vector{2000.0, 1000.0};
    constants.name = {"one", "other"};
    Fields fields(constants);
    const std::size_t heavy = swapped ? 1 : 0, light = 1 - heavy;
    const auto cell = std::size_t(constants.grid.index(0, 0));
    fields.fluid.voidage[cell] = 0.7;
    fields.solids.fraction[heavy][cell] = 0.2;
    fields.solids.fraction[light][cell] = 0.1;
    fields.solids.exchange[heavy][cell] = 6e5;
    fields.solids.exchange[light][cell] = 2e4;
    EXPECT_NEAR(scale_of(time_scales(constants, fields, 0), "drag"), 1 / 474.2857142857, 1e-12) << swapped;
  }
}

TEST(TimeScalesOfBed, AnAbsentEffectHasNone) {
  core::Scene scene = scenes::binary_bed(4, 20, 0.015, 0.075);
  scene.effects = {{"drag", "cello"}};
  core::Timers timers;
  const Model model(scene, timers);
  EXPECT_EQ(time_scales_of_bed(scene, model.constants(), model.effects(), {0.5, 0.03}).size(), 2u);
}

}  // namespace
}  // namespace polybed::tfm
