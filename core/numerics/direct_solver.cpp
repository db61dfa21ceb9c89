#include "core/numerics/direct_solver.hpp"

#include <Eigen/Sparse>
#include <cmath>
#include <vector>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::core {

namespace {

/// Neighbour of owned cell (i, j, k) along an axis, wrapped across periodic sides; -1 outside.
Index packed_neighbour(const Grid& grid, std::array<int, 3> cell, int axis, int step) {
  const auto a = std::size_t(axis);
  cell[a] += step;
  if (cell[a] < 0 || cell[a] >= grid.cells[a]) {
    if (!grid.periodic[a]) return -1;
    cell[a] = (cell[a] + grid.cells[a]) % grid.cells[a];
  }
  return cell[0] + grid.cells[0] * (cell[1] + Index(grid.cells[1]) * cell[2]);
}

/// Sets the ghost cells next to the owned ones: 0 beyond the column's ends, else the values of their owners.
void set_ghosts(const Grid& grid, const Halo& halo, Field& p) {
  for (int d = 0; d < grid.dimensions; ++d) {
    const auto a = std::size_t(d);
    halo.exchange(std::array<Field*, 1>{&p}, d);
    for (const int side : {0, 1}) {
      if (!grid.ends(d, side)) continue;
      Box box = owned_cells(grid);
      box.lo[a] = side == 0 ? -1 : grid.cells[a];
      box.hi[a] = box.lo[a] + 1;
      for_each_row(grid, box, [&](Index begin, Index end) { std::fill(p.begin() + begin, p.begin() + end, 0.0); });
    }
  }
}

template <class Body>
void for_each_cell(const Grid& grid, Body&& body) {
  Index packed = 0;
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) body(std::array<int, 3>{i, j, k}, packed++, grid.index(i, j, k));
}

}  // namespace

double relative_residual(const Grid& grid, const Halo& halo, const std::array<std::span<const double>, 3>& coefficient,
                         std::span<const double> shift, const Field& source, Field& p) {
  set_ghosts(grid, halo, p);
  double left = 0, right = 0;
  for_each_row(grid, [&](Index begin, Index end) {
    for (Index at = begin; at < end; ++at) {
      const auto c = std::size_t(at);
      double r = source[c] - (shift.empty() ? 0.0 : shift[c] * p[c]);
      for (int d = 0; d < grid.dimensions; ++d) {
        const auto a = std::size_t(d);
        const auto step = std::size_t(grid.stride(d));
        r += (coefficient[a][c + step] * (p[c + step] - p[c]) + coefficient[a][c] * (p[c - step] - p[c])) /
             (grid.spacing[a] * grid.spacing[a]);
      }
      left += r * r;
      right += source[c] * source[c];
    }
  });
  std::array<double, 2> sums{left, right};
  add_over_ranks(grid, sums);
  return sums[1] > 0 ? std::sqrt(sums[0] / sums[1]) : std::sqrt(sums[0]);
}

bool leaves_constant_open(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                          std::span<const double> shift) {
  if (!shift.empty()) return false;
  bool open = true;
  for (int d = 0; d < grid.dimensions; ++d) {
    const auto a = std::size_t(d);
    for (const int side : {0, 1}) {
      if (!grid.ends(d, side)) continue;
      Box box = owned_cells(grid);
      box.lo[a] = side == 0 ? 0 : grid.cells[a];
      box.hi[a] = box.lo[a] + 1;
      for_each_row(grid, box, [&](Index begin, Index end) {
        for (Index f = begin; f < end; ++f) open = open && coefficient[a][std::size_t(f)] == 0;
      });
    }
  }
  return on_all_ranks(grid, open);
}

namespace {

/// The place in this block; nothing if another block contains it.
std::optional<std::array<int, 3>> place_of_pin(const Grid& grid) {
  std::array<int, 3> place{};
  if (grid.metric && grid.metric->shape == ColumnShape::cylinder)
    for (const int axis : {0, 2}) place[std::size_t(axis)] = grid.column_cells(axis) / 2;
  for (std::size_t a = 0; a < 3; ++a) {
    place[a] -= grid.before[a];
    if (place[a] < 0 || place[a] >= grid.cells[a]) return std::nullopt;
  }
  return place;
}

}  // namespace

std::optional<Pin> pin_of(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                          std::span<const double> shift) {
  const bool open = leaves_constant_open(grid, coefficient, shift);
  const auto place = place_of_pin(grid);
  if (!open || !place) return std::nullopt;
  const Index cell = grid.index((*place)[0], (*place)[1], (*place)[2]);
  double diagonal = 0;
  for (int d = 0; d < grid.dimensions; ++d) {
    const auto a = std::size_t(d);
    diagonal += (coefficient[a][std::size_t(cell)] + coefficient[a][std::size_t(cell + grid.stride(d))]) /
                (grid.spacing[a] * grid.spacing[a]);
  }
  return Pin{cell, diagonal};
}

bool solve_directly(const Grid& grid, const std::array<std::span<const double>, 3>& coefficient,
                    std::span<const double> shift, const Field& source, Field& p) {
  const std::optional<Pin> pin = pin_of(grid, coefficient, shift);
  Index pinned = -1;  // among the packed cells
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right(Eigen::Index(grid.cell_count()));
  for_each_cell(grid, [&](const std::array<int, 3>&, Index packed, Index at) {
    if (pin && at == pin->cell) pinned = packed;
  });
  for_each_cell(grid, [&](const std::array<int, 3>& cell, Index packed, Index at) {
    const auto c = std::size_t(at);
    right[packed] = packed == pinned ? 0 : source[c];
    double diagonal = shift.empty() ? 0.0 : shift[c];
    for (int d = 0; d < grid.dimensions; ++d) {
      const auto a = std::size_t(d);
      const double w = 1 / (grid.spacing[a] * grid.spacing[a]);
      for (int side = 0; side < 2; ++side) {
        const double value = w * coefficient[a][c + std::size_t(side * grid.stride(d))];
        const Index n = packed_neighbour(grid, cell, d, side == 0 ? -1 : 1);
        diagonal += value;
        if (n >= 0 && n != pinned && packed != pinned) entries.emplace_back(int(packed), int(n), -value);
      }
    }
    entries.emplace_back(int(packed), int(packed), diagonal);
  });
  Eigen::SparseMatrix<double> matrix(right.size(), right.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  if (factor.info() != Eigen::Success) return false;
  const Eigen::VectorXd solution = factor.solve(right);
  for_each_cell(grid,
                [&](const std::array<int, 3>&, Index packed, Index at) { p[std::size_t(at)] = solution[packed]; });
  return solution.allFinite();
}

}  // namespace polybed::core
