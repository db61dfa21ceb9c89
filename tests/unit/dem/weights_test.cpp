// Shares of a particle in cells and faces, T(2.9), against values by hand.
#include "dem/coupling/weights.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "cloud.hpp"

namespace polybed::dem::test {
namespace {

constexpr double round_off = 1e-14;  ///< of a few products of numbers up to 1 and of places up to 6 cells

core::Grid grid(int dimensions, bool periodic) {
  return core::grid_of(cloud_scene(dimensions, periodic).column, nullptr);
}

/// Share by entry of the grid, those of one entry added.
using Shares = std::map<core::Index, double>;

Shares cells_of(const core::Grid& g, const Vector& x) {
  Shares shares;
  for_each_cell(g.dimensions, Weights(g)(x), [&](std::size_t at, double w) { shares[core::Index(at)] += w; });
  return shares;
}

Shares faces_of(const core::Grid& g, const Vector& x, int axis) {
  Shares shares;
  for_each_face(g.dimensions, Weights(g)(x), axis, [&](std::size_t at, double w) { shares[core::Index(at)] += w; });
  return shares;
}

/// Shares that are not 0 are those expected, entry by entry.
void expect(const Shares& obtained, const Shares& expected) {
  double sum = 0;
  for (const auto& [at, share] : obtained) {
    sum += share;
    const auto found = expected.find(at);
    EXPECT_NEAR(share, found == expected.end() ? 0 : found->second, round_off) << "entry " << at;
  }
  for (const auto& [at, share] : expected) EXPECT_TRUE(obtained.contains(at)) << "entry " << at << " lacks " << share;
  EXPECT_NEAR(sum, 1, round_off);
}

// Cells of 2 mm. x = 5.5 mm: centre of cell 2 at 5 mm, d = 0.5, r = 1 - 0.25; y = 6.4 mm: centre of cell 3 at 7 mm,
// d = 0.6 towards cell 2, r = 0.7.
TEST(Weights, AreThoseOfTheTableInTwoDimensions) {
  const core::Grid g = grid(2, false);
  expect(cells_of(g, {5.5e-3, 6.4e-3, 3e-3}), {{g.index(2, 3), 0.75 * 0.7},
                                               {g.index(3, 3), 0.25 * 0.7},
                                               {g.index(2, 2), 0.75 * 0.3},
                                               {g.index(3, 2), 0.25 * 0.3}});
}

// Faces of x stand at 4 and 6 mm: shares 0.25 and 0.75; across, those of the cells.
TEST(Weights, OnFacesAreThoseOfTheirOwnStaggeredCells) {
  const core::Grid g = grid(2, false);
  expect(faces_of(g, {5.5e-3, 6.4e-3, 3e-3}, 0), {{g.index(2, 3), 0.25 * 0.7},
                                                  {g.index(3, 3), 0.75 * 0.7},
                                                  {g.index(2, 2), 0.25 * 0.3},
                                                  {g.index(3, 2), 0.75 * 0.3}});
  // Of y at 6 and 8 mm: 0.8 and 0.2.
  expect(faces_of(g, {5.5e-3, 6.4e-3, 3e-3}, 1), {{g.index(2, 3), 0.75 * 0.8},
                                                  {g.index(3, 3), 0.25 * 0.8},
                                                  {g.index(2, 4), 0.75 * 0.2},
                                                  {g.index(3, 4), 0.25 * 0.2}});
}

// z = 3.2 mm: centre of cell 1 at 3 mm, d = 0.2, r = 0.9, the rest to cell 2.
TEST(Weights, AreProductsOfThreeInThreeDimensions) {
  const core::Grid g = grid(3, false);
  Shares expected;
  for (const auto& [i, wx] : {std::pair{2, 0.75}, {3, 0.25}})
    for (const auto& [j, wy] : {std::pair{3, 0.7}, {2, 0.3}})
      for (const auto& [k, wz] : {std::pair{1, 0.9}, {2, 0.1}}) expected[g.index(i, j, k)] = wx * wy * wz;
  expect(cells_of(g, {5.5e-3, 6.4e-3, 3.2e-3}), expected);
  expected.clear();  // faces of z at 2 and 4 mm: 0.4 and 0.6
  for (const auto& [i, wx] : {std::pair{2, 0.75}, {3, 0.25}})
    for (const auto& [j, wy] : {std::pair{3, 0.7}, {2, 0.3}})
      for (const auto& [k, wz] : {std::pair{1, 0.4}, {2, 0.6}}) expected[g.index(i, j, k)] = wx * wy * wz;
  expect(faces_of(g, {5.5e-3, 6.4e-3, 3.2e-3}, 2), expected);
}

// 0.4 mm from the wall, within half a cell: what belongs beyond it comes back, so the outermost cell has all.
TEST(Weights, ComeBackFromWalls) {
  const core::Grid g = grid(2, false);
  expect(cells_of(g, {0.4e-3, 0.4e-3, 3e-3}), {{g.index(0, 0), 1.0}});
  expect(cells_of(g, {11.6e-3, 9.6e-3, 3e-3}), {{g.index(5, 4), 1.0}});
  // The face on the wall has its share, 1 - 0.4/2.
  expect(faces_of(g, {0.4e-3, 0.4e-3, 3e-3}, 0), {{g.index(0, 0), 0.8}, {g.index(1, 0), 0.2}});
  expect(faces_of(g, {11.6e-3, 9.6e-3, 3e-3}, 0), {{g.index(5, 4), 0.2}, {g.index(6, 4), 0.8}});
}

// The same place with joined sides: 0.6 mm beyond the centre of cell 0, r = 0.7, the rest on the other side.
TEST(Weights, GoOnAcrossJoinedSides) {
  const core::Grid g = grid(2, true);
  expect(cells_of(g, {0.4e-3, 0.4e-3, 3e-3}), {{g.index(0, 0), 0.7}, {g.index(5, 0), 0.3}});
  expect(cells_of(g, {11.6e-3, 0.4e-3, 3e-3}), {{g.index(5, 0), 0.7}, {g.index(0, 0), 0.3}});
  // Faces 6 and 0 are one: it has the share of the place 12 mm.
  expect(faces_of(g, {11.6e-3, 0.4e-3, 3e-3}, 0), {{g.index(5, 0), 0.2}, {g.index(0, 0), 0.8}});
}

// Between two rebuilds of the list a particle may lie a little outside a joined side, or fly above the column.
TEST(Weights, AreDefinedALittleOutside) {
  const core::Grid g = grid(3, true);
  expect(cells_of(g, {-0.1e-3, 5e-3, 3e-3}), cells_of(g, {11.9e-3, 5e-3, 3e-3}));
  expect(faces_of(g, {12.1e-3, 5e-3, 3e-3}, 0), faces_of(g, {0.1e-3, 5e-3, 3e-3}, 0));
  const core::Grid flat = grid(2, true);
  expect(cells_of(flat, {5e-3, 14e-3, 3e-3}), {{flat.index(2, 4), 1.0}});
}

// A particle that moves by a tiny step changes every share by that step over the cell at most: no jumps at faces.
/// One cell across; layers of 2, 2, 4 and 6 mm.
core::Grid graded_grid() {
  core::Column column = cloud_scene(2, false).column;
  column.layers = {2e-3, 2e-3, 4e-3, 6e-3};
  column.size[1] = 14e-3;
  column.cells = {1, 4, 1};
  return core::grid_of(column, nullptr);
}

// y = 5 mm lies a quarter up the layer from 4 to 8 mm: 2.25 layers from the bottom, 0.25 from the layer's centre.
TEST(Weights, CountGradedLayersAsCells) {
  const core::Grid g = graded_grid();
  const Vector x{0.5 * g.spacing[0], 5e-3, 0};
  expect(cells_of(g, x), {{g.index(0, 1), 0.25}, {g.index(0, 2), 0.75}});
  expect(faces_of(g, x, 1), {{g.index(0, 2), 0.75}, {g.index(0, 3), 0.25}});
}

// Places all over the column give a face its volume, the mean of both layers, and a cell an eighth of each neighbour
// and three quarters of its own: 0.125 * 2 + 0.75 * 4 + 0.125 * 6 = 4 mm.
TEST(Weights, FillFacesOfGradedLayersEvenly) {
  const core::Grid g = graded_grid();
  Shares faces, cells;
  constexpr int places = 14000;
  for (int n = 0; n < places; ++n) {
    const Vector x{0.5 * g.spacing[0], (n + 0.5) * 14e-3 / places, 0};
    for (const auto& [at, share] : faces_of(g, x, 1)) faces[at] += share * 14.0 / places;
    for (const auto& [at, share] : cells_of(g, x)) cells[at] += share * 14.0 / places;
  }
  EXPECT_NEAR(faces[g.index(0, 2)], 3, 1e-6);  // the rule's error, (1/2000)^2 of a layer at each kink
  EXPECT_NEAR(faces[g.index(0, 3)], 5, 1e-6);
  EXPECT_NEAR(cells[g.index(0, 2)], 4, 1e-6);
}

TEST(Weights, AreContinuousAcrossFaces) {
  const core::Grid g = grid(3, true);
  std::mt19937_64 random(3);
  std::uniform_int_distribution<int> cell(0, 3);
  const double step = 1e-9;
  for (int n = 0; n < 200; ++n) {
    const Vector x{2e-3 * cell(random) + (n % 2 ? 1e-3 : 0), 2e-3 * cell(random), 2e-3 * cell(random) + 1e-3};
    for (int axis = 0; axis < 3; ++axis) {
      Vector below = x, above = x;
      below[std::size_t(axis)] -= step;
      above[std::size_t(axis)] += step;
      Shares change = cells_of(g, above);
      for (const auto& [at, share] : cells_of(g, below)) change[at] -= share;
      for (const auto& [at, by] : change) EXPECT_LE(std::abs(by), 2 * step / 2e-3 + round_off) << at;
    }
  }
}

}  // namespace
}  // namespace polybed::dem::test
