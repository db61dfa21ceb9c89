// What is evaluated of a force that was left out.
#include <gtest/gtest.h>

#include <cmath>

#include "closures/relevance.hpp"
#include "core/case/file.hpp"
#include "multiscale/effects/monitor.hpp"
#include "multiscale/effects/neglected.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"
#include "tests/unit/multiscale/beads_case.hpp"

namespace polybed::multiscale {
namespace {

TEST(Sample, IsTheShareAskedForAndAlwaysTheSame) {
  int count = 0;
  for (std::int64_t n = 0; n < 64000; ++n) count += in_sample(n, 64);
  EXPECT_NEAR(count, 1000, 4 * std::sqrt(1000.0));  // four deviations of a binomial count
  for (std::int64_t n = 0; n < 100; ++n) EXPECT_TRUE(in_sample(n, 1));
}

const std::string text = test::beads_case("contact = \"hertz\"\nmagnus = \"rubinow_keller\"\n");

TEST(Monitor, WatchesNoShearedBox) {
  core::Scene scene = core::parse_case(text, "case.toml", {}, all_roles(), size_classes);
  scene.chooser.monitor = core::MonitorMode::warn;
  EXPECT_NE(Monitor::of(scene, "dem"), nullptr);
  scene.column.shear_rate = -2;  // it has no cells of a fluid to look at
  EXPECT_EQ(Monitor::of(scene, "dem"), nullptr);
}

TEST(Neglected, EvaluatesTheClosureOfTheChoice) {
  core::Scene scene = core::parse_case(text, "case.toml", {}, all_roles(), size_classes);
  scene.effects.erase("magnus");
  Neglected neglected(scene, "dem");
  Encounter met;
  met.slip = {0, 0.02, 0};
  met.vorticity = {0, 0, 5};
  met.spin = closures::Vec3{0, 0, 2.5};  // turns with the fluid
  for (int n = 0; n < 99; ++n) neglected.see(met);
  met.vorticity = {0, 0, 50};
  met.time = 3;
  neglected.see(met);
  const Observed& lift = neglected.observed()[0];
  ASSERT_EQ(lift.effect, "lift");
  const auto share = [](double vorticity) {  // water at 20 degC: 998.2 kg/m3, 1.0016 mPa s
    return closures::lift_relevance(1e-3, 998.2, 1.0016e-3, 0.02, vorticity,
                                    closures::buoyant_weight(1e-3, 2500, 998.2, 9.81));
  };
  EXPECT_NEAR(lift.greatest / share(50), 1, 1e-4);  // digits of the water's properties
  EXPECT_EQ(lift.time, 3);
  EXPECT_GE(lift.percentile(), share(5));  // 99 of 100 are not above: the edge of a bin of a twentieth of a decade
  EXPECT_LE(lift.percentile(), share(5) * std::pow(10, 0.05));
  ASSERT_EQ(neglected.observed()[1].effect, "magnus");
  EXPECT_GT(neglected.observed()[1].greatest, 0);
  // Beyond Re_p 100 the laws are a band: counted apart.
  met.slip = {0, 1, 0};
  neglected.see(met);
  EXPECT_EQ(neglected.observed()[0].outside, 1U);
  EXPECT_EQ(neglected.sum().outside, 1U);
}

// Of the cells of a round column as much counts as of their volume is open: 0.4 of 2.4 of them is beyond.
TEST(Neglected, WeighsWhatIsMet) {
  core::Scene scene = core::parse_case(text, "case.toml", {}, all_roles(), size_classes);
  Neglected neglected(scene, "tfm");
  Encounter met;
  met.slip = {0, 1e-3, 0};
  for (const std::uint64_t weight : {1000, 1000}) {
    met.weight = weight;
    neglected.see(met);
  }
  met.slip = {0, 0.02, 0};
  met.vorticity = {0, 0, 500};  // a lift of 9 % of the weight by Saffman's law
  met.weight = 400;
  neglected.see(met);
  EXPECT_EQ(neglected.sum().count, 2400U);
  EXPECT_EQ(neglected.sum().above, 400U);
  EXPECT_GT(neglected.sum().greatest, 0);
}

// Where all that is met lies beyond the laws, nothing is known of their sum: it is not 0.
TEST(Neglected, IsNotKeptWhereNothingCouldBeEvaluated) {
  Neglected neglected(core::parse_case(text, "case.toml", {}, all_roles(), size_classes), "tfm");
  Encounter met;
  met.slip = {0, 1, 0};
  met.vorticity = {0, 0, 5};
  EXPECT_FALSE(neglected.kept().has_value());
  neglected.see(met);
  EXPECT_FALSE(neglected.kept().has_value());
  met.slip = {0, 1e-3, 0};
  neglected.see(met);
  EXPECT_TRUE(neglected.kept().has_value());
}

// What had been missed of system B: the fluid rushes through a bed that is lifted as a whole, 30 mm/s over a voidage of
// 0.38, along walls that it sticks to; vorticity in a cell of 60/18 mm beside one is 0.079 m/s over its width, 23.7
// 1/s. Particles of 0.807 mm spin at 92 1/s from touching (seen in runs of particles, docs/reference/effects.md).
TEST(Neglected, BoundsWhatARunMayMeet) {
  const core::Scene scene =
      core::read_case(POLYBED_SOURCE_DIR "/cases/matsuura-akehata/case.toml", {}, all_roles(), size_classes);
  Neglected neglected(scene, "tfm");
  const Observed &lift = neglected.observed()[0], &magnus = neglected.observed()[1];
  ASSERT_EQ(lift.effect, "lift");
  ASSERT_EQ(magnus.effect, "magnus");
  Encounter met;
  for (met.species = 0; met.species < 2; ++met.species)
    for (const double slip : {0.01, 0.02, 0.03, 0.04, 0.05}) {
      met.slip = {0, slip, 0};
      met.vorticity = {0, 0, 23.7};
      met.spin = closures::Vec3{0, 0, met.species == 0 ? -92.0 : -25.0};
      neglected.see(met);
    }
  EXPECT_EQ(lift.outside, 0U);
  EXPECT_LE(lift.greatest, lift.bound);
  EXPECT_GT(lift.greatest, 0.043);  // the bound by the scales of the choice
  EXPECT_LE(magnus.greatest, magnus.bound);
  EXPECT_GT(magnus.greatest, 0.063);  // likewise
}

TEST(Conflicts, AreToldWithBothLines) {
  const core::Rulebook by_particles(scene_rules(), Models{&rules_of_dem()});
  try {
    (void)core::parse_case(text, "case.toml", {}, all_roles(), size_classes, by_particles);
    FAIL() << "taken";
  } catch (const core::CaseError& error) {
    ASSERT_EQ(error.problems().size(), 2U);
    EXPECT_EQ(error.problems()[0].line, 13);
    EXPECT_EQ(error.problems()[1].line, 14);
  }
  const std::vector<std::string> rough{"effects.contact=hertz_mindlin"};
  EXPECT_NO_THROW((void)core::parse_case(text, "case.toml", rough, all_roles(), size_classes, by_particles));
}

}  // namespace
}  // namespace polybed::multiscale
