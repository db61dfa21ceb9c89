#include "core/numerics/blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "core/numerics/halo.hpp"
#include "core/numerics/metric.hpp"
#include "core/numerics/mpi.hpp"

namespace polybed::core {

namespace {

/// Area of the cuts, in faces.
double surface(const Grid& column, const std::array<int, 3>& blocks) {
  double area = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const int cuts = blocks[a] - (column.periodic[a] && blocks[a] > 1 ? 0 : 1);
    area += double(cuts) * double(column.cell_count()) / column.cells[a];
  }
  return area;
}

/// First cell of block n when cells are distributed evenly; the first blocks get one more if there is a remainder.
int first_cell(int cells, int blocks, int n) { return n * (cells / blocks) + std::min(n, cells % blocks); }

std::shared_ptr<const Layers> layers_of(const std::vector<double>& heights, double end) {
  if (heights.empty()) return nullptr;
  Layers layers{heights, {0}};
  for (const double height : layers.height) {
    const auto n = double(layers.low.size());
    const bool even = height == layers.height.front();  // the low faces are then exactly those of even cells
    layers.low.push_back(even ? n * height : layers.low.back() + height);
  }
  layers.low.back() = end;
  return std::make_shared<const Layers>(std::move(layers));
}

/// Ducts of the ports in the side of a cylinder.
Ducts ducts_of(const Scene& scene) {
  Ducts ducts;
  if (!scene.column.is_round() || scene.column.closed) return ducts;
  const auto see = [&](const auto& parts) {
    for (const auto& part : parts) {
      if (!is_side(part.at) || part.from.size() != 2 || part.to.size() != 2) continue;
      const Duct duct{axis_of(part.at), side_of(part.at), {part.from[0], part.from[1]}, {part.to[0], part.to[1]}};
      if (std::find(ducts.begin(), ducts.end(), duct) == ducts.end()) ducts.push_back(duct);
    }
  };
  see(scene.jets);
  see(scene.feeds);
  see(scene.discharges);
  return ducts;
}

}  // namespace

std::array<int, 3> choose_blocks(const Grid& column, int count) {
  std::array<int, 3> best{0, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  const auto fits = [&](std::size_t a, int blocks) {
    return blocks == 1 || column.cells[a] / blocks >= least_block_cells;
  };
  for (int i = 1; i <= count; ++i)
    for (int j = 1; count % i == 0 && j <= count / i; ++j) {
      if (count / i % j != 0) continue;
      const std::array<int, 3> blocks{i, j, count / i / j};
      if (!fits(0, blocks[0]) || !fits(1, blocks[1]) || !fits(2, blocks[2])) continue;
      if (surface(column, blocks) >= least) continue;
      least = surface(column, blocks);
      best = blocks;
    }
  if (best[0] == 0)
    throw StartError(
        fmt::format("column.cells: {} x {} x {} cells cannot be cut into {} blocks of at least {} cells "
                    "along each cut axis: use fewer ranks",
                    column.cells[0], column.cells[1], column.cells[2], count, least_block_cells));
  return best;
}

Grid block_of(const Grid& column, const std::shared_ptr<const Ranks>& ranks) {
  return ranks ? block_of(column, ranks, ranks->rank()) : column;
}

Grid block_of(const Grid& column, const std::shared_ptr<const Ranks>& ranks, int rank) {
  Grid block = column;
  block.ranks = ranks;
  block.blocks = choose_blocks(column, ranks->count());
  int rest = rank;
  for (std::size_t a = 0; a < 3; ++a) {
    block.block[a] = rest % block.blocks[a];
    rest /= block.blocks[a];
    block.before[a] = first_cell(column.cells[a], block.blocks[a], block.block[a]);
    const int end = first_cell(column.cells[a], block.blocks[a], block.block[a] + 1);
    block.cells[a] = end - block.before[a];
    block.after[a] = column.cells[a] - end;
  }
  return block;
}

Grid grid_of(const Scene& scene, const std::shared_ptr<const Ranks>& ranks) {
  const auto meets_fluid = [&](const InnerWall& wall) { return scene.fluid.present() && wall.thickness > 0; };
  const auto is_whole = [](const InnerWall& wall) { return wall.from.size() == 2 && wall.to.size() == 2; };  // a rule
  const bool cut = std::any_of(scene.walls.begin(), scene.walls.end(), meets_fluid) &&
                   std::all_of(scene.walls.begin(), scene.walls.end(), is_whole);
  try {
    return grid_of(scene.column, ranks, cut ? std::make_shared<std::vector<InnerWall>>(scene.walls) : nullptr,
                   ducts_of(scene));
  } catch (const StartError& error) {
    if (!cut) throw;
    throw StartError(std::vector{scene.places.problem({"wall.from"}, error.what())});
  }
}

Grid grid_of(const Column& column, const std::shared_ptr<const Ranks>& ranks, const InsideWalls& walls,
             const Ducts& ducts) {
  Grid grid;
  grid.dimensions = column.dimensions;
  grid.cells = column.cells;
  for (std::size_t d = 0; d < 3; ++d) grid.spacing[d] = column.cell(d);
  grid.layers = layers_of(column.layers, column.size[1]);
  for (std::size_t n : {0, 1}) grid.across[n] = layers_of(column.across[n], column.size[2 * n]);
  grid.periodic[0] = column.sides == core::Boundary::periodic;
  grid.periodic[1] = column.ends == core::Boundary::periodic;
  grid.periodic[2] = column.sides == core::Boundary::periodic && column.dimensions == 3;
  Grid block = block_of(grid, ranks);
  block.metric = metric_of(block, column.shape, column.profile, walls, ducts);
  return block;
}

Grid whole_column(const Grid& block) {
  Grid column;
  column.dimensions = block.dimensions;
  column.spacing = block.spacing;
  column.layers = block.layers;
  column.across = block.across;
  column.periodic = block.periodic;
  for (int axis = 0; axis < 3; ++axis) column.cells[std::size_t(axis)] = block.column_cells(axis);
  if (block.cells == column.cells)
    column.metric = block.metric;
  else if (block.metric)
    column.metric =
        metric_of(column, block.metric->shape, block.metric->taper, block.metric->walls, block.metric->ducts);
  return column;
}

int neighbour_rank(const Grid& block, int axis, int side) {
  if (block.ends(axis, side)) return -1;
  const auto a = std::size_t(axis);
  std::array<int, 3> there = block.block;
  there[a] = (there[a] + (side == 0 ? -1 : 1) + block.blocks[a]) % block.blocks[a];
  return there[0] + block.blocks[0] * (there[1] + block.blocks[1] * there[2]);
}

Field cell_numbers(const Grid& block) {
  double first = 0;
  const auto count = double(block.cell_count());
  if (block.ranks) {
    check_mpi(MPI_Exscan(&count, &first, 1, MPI_DOUBLE, MPI_SUM, communicator(block)), "MPI_Exscan");
    if (is_first(block.ranks.get())) first = 0;  // MPI leaves it undefined there
  }
  Field numbers = make_field(block, -1);
  for_each_row(block, [&](Index b, Index e) {
    for (Index c = b; c < e; ++c) numbers[std::size_t(c)] = first++;
  });
  const Halo halo(block);
  for (int axis = 0; axis < block.dimensions; ++axis) halo.exchange(std::array<Field*, 1>{&numbers}, axis);
  return numbers;
}

}  // namespace polybed::core
