// The rule of choice.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "relevance/choice.hpp"

namespace polybed::relevance {
namespace {

EffectRow force(const std::string& name, double value) {
  EffectRow row;
  row.effect = name;
  row.value = value;
  row.threshold = 0.02;
  row.summed = true;
  return row;
}

bool on(const EffectRow& row) { return row.state == EffectRow::State::on; }

TEST(Decision, TurnsTheLargestOnWhileTheSumIsTooGreat) {
  std::vector<EffectRow> rows{force("a", 0.015), force("b", 0.012), force("c", 0.003), force("d", 0.03)};
  decide(rows, {0.02, false, {}, {}});
  EXPECT_TRUE(on(rows[0]) && !on(rows[1]) && !on(rows[2]) && on(rows[3]));
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.015);
}

TEST(Decision, LeavesWhatTheCaseDecidesAndCountsIt) {
  std::vector<EffectRow> rows{force("a", 0.5), force("b", 0.012), force("c", 0.001)};
  decide(rows, {0.02, false, {"c"}, {"a"}});
  EXPECT_FALSE(on(rows[0]));
  EXPECT_TRUE(!on(rows[1]) && on(rows[2]));  // the sum is too great whatever b does: it is judged by itself
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.512);
  rows = {force("a", 0.015), force("b", 0.012), force("c", 0.001)};
  decide(rows, {0.02, false, {}, {"a"}});
  EXPECT_TRUE(!on(rows[0]) && on(rows[1]) && !on(rows[2]));  // here b makes up for a
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.016);
}

// Drag, stress and exchange count by the share that is missing, in the models that have laws of them.
TEST(Decision, CountsSharesOfWhatIsNoForce) {
  std::vector<EffectRow> rows{force("stress", 0.015), force("b", 0.012), force("drag", 0.3)};
  for (const std::size_t n : {0, 2}) rows[n].summed = false;
  rows[0].share_off = 0.015;
  rows[2].share_off = 1;
  rows[2].models = "tfm";
  decide(rows, {0.02, false, {}, {}});
  EXPECT_TRUE(on(rows[0]) && !on(rows[1]) && on(rows[2]));  // the first by the sum, the last by its number
  decide(rows = {rows[0], force("b", 0.012), rows[2]}, {0.02, false, {}, {"stress", "drag"}});
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "tfm"), 0.015 + 0.012 + 1);
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "dem"), 0.015 + 0.012);
}

TEST(Decision, SwitchesNothingByABand) {
  std::vector<EffectRow> rows{force("a", 0.5)};
  rows[0].band = NumberBand{0.001, 0.5};
  decide(rows, {0.02, false, {}, {}});
  EXPECT_FALSE(on(rows[0]));
  EXPECT_FALSE(rows[0].neglected.has_value());
  EXPECT_NE(rows[0].reason.find("band 0.001 to 0.5"), std::string::npos);
}

TEST(Decision, CountsWhatIsCalledForAndNotBuilt) {
  std::vector<EffectRow> rows{force("a", 0.5)};
  rows[0].not_built = "no law";
  decide(rows, {0.02, false, {}, {}});
  EXPECT_TRUE(on(rows[0]));
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.5);
}

// What is on in the choice is left out all the same by a model that has no law of it.
TEST(Decision, CountsForEachModelWhatItHasNoLawOf) {
  std::vector<EffectRow> rows{force("a", 0.5), force("b", 0.004), force("c", 0.3), force("d", 0.03)};
  for (EffectRow& row : rows) row.on_particles = true;
  rows[0].models = rows[1].models = rows[2].models = "dem";
  rows[2].band = NumberBand{0.001, 0.3};  // not known within the range: bounds nothing
  decide(rows, {0.02, false, {"c"}, {}});
  EXPECT_TRUE(on(rows[0]) && !on(rows[1]) && on(rows[2]) && on(rows[3]));
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "dem"), 0.004);
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "dem"), neglected_sum(rows));
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "tfm"), 0.504);
  rows[0].up_to = 0.7;
  EXPECT_DOUBLE_EQ(neglected_up_to(rows, "dem"), 0.004);
  EXPECT_DOUBLE_EQ(neglected_up_to(rows, "tfm"), 0.704);
}

// A mean of 0 in what is steady is 0 in any model.
TEST(Decision, LeavesNothingOutByAccelerationsThatVanish) {
  std::vector<EffectRow> rows{force("added_mass", 0.4), force("b", 0.004)};
  for (EffectRow& row : rows) row.models = "dem", row.on_particles = true;
  rows[0].of_acceleration = true;
  decide(rows, {0.02, false, {"added_mass"}, {}});
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "tfm"), 0.004);
  decide(rows, {0.02, true, {"added_mass"}, {}});
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "tfm"), 0.404);
}

// The scales of a run are told and switch nothing.
TEST(Decision, TellsWhatARunMayReach) {
  std::vector<EffectRow> rows{force("a", 0.01), force("b", 0.03)};
  rows[0].up_to = 0.3;
  rows[1].up_to = 0.4;
  decide(rows, {0.02, false, {}, {}});
  EXPECT_TRUE(!on(rows[0]) && on(rows[1]));
  EXPECT_NE(rows[0].reason.find("in a run up to 0.3"), std::string::npos);
  EXPECT_EQ(rows[1].reason.find("in a run"), std::string::npos);
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.01);
  EXPECT_DOUBLE_EQ(neglected_up_to(rows), 0.3);
}

}  // namespace
}  // namespace polybed::relevance
