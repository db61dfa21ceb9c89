#include "closures/max_packing.hpp"

#include <gtest/gtest.h>

#include <array>

namespace polybed::closures {
namespace {

using Two = std::array<double, 2>;

// P = 0.62, r = 0.4, x_1 = 0.5. Fedors-Landel: a = 0.62 + 0.38 0.62 = 0.8556, P_1/a = 0.7246 > 0.5:
// 0.62 + (1 - 0.632456) 0.2356 0.8556 0.5/0.62 = 0.67975. Yu-Standish: p = 0.62 + 0.2356 0.276 = 0.685026; for the fine
// size X = 0.84/1.38: 0.62/[1 - 0.094925 0.5/0.608696] = 0.67243; for the coarse 0.7056. By hand.
TEST(MaxPacking, OfTwoSizesByHand) {
  const Two diameter{1.0, 0.4}, packing{0.62, 0.62}, half{0.5, 0.5};
  EXPECT_NEAR(packing_fedors_landel(half, diameter, packing), 0.67975, 5e-6);
  EXPECT_NEAR(packing_yu_standish(half, diameter, packing), 0.67243, 5e-6);
}

TEST(MaxPacking, OfOneSizeIsItsOwn) {
  const Two diameter{1.0, 0.4}, packing{0.62, 0.60};
  for (const auto& law : {packing_fedors_landel, packing_yu_standish}) {
    EXPECT_NEAR(law(Two{1, 0}, diameter, packing), 0.62, 1e-12);
    EXPECT_NEAR(law(Two{0, 1}, diameter, packing), 0.60, 1e-12);
  }
}

TEST(MaxPacking, OrderOfSizesDoesNotMatter) {
  for (const auto& law : {packing_fedors_landel, packing_yu_standish})
    EXPECT_EQ(law(Two{0.3, 0.7}, Two{1.0, 0.4}, Two{0.62, 0.60}), law(Two{0.7, 0.3}, Two{0.4, 1.0}, Two{0.60, 0.62}));
}

// A mixture packs no looser than its sizes alone, and continuously with the composition.
TEST(MaxPacking, IsNoLooserThanEachSizeAndContinuous) {
  const Two diameter{1.0, 0.3}, packing{0.62, 0.62};
  for (const auto& law : {packing_fedors_landel, packing_yu_standish}) {
    double before = 0.62;
    for (double x = 0; x <= 1; x += 0.001) {
      const double now = law(Two{x, 1 - x}, diameter, packing);
      EXPECT_GE(now, 0.62 - 1e-12) << x;
      EXPECT_LT(std::abs(now - before), 2e-3) << x;
      before = now;
    }
  }
}

// Equal sizes under two names are one size.
TEST(MaxPacking, EqualSizesGainNothing) {
  EXPECT_NEAR(packing_yu_standish(std::array{0.2, 0.3, 0.5}, std::array{1.0, 1.0, 1.0}, std::array{0.6, 0.6, 0.6}), 0.6,
              0.0025);
}

}  // namespace
}  // namespace polybed::closures
