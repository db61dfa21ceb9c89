// The slab of a bed: its integral, and both ways to the pressure in it where they are known to agree.
#include "multiscale/calibrate/slab.hpp"

#include <gtest/gtest.h>

namespace polybed::multiscale {
namespace {

// Place 3, deviation 2, cut at 1: Phi(-1) = 0.1586553 lies below. At 3 the rest holds 0.3413447/0.8413447 = 0.4057132
// and the weight is 0.3989423/(2 x 0.8413447) = 0.2370861.
TEST(Slab, IntegralAndWeightByHand) {
  const Slab slab{3, 2, 1};
  EXPECT_EQ(slab.below(1), 0);
  EXPECT_NEAR(slab.below(3), 0.4057132, 1e-7);
  EXPECT_NEAR(slab.below(1e3), 1, 1e-15);
  EXPECT_NEAR(slab.weight(3), 0.2370861, 1e-7);
  EXPECT_NEAR((slab.below(2.001) - slab.below(1.999)) / 0.002, slab.weight(2), 1e-7);  // its slope
}

// Sixteen spheres of weight 1 and diameter 1, one on another: the contact at height i bears 16 - i. Its virial, a
// length of 1 times that, is taken where the contact is, and the balance from the centres above the slab. Sums over
// layers stand for integrals: the ends of the midpoint rule, 1/24 of a slope of force and weight of about 0.6, are 0.3
// % of 9.
TEST(Slab, ContactsAndBalanceOfAStackAgree) {
  for (const double place : {2.0, 4.0, 6.0}) {
    const Slab slab{place, 3, 0.5};
    double contacts = 0, balance = 0;
    for (int i = 1; i < 16; ++i) contacts += (16 - i) * slab.weight(i);
    for (int i = 0; i < 16; ++i) balance += slab.below(i + 0.5);
    EXPECT_NEAR(balance / contacts, 1, 0.005) << place;
  }
}

}  // namespace
}  // namespace polybed::multiscale
