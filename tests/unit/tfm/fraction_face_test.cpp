#include "tfm/fraction_face.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace polybed {
namespace {

// No bound where no fraction is below 0; beside a deficit of 4 (in 1e-5) a cell with 1 gives at most twice what it has,
// where with half the slope it would be 3.5; a cell in deficit gives itself.
TEST(FractionFace, TakesNoMoreThanTheCellHas) {
  const auto at = [](const std::vector<double>& q, double u) {
    return tfm::LimitedFractionFace::at(q.data(), 2, 1, u);
  };
  const std::vector<double> sound{0.1, 0.3, 0.4, 0.2}, deficit{-4e-5, 1e-5, 0.3, 0.3};
  EXPECT_EQ(at(sound, 1), core::LimitedFace::at(sound.data(), 2, 1, 1));
  EXPECT_EQ(at(sound, -1), core::LimitedFace::at(sound.data(), 2, 1, -1));
  EXPECT_GT(core::LimitedFace::at(deficit.data(), 2, 1, 1), 3e-5);
  EXPECT_DOUBLE_EQ(at(deficit, 1), 2e-5);
  EXPECT_EQ(at({-4e-5, -1e-5, 0.3, 0.3}, 1), -1e-5);
  EXPECT_EQ(at({0.3, 0.3, -1e-5, -4e-5}, -1), -1e-5);
}

}  // namespace
}  // namespace polybed
