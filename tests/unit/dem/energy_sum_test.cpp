// Sums of energies that are far smaller than their unit, and the same in any order.
#include "dem/energy_sum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "dem/measures.hpp"

namespace polybed::dem {
namespace {

// A tenth of a unit a million times: cut to whole units nothing would be left. Each is kept to 2^-30.
TEST(EnergySum, KeepsWhatIsBelowItsUnit) {
  EnergySum up, down;
  for (int n = 0; n < 1'000'000; ++n) {
    up.add(0.1);
    down.add(-0.1);
  }
  EXPECT_NEAR(up.units(), 1e5, 1e6 * std::ldexp(1.0, -30));
  EXPECT_NEAR(down.units(), -1e5, 1e6 * std::ldexp(1.0, -30));
  up.add(down);
  EXPECT_NEAR(up.units(), 0, 1e6 * std::ldexp(1.0, -30)) << "cut towards zero both ways";
}

TEST(EnergySum, DoesNotDependOnTheOrder) {
  EnergySum forward, backward, first, second, at_once;
  const auto number = [](int n) { return std::sin(n) * std::exp(0.03 * (n % 1000)); };  // 1e-3 to 1e13
  std::vector<double> all;
  for (int n = 0; n < 3000; ++n) {
    all.push_back(2 * number(n));
    forward.add(number(n));
    backward.add(number(2999 - n));
    (n % 3 == 0 ? first : second).add(number(n));
  }
  first.add(second);
  at_once.add(all, 0.5);
  EXPECT_EQ(forward, backward);
  EXPECT_EQ(forward, at_once);
  EXPECT_EQ(forward, first) << "shared by ranks";
  EXPECT_EQ(forward, EnergySum(forward.whole(), forward.part())) << "through a checkpoint";
  EXPECT_EQ(EnergySum(forward.whole() - 5, forward.part() + (std::int64_t(5) << 30)), forward) << "summed by ranks";
}

// 2 J of weights at the top of the box: half of 2^-52 of it in each step, and four times where energies are summed.
TEST(EnergySum, RoundingOfPlaces) {
  EXPECT_DOUBLE_EQ(rounding_of_places(2, 0), 8 * 1.1102230246251565e-16);
  EXPECT_DOUBLE_EQ(rounding_of_places(2, 1'000'000), 2.000008 * 1.1102230246251565e-10);
  Totals totals;
  totals.kinetic = 3;
  totals.rounding = 0.5;
  EXPECT_DOUBLE_EQ(ledger_miss(totals, 1, 10), 0.15);
  EXPECT_EQ(ledger_miss(totals, 2.75, 10), 0);
}

}  // namespace
}  // namespace polybed::dem
