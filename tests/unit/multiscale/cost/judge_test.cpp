// What a sweep advises from what it has measured.
#include "multiscale/cost/judge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace polybed::multiscale {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Sweep swept(std::vector<Share> attribution) {
  Sweep sweep;
  sweep.options.quantities = {"bed_height"};
  sweep.attribution = std::move(attribution);
  return sweep;
}

TEST(Advice, NamesTheLargestRowToImproveWhereAllWereMeasured) {
  const auto lines = advice(swept({{"time integration", 1e-6, "rtol"}, {"space", 0.02, "grid"}}));
  EXPECT_THAT(lines, Contains(HasSubstr("The largest row is space (2 %): that is what to improve.")));
  EXPECT_THAT(lines, Contains(HasSubstr("Ten times smaller, so to be loosened: time integration.")));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("Not measured"))));
}

TEST(Advice, SpeaksOnlyOfWhatWasMeasured) {
  const auto lines = advice(swept({{"time integration", 1.2e-6, "rtol"},
                                   {"space", std::nullopt, "not run", {"grid"}},
                                   {"statistics", std::nullopt, "steady"},
                                   {"level", std::nullopt, "not run", {"level"}}}));
  EXPECT_THAT(lines, Contains("The largest row of those measured is time integration (0.00012 %)."));
  EXPECT_THAT(lines,
              Contains("Not measured, so in none of these errors: space, level. --axes grid,level measures them."));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("to improve"))));
}

TEST(Advice, NamesTheMissingAxesWhereNothingHasAnError) {
  const auto lines = advice(swept({{"time integration", 0.0, "rtol"}, {"space", std::nullopt, "not run", {"grid"}}}));
  EXPECT_THAT(lines, Not(Contains(HasSubstr("largest"))));
  EXPECT_THAT(lines, Contains(HasSubstr("--axes grid measures")));
}

}  // namespace
}  // namespace polybed::multiscale
