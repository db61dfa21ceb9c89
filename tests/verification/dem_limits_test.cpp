// Where the particle model must stop, and the limits of its steps and coefficients: D2, D10, D14, D15 of the hard
// cases.
#include "core/error.hpp"
#include "scenes/dem_scenes.hpp"

namespace polybed::scenes {
namespace {

double limit(const Beads& beads, const std::string& name) {
  for (const dem::StepLimit& l : beads.model.limits().all)
    if (l.name == name) return l.dt;
  throw std::out_of_range(name);
}

// A fifth of the Rayleigh time of glass beads of 1 mm, 50 GPa: pi R sqrt(rho/G)/(0.1631 nu + 0.8766) is 6.054e-7 s by
// hand.
TEST(DemLimits, ShareOfTheRayleighTime) {
  const core::Scene scene = dry_box(0.5e-3, {50e9, 0.25, 2500}, {0.01, 0.01, 0.01});
  const Beads beads(scene, {{"a", {0.005, 0.005, 0.005}}});
  compare("Rayleigh time", 5 * limit(beads, "Rayleigh time of a"), 6.054e-7, 1e-4);
}

/// A sphere that rests on a linear floor and is set moving slightly: a damped oscillator that never parts.
struct Rest {
  core::Scene scene;
  double sag;  ///< m
};

Rest resting(double damping, const std::string& integrator) {
  core::Scene scene = dry_box(0.5e-3, {1e6, 0.25, 2600}, {0.01, 0.01, 0.01});
  scene.effects["contact"] = "linear";
  scene.dem.normal_stiffness = 1000;
  scene.dem.tail = core::Tail::keep;
  scene.dem.integrator = core::choice_of<core::DemIntegrator>(integrator);
  // beta of the restitution, turned round: zeta of the linear law.
  core::set_restitution(scene, std::exp(-pi * damping / std::sqrt(1 - damping * damping)));
  scene.column.gravity = 9.81;
  return {scene, mass_of(0.5e-3, 2600) * 9.81 / 1000};
}

/// Whether a disturbance of 1e-6 of the sag has grown ten-fold after 300 steps. The force's unit is 1e-17 of the
/// weight.
bool grows(Rest rest, double dt) {
  rest.scene.dem.fixed_step = dt;
  Beads beads(rest.scene, {{"a", {0.005, 0.5e-3 - rest.sag * (1 + 1e-6), 0.005}}});
  double most = 0;
  for (int n = 0; n < 300; ++n) {
    beads.steps(1);
    most = std::max(most, std::abs(beads.place(0).x[1] - 0.5e-3 + rest.sag));
    if (!(most < 1e-5 * rest.sag)) return true;
  }
  return false;
}

// D2: the greatest stable step, bracketed by bisection, is the one that the engine predicts, within 5 %: at damping
// ratios 0 to 0.8, for both integrators.
TEST(DemLimits, OfTheStepArePredicted) {
  for (const std::string integrator : {"thesis", "synchronised"})
    for (const double damping : {0.0, 0.05, 0.2, 0.5, 0.8}) {
      const Rest rest = resting(damping, integrator);
      const Beads beads(rest.scene, {{"a", {0.005, 0.005, 0.005}}});
      const double predicted = limit(beads, "damping of a and wall") / 0.2;
      double low = 0.5 * predicted, high = 1.5 * predicted;
      for (int n = 0; n < 8; ++n) {
        const double middle = 0.5 * (low + high);
        (grows(rest, middle) ? high : low) = middle;
      }
      compare(fmt::format("D2 {} {}", integrator, damping), 0.5 * (low + high), predicted, 0.05);
      EXPECT_FALSE(grows(rest, 0.05 * predicted));
      EXPECT_TRUE(grows(rest, 1.2 * predicted));
    }
}

/// The message with which a model stops.
std::string message(const core::Scene& scene, const std::vector<Bead>& start, int steps = 100) {
  try {
    Beads beads(scene, start);
    beads.steps(steps);
  } catch (const core::NumericsError& error) {
    return error.what();
  }
  return "did not stop";
}

// D10: 100 m/s at a wall, where 1 m/s was expected: it stops with the id, and before the particle is beyond the wall.
TEST(DemLimits, StopsAtAParticleThatIsTooFast) {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.05, 0.05, 0.05});
  scene.column.closed = true;
  const std::string text = message(scene, {{"a", {0.02, 0.02, 0.02}}, {"a", {0.04, 0.04, 0.04}, {0, -100, 0}}});
  EXPECT_THAT(text, testing::HasSubstr("particle 1 moves by more than a tenth of its diameter"));
  // Expected, it may fly: a hundred steps of 0.01 diameters.
  scene.dem.greatest_speed = 100;
  EXPECT_EQ(message(scene, {{"a", {0.02, 0.02, 0.02}}, {"a", {0.04, 0.04, 0.04}, {0, -100, 0}}}), "did not stop");
}

