// Divides a column into blocks of cells, one for each rank.
#pragma once

#include <array>
#include <memory>

#include "core/case/scene.hpp"
#include "core/numerics/field.hpp"
#include "core/numerics/metric.hpp"

namespace polybed::core {

/// Minimum cells of a block along a divided axis: two layers of ghosts go to either side.
constexpr int least_block_cells = 4;

/// Blocks along each axis with the least surface between them. Throws CaseError if the column is too small for `count`.
[[nodiscard]] std::array<int, 3> choose_blocks(const Grid& column, int count);

/// This rank's block of a column, or the column itself for null. The second form returns the block of any rank.
[[nodiscard]] Grid block_of(const Grid& column, const std::shared_ptr<const Ranks>& ranks);
[[nodiscard]] Grid block_of(const Grid& column, const std::shared_ptr<const Ranks>& ranks, int rank);

/// The grid of the column in a case, cut by its walls inside if there is a fluid: this rank's block of it, or the whole
/// column for null. The second form is without walls inside, or with those given.
[[nodiscard]] Grid grid_of(const Scene& scene, const std::shared_ptr<const Ranks>& ranks);
[[nodiscard]] Grid grid_of(const Column& column, const std::shared_ptr<const Ranks>& ranks,
                           const InsideWalls& walls = nullptr, const Ducts& ducts = {});

/// The grid of the whole column, on one rank.
[[nodiscard]] Grid whole_column(const Grid& block);

/// The rank that owns the block next to this one, across joined sides too; -1 where the column ends.
[[nodiscard]] int neighbour_rank(const Grid& block, int axis, int side);

/// Cells numbered from 0, rank by rank and row by row: numbers of the owned cells and of the cells next to them across
/// block borders and joined sides; -1 beyond the column's ends. Collective.
[[nodiscard]] Field cell_numbers(const Grid& block);

}  // namespace polybed::core
