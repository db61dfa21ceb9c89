// Mean velocities of particles in cells, by hand.
#include "dem/coupling/fluid_output.hpp"

#include <gtest/gtest.h>

#include "core/numerics/blocks.hpp"

namespace polybed::dem {
namespace {

/// 4 x 4 cells of 1 cm with walls, 1 cm deep.
core::Grid small_grid() {
  core::Column column;
  column.size = {0.04, 0.04, 0.01};
  column.cells = {4, 4, 1};
  return core::grid_of(column, nullptr);
}

struct Two {
  std::vector<std::int64_t> id{0, 1};
  std::vector<std::int32_t> species{0, 0};
  std::vector<double> radius{1e-3, 2e-3};
  std::vector<Vector> position{{0.015, 0.015, 0.005}, {0.02, 0.015, 0.005}}, velocity{{0.1, 0.2, 5}, {-0.3, 0.4, 5}},
      spin{{}, {}};
  [[nodiscard]] core::ParticleSnapshot view() const { return {id, species, radius, position, velocity, spin}; }
};

TEST(MeanVelocities, AreWeightedByVolumeAndByNearness) {
  const core::Grid grid = small_grid();
  const auto mean = mean_velocities(grid, fluid::Smoothing(grid, 0, false), Two().view(), 2);
  const auto at = [&](std::size_t j, std::size_t axis, int x, int y) {
    return mean[j][axis][std::size_t(grid.index(x, y, 0))];
  };
  // The first stands in the middle of cell (1, 1), all of it there; of the second, of eightfold volume, half is there
  // and half in (2, 1): (1 * 0.1 - 4 * 0.3)/5 and (1 * 0.2 + 4 * 0.4)/5.
  EXPECT_NEAR(at(0, 0, 1, 1), -0.22, 1e-15);
  EXPECT_NEAR(at(0, 1, 1, 1), 0.36, 1e-15);
  EXPECT_NEAR(at(0, 0, 2, 1), -0.3, 1e-15);
  EXPECT_EQ(at(0, 0, 3, 1), 0);
  EXPECT_EQ(at(1, 0, 1, 1), 0);  // none of the second species
}

TEST(MeanVelocities, OfAKernelKeepTheVolumeFlux) {
  const core::Grid grid = small_grid();
  const fluid::Smoothing smoothing(grid, 0.02, false);
  const auto plain = mean_velocities(grid, fluid::Smoothing(grid, 0, false), Two().view(), 1);
  const auto mean = mean_velocities(grid, smoothing, Two().view(), 1);
  // The volumes, 1 + 4 and 4 in units of the first's, smoothed as the velocities' sums are.
  core::Field volume = core::make_field(grid);
  volume[std::size_t(grid.index(1, 1, 0))] = 5;
  volume[std::size_t(grid.index(2, 1, 0))] = 4;
  smoothing.smooth_cells(volume);
  double flux = 0;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      flux += volume[std::size_t(grid.index(x, y, 0))] * mean[0][1][std::size_t(grid.index(x, y, 0))];
  EXPECT_NEAR(flux, 1 * 0.2 + 8 * 0.4, 1e-13);  // rounding of 16 cells
  EXPECT_NE(mean[0][1][std::size_t(grid.index(3, 3, 0))], 0);
  EXPECT_EQ(plain[0][1][std::size_t(grid.index(3, 3, 0))], 0);
}

}  // namespace
}  // namespace polybed::dem
