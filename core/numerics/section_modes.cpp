#include "core/numerics/section_modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/numerics/metric.hpp"
#include "core/vectors.hpp"

namespace polybed::core {

namespace {

constexpr int most_of_a_quarter = 400;

/// Open areas of all faces for the equation, in layers of one height.
FaceField open_faces(const Grid& column) {
  FaceField open = make_face_field(column, 1);
  weigh_faces(column, open);
  for (std::size_t f = 0; column.layers && f < open[1].size(); ++f) {
    open[0][f] *= column.metric->per_length[1][f];
    open[1][f] /= column.metric->per_distance[1][f];
    open[2][f] *= column.metric->per_length[1][f];
  }
  return open;
}

/// Less differs only by round-off, and by what closed faces keep.
constexpr double alike = 1e-8;

/// out = in A: rows of n numbers times an n by n matrix. Takes four rows of A at a time, for eight rows of numbers,
/// which stay in registers. Eigen's product takes ten times the instructions at the width of all processors.
void multiply_rows(const double* in, const double* matrix, Index n, Index rows, Index pitch, double* out) {
  constexpr Index block = 8;
  for (Index first = 0; first < rows; first += block) {
    const Index last = std::min(rows, first + block);
    for (Index row = first; row < last; ++row) std::fill_n(out + row * pitch, n, 0.0);
    Index k = 0;
    for (; k + 4 <= n; k += 4) {
      const double *a = matrix + k * n, *b = a + n, *c = b + n, *d = c + n;
      for (Index row = first; row < last; ++row) {
        const double* x = in + row * pitch + k;
        const double xa = x[0], xb = x[1], xc = x[2], xd = x[3];
        double* y = out + row * pitch;
#pragma GCC ivdep
        for (Index i = 0; i < n; ++i) y[i] += (a[i] * xa + b[i] * xb) + (c[i] * xc + d[i] * xd);
      }
    }
    for (; k < n; ++k)
      for (Index row = first; row < last; ++row) {
        const double x = in[row * pitch + k];
        double* y = out + row * pitch;
#pragma GCC ivdep
        for (Index i = 0; i < n; ++i) y[i] += matrix[k * n + i] * x;
      }
  }
}

/// Value of an even or odd mode, of length 1 over a pair of mirror images, in a cell.
double share(bool odd, int i, int cells) {
  const int mirror = cells - 1 - i;
  if (i == mirror) return odd ? 0 : 1;
  return odd && i > mirror ? -1 / std::numbers::sqrt2 : 1 / std::numbers::sqrt2;
}

}  // namespace

bool SectionModes::serves(const Grid& column) {
  const auto [nx, ny, nz] = column.cells;
  if (!column.metric || !column.metric->cut() || ((nx + 1) / 2) * ((nz + 1) / 2) > most_of_a_quarter) return false;
  const FaceField open = open_faces(column);
  for (std::size_t a = 0; a < 3; ++a)
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
          if (std::abs(open[a][std::size_t(column.index(i, j, k))] - open[a][std::size_t(column.index(i, 1, k))]) >
              alike)
            return false;
  return true;
}

SectionModes::SectionModes(const Grid& column)
    : grid_(column),
      half_x_((column.cells[0] + 1) / 2),
      half_z_((column.cells[2] + 1) / 2),
      quarter_(half_x_ * half_z_),
      rates_(std::size_t(4 * quarter_)) {
  const auto [nx, ny, nz] = grid_.cells;
  const FaceField open = open_faces(grid_);
  const int row = std::min(1, ny - 1);  // its low faces along y lie between cells
  for (std::size_t kind = 0; kind < 4; ++kind) {
    Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(quarter_, quarter_);
    Eigen::VectorXd volume = Eigen::VectorXd::Zero(quarter_);
    const auto weight = [&, nx = nx, nz = nz](int i, int k) {
      return share(kind % 2 == 1, i, nx) * share(kind / 2 == 1, k, nz);
    };
    const auto place = [&, nx = nx, nz = nz](int i, int k) {
      return Eigen::Index(std::min(i, nx - 1 - i)) + half_x_ * std::min(k, nz - 1 - k);
    };
    const auto add_face = [&](double alpha, int i, int k, int next_i, int next_k) {
      const auto a = place(i, k), b = place(next_i, next_k);
      const double here = weight(i, k), there = weight(next_i, next_k);
      differences(a, a) += alpha * here * here;
      differences(b, b) += alpha * there * there;
      differences(a, b) -= alpha * here * there;
      differences(b, a) -= alpha * here * there;
    };
    for (int k = 0; k < nz; ++k)
      for (int i = 0; i < nx; ++i) {
        const auto c = std::size_t(grid_.index(i, row, k));
        const double wx = 1 / (grid_.spacing[0] * grid_.spacing[0]), wz = 1 / (grid_.spacing[2] * grid_.spacing[2]);
        volume[place(i, k)] += open[1][c] * weight(i, k) * weight(i, k);
        if (i > 0) add_face(wx * open[0][c], i - 1, k, i, k);
        if (k > 0) add_face(wz * open[2][c], i, k - 1, i, k);
      }
    // Odd modes vanish in the middle: their entry there is isolated and not part of a field.
    const Eigen::VectorXd scale = (volume.array() > 0).select(volume, 1).cwiseInverse().cwiseSqrt();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> found(scale.asDiagonal() * differences * scale.asDiagonal());
    modes_[kind] = scale.asDiagonal() * found.eigenvectors();
    turned_[kind] = modes_[kind].transpose();
    for (Eigen::Index m = 0; m < quarter_; ++m)
      rates_[kind * std::size_t(quarter_) + std::size_t(m)] = std::max(found.eigenvalues()[m], 0.0);
  }
}

void SectionModes::to_modes(const Field& cells, Matrix& work, Matrix& modes) const {
  const auto [nx, ny, nz] = grid_.cells;
  for (int j = 0; j < ny; ++j)
    for (int k = 0; k < half_z_; ++k) {
      const double* front = cells.data() + grid_.index(0, j, k);
      const double* back = cells.data() + grid_.index(0, j, nz - 1 - k);
      double* to = work.data() + j * work.cols() + k * half_x_;
      for (int i = 0; i < half_x_; ++i) {
        const int mirror = nx - 1 - i;
        const double scale =
            share(false, i, nx) * share(false, k, nz) * (i == mirror ? 0.5 : 1.0) * (k == nz - 1 - k ? 0.5 : 1.0);
        const double a = front[i] + front[mirror], b = back[i] + back[mirror];
        const double c = front[i] - front[mirror], d = back[i] - back[mirror];
        to[i] = scale * (a + b);
        to[i + quarter_] = scale * (c + d);
        to[i + 2 * quarter_] = scale * (a - b);
        to[i + 3 * quarter_] = scale * (c - d);
      }
    }
  for (std::size_t kind = 0; kind < 4; ++kind) {
    const Index first = Index(kind) * quarter_;
    in_vectors<multiply_rows>(work.data() + first, modes_[kind].data(), quarter_, work.rows(), work.cols(),
                              modes.data() + first);
  }
}

void SectionModes::to_cells(const Matrix& modes, Matrix& work, Field& cells) const {
  for (std::size_t kind = 0; kind < 4; ++kind) {
    const Index first = Index(kind) * quarter_;
    in_vectors<multiply_rows>(modes.data() + first, turned_[kind].data(), quarter_, work.rows(), work.cols(),
                              work.data() + first);
  }
  const auto [nx, ny, nz] = grid_.cells;
  for (int j = 0; j < ny; ++j)
    for (int k = 0; k < half_z_; ++k) {
      double* front = cells.data() + grid_.index(0, j, k);
      double* back = cells.data() + grid_.index(0, j, nz - 1 - k);
      const double* from = work.data() + j * work.cols() + k * half_x_;
      for (int i = 0; i < half_x_; ++i) {
        const double scale = share(false, i, nx) * share(false, k, nz);
        const double a = from[i] + from[i + 2 * quarter_], b = from[i] - from[i + 2 * quarter_];
        const double c = from[i + quarter_] + from[i + 3 * quarter_], d = from[i + quarter_] - from[i + 3 * quarter_];
        front[i] = scale * (a + c);
        front[nx - 1 - i] = scale * (a - c);
        back[i] = scale * (b + d);
        back[nx - 1 - i] = scale * (b - d);
      }
    }
}

}  // namespace polybed::core
