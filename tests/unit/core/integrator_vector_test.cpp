// Operations of the vectors that SUNDIALS computes with, against sums written out.
#include "core/numerics/integrator_vector.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "core/numerics/integrator_sundials.hpp"

namespace polybed::core {
namespace {

// 8 partial sums: below, at and beyond whole groups of entries.
class VectorOperations : public testing::TestWithParam<std::size_t> {
 protected:
  VectorOperations() : x(GetParam(), nullptr, context), y(x), z(x), mask(x) {
    for (std::size_t i = 0; i < GetParam(); ++i) {
      x.span()[i] = std::sin(double(i) + 1);
      y.span()[i] = 1.5 + std::cos(3 * double(i));
      mask.span()[i] = i % 3 == 0 ? 0 : 1;
    }
  }

  struct Copy : Vector {
    Copy(std::size_t size, const Ranks* ranks, SUNContext context) : Vector(size, ranks, context) {}
    Copy(const Copy& like) : Copy(like.span().size(), nullptr, N_Vector(like)->sunctx) {}
  };
  Context context;
  Copy x, y, z, mask;
};

// Sums of n terms in another order: n units in the last place of the sum of magnitudes, at most 2.5^2 n; and each term
// to half a unit of its first part, 2^(digits of n + 2 - 52) of the greatest.
TEST_P(VectorOperations, SumsAreThoseOfAPlainLoop) {
  const std::size_t n = GetParam();
  double dot = 0, squares = 0, masked = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double value = x.span()[i] * y.span()[i];
    dot += value;
    squares += value * value;
    masked += i % 3 == 0 ? 0 : value * value;
  }
  const double unit = std::ldexp(8.0, int(std::bit_width(n)) + 2 - 52);
  const double tolerance = double(n) * (2.2e-16 * 6.25 * double(n) + unit / 2);
  EXPECT_NEAR(N_VDotProd(x, y), dot, tolerance);
  EXPECT_NEAR(std::pow(N_VWrmsNorm(x, y), 2) * double(n), squares, tolerance);
  EXPECT_NEAR(std::pow(N_VWrmsNormMask(x, y, mask), 2) * double(n), masked, tolerance);
}

TEST_P(VectorOperations, EntriesAreThoseOfAPlainLoopToTheBit) {
  const auto expect = [&](auto&& of) {
    for (std::size_t i = 0; i < GetParam(); ++i) EXPECT_EQ(z.span()[i], of(x.span()[i], y.span()[i])) << i;
  };
  N_VProd(x, y, z);
  expect([](double a, double b) { return a * b; });
  N_VDiv(x, y, z);
  expect([](double a, double b) { return a / b; });
  N_VInv(y, z);
  expect([](double, double b) { return 1 / b; });
  N_VAbs(x, z);
  expect([](double a, double) { return std::abs(a); });
  N_VLinearSum(2, x, -3, y, z);
  expect([](double a, double b) { return 2 * a + -3 * b; });
}

INSTANTIATE_TEST_SUITE_P(Sizes, VectorOperations, testing::Values(1, 7, 8, 9, 16, 1001));

}  // namespace
}  // namespace polybed::core
