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

// Reasons are for who knows no formula: shares in per cent, more than ten in times.
TEST(Decision, SaysWhyInPlainWords) {
  std::vector<EffectRow> rows{force("a", 0.015), force("b", 0.012), force("c", 30), force("d", 0.11)};
  for (EffectRow& row : rows) row.phrase = "push: {} the weight";
  rows[3].phrase = "Stokes number {}";
  rows[3].below = true;
  rows[3].threshold = 1750;
  decide(rows, {0.02, false, {}, {}});
  EXPECT_EQ(rows[0].reason, "push: 1.5 % of the weight; little by itself, but all that is left out would be 2.7 %");
  EXPECT_EQ(rows[1].reason, "push: 1.2 % of the weight, within the 2 % that may be left out");
  EXPECT_EQ(rows[2].reason, "push: 30 times the weight, more than the 2 % that may be left out");
  EXPECT_EQ(rows[3].reason, "Stokes number 0.11, below 1750");
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

// Undecided is neither on nor "not needed", counts with its upper end, and switches nothing else on.
TEST(Decision, LeavesOpenWhatABandLeavesOpen) {
  std::vector<EffectRow> rows{force("a", 0.5), force("b", 0.004)};
  rows[0].band = NumberBand{0.001, 0.5};
  rows[0].phrase = "push: {} the weight";
  decide(rows, {0.02, false, {}, {}});
  EXPECT_EQ(rows[0].state, EffectRow::State::undecided);
  EXPECT_EQ(rows[1].state, EffectRow::State::off);
  EXPECT_EQ(rows[0].reason, "push: 0.1 % to 50 % of the weight, too uncertain to decide");
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.504);
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "dem"), 0.504);
}

// A small certain value beside a band that reaches further is as open; a band on one side of the limit is decided.
TEST(Decision, DecidesByABandOnOneSideOfTheLimit) {
  std::vector<EffectRow> rows{force("open", 0.001), force("on", 0.5), force("off", 0.01)};
  rows[0].band = NumberBand{0, 0.3};
  rows[1].band = NumberBand{0.03, 0.5};
  rows[2].band = NumberBand{0.001, 0.01};
  decide(rows, {0.02, false, {}, {}});
  EXPECT_EQ(rows[0].state, EffectRow::State::undecided);
  EXPECT_TRUE(on(rows[1]) && !on(rows[2]));
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.31);
  rows = {force("open", 0.015), force("small", 0.012)};  // a sum above the limit does not decide it either
  rows[0].band = NumberBand{0, 0.3};
  decide(rows, {0.02, false, {}, {}});
  EXPECT_EQ(rows[0].state, EffectRow::State::undecided);
  EXPECT_FALSE(on(rows[1]));
  rows = {force("on", 0.5)};
  rows[0].band = NumberBand{0.03, 0.5};
  decide(rows, {0.02, false, {}, {"on"}});  // switched off by the case
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.5);
}

TEST(Numbers, HaveNoPowerOfTenBelowAMillion) {
  EXPECT_EQ(percent(0.9999), "100 %");
  EXPECT_EQ(percent(0.9951), "100 %");
  EXPECT_EQ(percent(0.0995), "10 %");
  EXPECT_EQ(percent(27), "2700 %");
  EXPECT_EQ(two_digits(99.6), "100");
  EXPECT_EQ(two_digits(0.014), "0.014");
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
  rows[2].band = NumberBand{0.001, 0.3};  // too uncertain to decide: by its upper end
  decide(rows, {0.02, false, {"c"}, {}});
  EXPECT_TRUE(on(rows[0]) && !on(rows[1]) && on(rows[2]) && on(rows[3]));
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "dem"), 0.004);
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "dem"), neglected_sum(rows));
  EXPECT_DOUBLE_EQ(neglected_sum(rows, "tfm"), 0.804);
  rows[0].up_to = 0.7;
  EXPECT_DOUBLE_EQ(neglected_up_to(rows, "dem"), 0.004);
  EXPECT_DOUBLE_EQ(neglected_up_to(rows, "tfm"), 1.004);
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
  EXPECT_NE(rows[0].reason.find("in places of a run up to 30 %"), std::string::npos);
  EXPECT_EQ(rows[1].reason.find("of a run"), std::string::npos);
  EXPECT_DOUBLE_EQ(neglected_sum(rows), 0.01);
  EXPECT_DOUBLE_EQ(neglected_up_to(rows), 0.3);
}

}  // namespace
}  // namespace polybed::relevance
