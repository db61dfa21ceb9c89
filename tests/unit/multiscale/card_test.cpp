#include "multiscale/card/card.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace polybed::multiscale {
namespace {

// A continuum has a tail that reaches the outlet: 1e-118 of the supply is nothing, 1e-6 is something.
TEST(Card, TheTailOfAContinuumHasNotLeft) {
  Card card;
  card.seen.out = {{"resin", 1.2e-117}, {"sand", 2e-6}};
  card.seen.recovery = {{"resin", 4.7e-118}, {"sand", 1e-6}};
  const std::vector<std::string> lines = result_lines(card);
  EXPECT_NE(std::find(lines.begin(), lines.end(), card_line("has left", "resin 0 g (0 %), sand 2 mg (0.0001 %)")),
            lines.end());
}

}  // namespace
}  // namespace polybed::multiscale
