// What every column of cut cells has to keep, for tests of the metric of even and of tapered ones.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/numerics/metric.hpp"
#include "core/numerics/operators.hpp"

namespace polybed::core::checks {

/// The divergence of any flux sums to 0 over the column, to round-off: what leaves one cell enters the next, and
/// nothing passes the wall.
inline void expect_conserving(const Grid& grid) {
  FaceField flux = make_face_field(grid);
  for (int a = 0; a < grid.dimensions; ++a)
    for_each_row(grid, interior_faces(grid, a), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f) flux[std::size_t(a)][std::size_t(f)] = std::sin(0.7 * double(f * (a + 1)));
    });
  Field rate = make_field(grid);
  divergence(grid, flux, rate);
  double sum = 0, size = 0;
  for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      sum += grid.metric->volume[c] * rate[c];
      size += grid.metric->volume[c] * std::abs(rate[c]);
    }
  });
  EXPECT_LT(std::abs(sum), 1e-13 * size);
  EXPECT_GT(size, 1);
}

/// A block of a column has the metric of its part of the whole, halo included; walls from the first inner layer on.
inline void expect_part_of(const Grid& grid, const Metric& whole, const Grid& part, const Metric& block) {
  const int deep = grid.dimensions == 3 ? 2 : 0;
  for (int k = -deep; k < part.cells[2] + deep; ++k)
    for (int j = -2; j < part.cells[1] + 2; ++j)
      for (int i = -2; i < part.cells[0] + 2; ++i) {
        const auto here = std::size_t(part.index(i, j, k)),
                   there = std::size_t(grid.index(i + part.before[0], j + part.before[1], k));
        EXPECT_EQ(block.volume[here], whole.volume[there]);
        for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a) {
          EXPECT_EQ(block.open[a][here], whole.open[a][there]);
          if (i > -2 && j > -2 && k > -deep - (deep == 0)) {
            EXPECT_EQ(block.wall[a][here], whole.wall[a][there]);
          }
        }
      }
}

}  // namespace polybed::core::checks
