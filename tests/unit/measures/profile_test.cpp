#include "measures/profile.hpp"

#include <gtest/gtest.h>

#include "core/case/grading.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/random.hpp"

namespace polybed::measures {
namespace {

// A port makes two of 8 layers wider; slabs lie across the graded layers. Sums of 500 cells.
TEST(GradedProfile, KeepsTheVolumeBesidePorts) {
  core::Column column;
  column.shape = core::ColumnShape::cylinder;
  column.dimensions = 3;
  column.size = {0.8, 1.2, 0.8};
  column.layers = core::graded_layers(1.2, 12, 0.2, 1.2);
  column.cells = {8, int(column.layers.size()), 8};
  const core::Grid grid = core::grid_of(column, nullptr, nullptr, {{0, 0, {0.2, 0.4}, {0.6, 0.6}}});
  core::Field field = core::make_field(grid);
  double volume = 0;
  core::for_each_row(grid, [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      field[c] = core::uniform(1, 0, c);
      volume += grid.metric->volume[c] * field[c] * grid.cell_volume();
    }
  });
  const std::vector<double> mean = lateral_mean(grid, field), areas = areas_of_slabs(grid);
  ASSERT_EQ(areas.size(), 12u);
  ASSERT_EQ(mean.size(), 12u);
  double sum = 0;
  for (std::size_t k = 0; k < 12; ++k) sum += mean[k] * areas[k] * grid.spacing[1];
  EXPECT_NEAR(sum / volume, 1, 1e-12);
}

}  // namespace
}  // namespace polybed::measures
