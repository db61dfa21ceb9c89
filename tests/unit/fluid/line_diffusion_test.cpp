// One implicit step of diffusion along a line, by hand.
#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "fluid/smoothing.hpp"

namespace polybed::fluid {
namespace {

// Entries of volume 1, 2 and 4, with faces of 1 and 3 between: (V + L) x = V b by hand, for b = (1, 0, 0). V + L is
// ((2, -1, 0), (-1, 6, -3), (0, -3, 7)), of determinant 59.
TEST(LineDiffusion, SolvesOneStepBetweenUnequalEntries) {
  std::vector<double> tile(std::size_t(3 * LineDiffusion::lanes), 0.0);
  tile[0] = 1;
  LineDiffusion({1, 2, 4}, {0, 1, 3}, 1, 1).apply(tile.data());
  const std::array<double, 3> expected{33.0 / 59, 7.0 / 59, 3.0 / 59};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(tile[i * LineDiffusion::lanes], expected[i], 1e-15);
}

// By hand, one step with lambda = 1: inverses of ((2, -1), (-1, 2)), of ((3, -2), (-2, 3)), where two cells meet on
// either side, and of the circulant (3, -1, -1).
TEST(LineDiffusion, SolvesOneStep) {
  const auto solve = [](int count, bool joined) {
    std::vector<double> tile(std::size_t(count * LineDiffusion::lanes), 0.0);
    tile[3] = 1;
    LineDiffusion(count, joined, 1, 1).apply(tile.data());
    std::vector<double> line;
    for (int i = 0; i < count; ++i) line.push_back(tile[std::size_t(i * LineDiffusion::lanes + 3)]);
    return line;
  };
  const std::vector<std::pair<std::vector<double>, std::vector<double>>> found_and_expected{
      {solve(2, false), {2.0 / 3, 1.0 / 3}}, {solve(2, true), {0.6, 0.4}}, {solve(3, true), {0.5, 0.25, 0.25}}};
  for (const auto& [found, expected] : found_and_expected)
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-15);
}

}  // namespace
}  // namespace polybed::fluid