/// A bead that falls on the floor of a soft box, 20 times as fast as stated.
core::Scene faster_than_stated() {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.02, 0.06, 0.02});
  scene.column.gravity = 9.81;
  scene.dem.greatest_speed = 0.05;
  return scene;
}

// What is faster than expected shortens the step and goes on: 1 m/s after a fall of 51 mm. The time is that of the
// fall, and a run taken up in between has the same bits.
TEST(DemLimits, AParticleFasterThanExpectedShortensTheStep) {
  Beads beads(faster_than_stated(), {{"a", {0.01, 0.0515, 0.01}}});
  const double first = beads.dt();
  beads.run_while([&] { return beads.model.time() < 0.06; });
  const core::Checkpoint halfway = beads.model.checkpoint();
  beads.run_while([&] { return beads.place(0).x[1] > 0.6e-3; });
  compare("time of a fall with steps of several lengths", beads.model.time(), std::sqrt(2 * 0.0509 / 9.81), 1e-3);
  EXPECT_LT(beads.dt(), 0.6 * first) << "the time of a contact goes with v^(-1/5): 20^(-1/5) = 0.55";
  const dem::Work work = beads.model.work();
  EXPECT_GE(work.shortenings, 1u);
  compare("greatest speed met", work.greatest_speed, std::sqrt(2 * 0.0509 * 9.81), 1e-2);
  Beads again(faster_than_stated(), {{"a", {0.01, 0.0515, 0.01}}});
  again.model.resume(halfway);
  again.run_while([&] { return again.place(0).x[1] > 0.6e-3; });
  EXPECT_EQ(again.motion(0).v, beads.motion(0).v);
  EXPECT_EQ(again.model.time(), beads.model.time());
}

TEST(DemLimits, AStepThatTheCaseGivesStays) {
  core::Scene scene = faster_than_stated();
  scene.dem.fixed_step = 1e-5;
  Beads beads(scene, {{"a", {0.01, 0.0515, 0.01}}});
  beads.until(0.09);
  EXPECT_EQ(beads.dt(), 1e-5);
  EXPECT_EQ(beads.model.work().shortenings, 0u);
}

// A bead stopped by the floor: the stiffness that the message names keeps the overlap within the limit, 0.7 of it does
// not (7 % of the depth are the dashpot's, 0.7^(-2/5) = 1.15).
TEST(DemLimits, TheStiffnessAdvisedIsEnoughAndNotMuchMore) {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.02, 0.02, 0.02});
  scene.dem.youngs_modulus = 5e6;
  scene.species[0].youngs_modulus.reset();
  core::set_restitution(scene, 0.9);
  scene.dem.greatest_speed = 0.5;  // at which no contact is too soft: the advice is that of this one alone
  const std::vector<Bead> start{{"a", {0.01, 0.7e-3, 0.01}, {0, -2, 0}}};
  const std::string text = message(scene, start, 1000), key = "dem.youngs_modulus = \"";
  ASSERT_THAT(text, testing::HasSubstr(key));
  const std::size_t at = text.find(key) + key.size();
  EXPECT_EQ(text.substr(text.find(' ', at), 4), " MPa");
  const double advised = 1e6 * std::stod(text.substr(at));
  scene.dem.youngs_modulus = advised;
  EXPECT_EQ(message(scene, start, 1000), "did not stop");
  scene.dem.youngs_modulus = 0.7 * advised;
  EXPECT_NE(message(scene, start, 1000), "did not stop");
}

// A tenth of a diameter is the limit: 1 % on either side of it.
TEST(DemLimits, OfATenthOfADiameterPerStep) {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.05, 0.05, 0.05});
  scene.dem.fixed_step = 1e-4;
  EXPECT_EQ(message(scene, {{"a", {0.02, 0.02, 0.02}, {0.99, 0, 0}}}), "did not stop");
  EXPECT_THAT(message(scene, {{"a", {0.02, 0.02, 0.02}, {1.01, 0, 0}}}), testing::HasSubstr("particle 0"));
}

// D14: two centres in one place have no direction: it stops at the first step and names both.
TEST(DemLimits, StopsWhereTwoCentresCoincide) {
  const core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.05, 0.05, 0.05});
  const std::vector<Bead> start{
      {"a", {0.03, 0.03, 0.03}}, {"a", {0.02, 0.02, 0.02}}, {"a", {0.01, 0.01, 0.01}}, {"a", {0.02, 0.02, 0.02}}};
  const std::string text = message(scene, start, 1);
  EXPECT_THAT(text, testing::HasSubstr("particle 1 and particle 3"));
}

