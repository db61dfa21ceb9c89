#include "tfm/stress_share.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tfm/model.hpp"

namespace polybed {
namespace {

using core::Index;

/// Two species in a row of cells of their own.
struct Row {
  tfm::Constants constants;
  std::unique_ptr<tfm::Fields> fields;
  Index stride = 0, face = 0;

  Row(const std::vector<double>& first, const std::vector<double>& second) {
    constants.grid.dimensions = 2;
    constants.grid.cells = {1, 4, 1};
    constants.grid.spacing = {1, 1, 1};
    constants.diameter = {1e-3, 1e-3};
    constants.bed_share = {0.5, 0.5};
    constants.density = {2000, 10};
    fields = std::make_unique<tfm::Fields>(constants);
    stride = constants.grid.stride(1);
    face = constants.grid.index(0, 2);
    for (int k = 0; k < 4; ++k) {
      fields->solids.fraction[0][std::size_t(constants.grid.index(0, k))] = first[std::size_t(k)];
      fields->solids.fraction[1][std::size_t(constants.grid.index(0, k))] = second[std::size_t(k)];
    }
    tfm::composition(constants, *fields);
  }
  /// Force on each species over grad p_s: phi_j/phi times its factor.
  [[nodiscard]] std::array<double, 2> forces(double rise) const {
    tfm::StressShare share(constants, *fields);
    const auto& factor = share.at(face, stride, rise);
    std::array<double, 2> force{};
    double all = 0;
    for (std::size_t j = 0; j < 2; ++j) {
      const core::Field& q = fields->solids.fraction[j];
      force[j] = 0.5 * (q[std::size_t(face)] + q[std::size_t(face - stride)]);
      all += force[j];
    }
    return {force[0] * factor[0] / all, force[1] * factor[1] / all};
  }
};

// Packed with one species below, the other above: by the mean of both cells 0.3/0.95 of the force would be on the one
// that is not there. What is left of it is its floor, 0.5e-4 of 0.6501, and the force is grad p_s whole.
TEST(StressShare, IsThatOfWhatIsPacked) {
  const Row row({0.65, 0.65, 0, 0}, {0, 0, 0.3, 0.3});
  const auto from_below = row.forces(-1);
  EXPECT_NEAR(from_below[1], 0.5e-4 / 0.6501, 1e-6);
  EXPECT_DOUBLE_EQ(from_below[0] + from_below[1], 1);
  const auto from_above = row.forces(1);
  EXPECT_NEAR(from_above[0], 0.5e-4 / 0.3001, 1e-6);
  EXPECT_DOUBLE_EQ(from_above[0] + from_above[1], 1);
}

// Of an even composition each bears its part of the volume, whatever the fractions, to round-off.
TEST(StressShare, IsByVolumeWhereCompositionIsEven) {
  const Row row({0.2, 0.25, 0.3, 0.1}, {0.2, 0.25, 0.3, 0.1});
  for (const double rise : {-1.0, 1.0}) {
    EXPECT_NEAR(row.forces(rise)[0], 0.5, 1e-15);
    EXPECT_NEAR(row.forces(rise)[1], 0.5, 1e-15);
  }
}

// Nothing on either side, and less than nothing: a number all the same.
TEST(StressShare, IsFiniteWithoutSolids) {
  for (const double little : {0.0, -1e-5}) {
    const Row row({0.6, little, little, 0}, {0, little, little, 0});
    tfm::StressShare share(row.constants, *row.fields);
    EXPECT_EQ(share.at(row.face, row.stride, 1)[0], 1);
    EXPECT_EQ(share.at(row.face, row.stride, 1)[1], 1);
  }
}

// The bound on the half slope: none where no fraction is below 0; beside a deficit of 4 (in 1e-5) a cell with 1 gives
// at most twice what it has, where with half the slope it would be 3.5; a cell in deficit gives itself.
TEST(FractionFace, TakesNoMoreThanTheCellHas) {
  const auto at = [](std::vector<double> q, double u) { return tfm::LimitedFractionFace::at(q.data(), 2, 1, u); };
  const std::vector<double> sound{0.1, 0.3, 0.4, 0.2};
  EXPECT_EQ(at(sound, 1), core::LimitedFace::at(sound.data(), 2, 1, 1));
  EXPECT_EQ(at(sound, -1), core::LimitedFace::at(sound.data(), 2, 1, -1));
  EXPECT_GT(core::LimitedFace::at(std::vector<double>{-4e-5, 1e-5, 0.3, 0.3}.data(), 2, 1, 1), 3e-5);
  EXPECT_DOUBLE_EQ(at({-4e-5, 1e-5, 0.3, 0.3}, 1), 2e-5);
  EXPECT_EQ(at({-4e-5, -1e-5, 0.3, 0.3}, 1), -1e-5);
  EXPECT_EQ(at({0.3, 0.3, -1e-5, -4e-5}, -1), -1e-5);
}

}  // namespace
}  // namespace polybed
