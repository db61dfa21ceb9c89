#include "multiscale/cost/refinement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace polybed::multiscale {
namespace {

using ::testing::HasSubstr;

// Exact powers: f = 1 + h^p at h = 1, 1/3, 1/9 has the limit 1 whatever the safety.
TEST(Refinement, FindsOrderAndLimitOfAPower) {
  for (const double p : {1.0, 2.0}) {
    const Refined r = refine({1 + 1, 1 + std::pow(3, -p), 1 + std::pow(9, -p), 3, 2});
    EXPECT_NEAR(*r.order, p, 1e-12);
    EXPECT_NEAR(r.limit, 1, 1e-12);
  }
}

// f = 1 + h^3 under a scheme of order 1: order 3 is beyond 1.5, so F_s = 3 with p = 1: the band is 3 (1/8 - 1/64).
TEST(Refinement, AnOrderThatIsNotTheSchemesIsTrustedLess) {
  const Refined r = refine({2, 1 + 1.0 / 8, 1 + 1.0 / 64, 2, 1});
  EXPECT_NEAR(*r.order, 3, 1e-12);
  EXPECT_EQ(r.safety, 3);
  EXPECT_NEAR(r.band, 3 * (1.0 / 8 - 1.0 / 64), 1e-12);
  EXPECT_THAT(r.note, HasSubstr("not that of the scheme"));
  const Refined slow = refine({1 + 1, 1 + 0.9, 1 + 0.82, 2, 2});  // p = ln(0.1/0.08)/ln 2 = 0.32
  EXPECT_NEAR(*slow.order, 0.3219, 1e-4);
  EXPECT_EQ(slow.safety, 3);
}

// K12: a sequence that swings, or that parts, has no index; three times half of its range is told in its place.
TEST(Refinement, AScatteredSequenceHasNoIndex) {
  const Refined r = refine({1.0, 1.2, 1.1, 2, 2});
  EXPECT_FALSE(r.order || r.fine_index || r.coarse_index);
  EXPECT_NEAR(r.band, 0.3, 1e-12);
  EXPECT_THAT(r.note, HasSubstr("asymptotic range"));
  EXPECT_FALSE(refine({1.0, 1.1, 1.3, 2, 2}).fine_index);
  EXPECT_EQ(refine({1.0, 1.0, 1.0, 2, 2}).band, 0);
  EXPECT_THROW((void)refine({1, 2, 3, 1.2, 2}), std::invalid_argument);
}

}  // namespace
}  // namespace polybed::multiscale
