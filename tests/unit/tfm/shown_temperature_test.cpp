// The granular temperature that files show: nothing where a species is absent, and a mean over its solids.
#include <gtest/gtest.h>

#include "tfm/observers.hpp"

namespace polybed::tfm {
namespace {

core::Grid two_layers() {
  core::Grid grid;
  grid.cells = {3, 2, 1};
  grid.spacing = {0.01, 0.01, 0.002};
  return grid;
}

// By hand: (0.3 x 2 + 0.1 x 6)/(0.3 + 0.1) = 3 m2/s2 in the lower layer, whose last cell is empty; nothing above, where
// what is left of the fractions is rounding.
TEST(ShownTemperature, IsNoneWhereTheSpeciesIsAbsent) {
  const core::Grid grid = two_layers();
  core::Field phi = core::make_field(grid), theta = core::make_field(grid, 11.0);
  const auto at = [&](int i, int j) { return std::size_t(grid.index(i, j)); };
  phi[at(0, 0)] = 0.3;
  phi[at(1, 0)] = 0.1;
  phi[at(0, 1)] = -3e-156;
  phi[at(1, 1)] = 0.9e-6;
  theta[at(0, 0)] = 2;
  theta[at(1, 0)] = 6;
  const core::Field shown = shown_temperature(phi, theta);
  EXPECT_EQ(shown[at(0, 0)], 2);
  EXPECT_EQ(shown[at(1, 0)], 6);
  for (const std::size_t cell : {at(2, 0), at(0, 1), at(1, 1), at(2, 1)}) EXPECT_EQ(shown[cell], 0);
  const std::vector<double> mean = mean_temperature(grid, phi, shown);
  ASSERT_EQ(mean.size(), 2U);
  EXPECT_DOUBLE_EQ(mean[0], 3);
  EXPECT_EQ(mean[1], 0);
}

}  // namespace
}  // namespace polybed::tfm
