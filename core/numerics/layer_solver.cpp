#include "core/numerics/layer_solver.hpp"

#include <algorithm>

#include "core/vectors.hpp"

namespace polybed::core {

namespace {

/// Above this the setup costs more than multigrid.
constexpr std::size_t widest_layer = 64;

/// The longest axis that ends in walls or openings; with joined sides the height.
int long_axis(const Grid& grid) {
  int longest = 1;
  for (const int axis : {0, 2})
    if (axis < grid.dimensions && !grid.periodic[std::size_t(axis)] &&
        grid.cells[std::size_t(axis)] > grid.cells[std::size_t(longest)])
      longest = axis;
  return longest;
}

std::size_t cells_across(const Grid& grid) {
  return grid.cell_count() / std::size_t(grid.cells[std::size_t(long_axis(grid))]);
}

/// Inverts a positive definite matrix in place, by Gauss-Jordan elimination without pivots.
void invert(double* matrix, std::size_t n, std::size_t pitch) {
  for (std::size_t k = 0; k < n; ++k) {
    double* pivot = matrix + k * pitch;
    const double per = 1 / pivot[k];
    pivot[k] = 1;
    for (std::size_t i = 0; i < pitch; ++i) pivot[i] *= per;
    for (std::size_t m = 0; m < n; ++m) {
      if (m == k) continue;
      double* row = matrix + m * pitch;
      const double factor = row[k];
      row[k] = 0;
      for (std::size_t i = 0; i < pitch; ++i) row[i] -= factor * pivot[i];
    }
  }
}

/// y += A x, A symmetric, four columns at a time.
void add_product(const double* matrix, const double* x, std::size_t n, std::size_t pitch, double* y) {
  std::size_t k = 0;
  for (; k + 4 <= n; k += 4) {
    const double *a = matrix + k * pitch, *b = a + pitch, *c = b + pitch, *d = c + pitch;
    for (std::size_t i = 0; i < pitch; ++i)
      y[i] += (a[i] * x[k] + b[i] * x[k + 1]) + (c[i] * x[k + 2] + d[i] * x[k + 3]);
  }
  for (; k < n; ++k)
    for (std::size_t i = 0; i < pitch; ++i) y[i] += matrix[k * pitch + i] * x[k];
}

}  // namespace

bool LayerSolver::serves(const Grid& grid) {
  return !grid.periodic[std::size_t(long_axis(grid))] && cells_across(grid) <= widest_layer;
}

LayerSolver::LayerSolver(const Grid& grid)
    : grid_(grid),
      axis_(long_axis(grid)),
      count_(std::size_t(grid.cells[std::size_t(axis_)])),
      width_(cells_across(grid)),
      pitch_((width_ + 7) / 8 * 8),
      inverse_(count_ * width_ * pitch_),
      joint_(count_ * pitch_),
      value_(count_ * pitch_),
      work_(pitch_) {
  Box layer = owned_cells(grid);
  layer.hi[std::size_t(axis_)] = 1;
  for_each_row(grid, layer, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) cell_.push_back(c);
  });
}

/// Adds the matrix of one layer, without its neighbours.
void LayerSolver::add_layer(std::size_t layer, const FaceSpans& coefficient, std::span<const double> shift) {
  double* matrix = inverse_of(layer);
  std::fill_n(matrix, width_ * pitch_, 0.0);
  const Index above = Index(layer) * grid_.stride(axis_);
  for (std::size_t i = 0; i < width_; ++i) {
    const auto cell = std::size_t(cell_[i] + above);
    double own = shift.empty() ? 0 : shift[cell];
    std::size_t before = 1;  // cells from one cell of the layer to its neighbour along the axis
    for (int d = 0; d < grid_.dimensions; ++d) {
      const auto a = std::size_t(d), n = std::size_t(grid_.cells[a]);
      const double w = 1 / (grid_.spacing[a] * grid_.spacing[a]);
      const double low = w * coefficient[a][cell], high = w * coefficient[a][cell + std::size_t(grid_.stride(d))];
      own += low + high;
      if (d == axis_) {
        joint_[layer * pitch_ + i] = low;
        continue;
      }
      const bool last = i / before % n == n - 1;
      if (!last || grid_.periodic[a]) {
        const std::size_t beyond = last ? i - (n - 1) * before : i + before;
        matrix[i * pitch_ + beyond] -= high;
        matrix[beyond * pitch_ + i] -= high;
      }
      before *= n;
    }
    matrix[i * pitch_ + i] += own;
  }
}

void LayerSolver::setup(const FaceSpans& coefficient, std::span<const double> shift) {
  for (std::size_t layer = 0; layer < count_; ++layer) {
    add_layer(layer, coefficient, shift);
    double* matrix = inverse_of(layer);
    if (layer > 0) {
      const double *before = inverse_of(layer - 1), *joint = joint_.data() + layer * pitch_;
      for (std::size_t i = 0; i < width_; ++i)
        for (std::size_t k = 0; k < pitch_; ++k) matrix[i * pitch_ + k] -= joint[i] * before[i * pitch_ + k] * joint[k];
    }
    in_vectors<invert>(matrix, width_, pitch_);
  }
}

void LayerSolver::solve(const Field& source, Field& p) {
  const Index step = grid_.stride(axis_);
  std::fill(value_.begin(), value_.end(), 0.0);
  for (std::size_t layer = 0; layer < count_; ++layer) {
    double* value = value_.data() + layer * pitch_;
    const double* joint = joint_.data() + layer * pitch_;
    for (std::size_t i = 0; i < width_; ++i)
      work_[i] = source[std::size_t(cell_[i] + Index(layer) * step)] + (layer > 0 ? joint[i] * (value - pitch_)[i] : 0);
    in_vectors<add_product>(inverse_of(layer), work_.data(), width_, pitch_, value);
  }
  for (std::size_t layer = count_; layer-- > 0;) {
    double* value = value_.data() + layer * pitch_;
    if (layer + 1 < count_) {
      for (std::size_t i = 0; i < width_; ++i)
        work_[i] = (joint_.data() + (layer + 1) * pitch_)[i] * (value + pitch_)[i];
      in_vectors<add_product>(inverse_of(layer), work_.data(), width_, pitch_, value);
    }
    for (std::size_t i = 0; i < width_; ++i) p[std::size_t(cell_[i] + Index(layer) * step)] = value[i];
  }
}

}  // namespace polybed::core