/// Oblique impact on the floor at 1 m/s and 45 degrees: what leaves.
dem::Motion after_impact(double friction, double restitution) {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.05, 0.05, 0.05});
  core::set_friction(scene, friction);
  core::set_restitution(scene, restitution);
  scene.dem.steps_per_contact = 100;
  Beads beads(scene, {{"a", {0.02, 0.55e-3, 0.02}, {0.5, -0.5, 0}}});
  beads.run_while([&] { return beads.place(0).x[1] > 0.5e-3; });
  beads.run_while([&] { return beads.place(0).x[1] < 0.5e-3; });
  return beads.motion(0);
}

bool finite(const dem::Motion& m) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!std::isfinite(m.v[k]) || !std::isfinite(m.w[k])) return false;
  return true;
}

// D15: coefficients at their ends are finite and the limits of their neighbours.
TEST(DemLimits, OfCoefficientsAreContinuous) {
  for (const double mu : {0.0, 1e-9, 0.3, 10.0})
    for (const double e : {1e-6, 0.5, 1.0}) EXPECT_TRUE(finite(after_impact(mu, e))) << mu << " " << e;
  const dem::Motion none = after_impact(0, 0.9), little = after_impact(1e-9, 0.9);
  EXPECT_EQ(none.v[0], 0.5);
  EXPECT_EQ(none.w[2], 0);
  // Sliding takes mu (1 + e) v_n = 9.5e-10 m/s; 5e-3 of it, as for oblique impacts.
  compare("D15 mu 1e-9", none.v[0] - little.v[0], 1e-9 * 1.9 * 0.5, 5e-3);
  // Beyond what sticks the coefficient no longer matters: Coulomb's limit is reached only where F_n vanishes.
  compare("D15 mu 10", after_impact(10, 1).v[0], after_impact(9, 1).v[0], 5e-3);
  // Below 0.05 the restitution is that of 0.05 (closures/restitution.hpp), within the first order of 100 steps.
  compare("D15 e 1e-6", after_impact(0, 1e-6).v[1], 0.05 * 0.5, 5e-3, 0.5);
  compare("D15 e 1", after_impact(0, 1).v[1], 0.5, 1e-4);
  compare("D15 e 1 - 1e-9", after_impact(0, 1 - 1e-9).v[1], after_impact(0, 1).v[1], 1e-8);
}

/// Numbers kept of each contact.
int memory(const std::string& contact, const std::string& tangential, bool ledger) {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.05, 0.05, 0.05});
  scene.effects["contact"] = contact;
  scene.dem.normal_stiffness = 1000;
  scene.dem.tangential = core::choice_of<core::Tangential>(tangential);
  scene.dem.ledger = ledger;
  const Beads beads(scene, {{"a", {0.02, 0.02, 0.02}}});
  EXPECT_EQ(beads.model.pairs().memory_size, beads.model.walls().memory_size);
  EXPECT_EQ(beads.model.laws().tangential == nullptr, contact == "hertz");
  EXPECT_EQ(beads.model.laws().rolling, nullptr);
  EXPECT_EQ(beads.model.laws().cohesion, nullptr);
  EXPECT_EQ(beads.model.laws().reach(), 0);
  return beads.model.pairs().memory_size;
}

// What is off is absent: no number is kept for it. hertz has no friction, hdd a displacement, mindlin a force and the
// last contact radius, the ledger six numbers.
TEST(DemLimits, WhatIsOffHasNoMemory) {
  EXPECT_EQ(memory("hertz", "hdd", false), 0);
  EXPECT_EQ(memory("hertz_mindlin", "hdd", false), 3);
  EXPECT_EQ(memory("hertz_mindlin", "mindlin", false), 4);
  EXPECT_EQ(memory("linear", "linear", false), 3);
  EXPECT_EQ(memory("hertz", "hdd", true), 2);
  EXPECT_EQ(memory("hertz_mindlin", "hdd", true), 9);
}

// And what is counted changes nothing: the same bits with the ledger and without.
TEST(DemLimits, TheLedgerOnlyLooks) {
  core::Scene scene = dry_box(0.5e-3, {5e6, 0.25, 2500}, {0.05, 0.05, 0.05});
  scene.dem.ledger = true;
  const std::vector<Bead> start{{"a", {0.02, 0.02, 0.02}, {0.3, 0.1, 0}, {10, 20, 30}}, {"a", {0.0211, 0.0203, 0.02}}};
  Beads with(scene, start);
  scene.dem.ledger = false;
  Beads without(scene, start);
  with.steps(200);
  without.steps(200);
  EXPECT_LT(with.motion(0).v[0], 0.3) << "they have met";
  EXPECT_EQ(with.motion(0).v, without.motion(0).v);
  EXPECT_EQ(with.motion(1).w, without.motion(1).w);
}

}  // namespace
}  // namespace polybed::scenes
