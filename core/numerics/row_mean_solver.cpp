#include "core/numerics/row_mean_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/numerics/metric.hpp"
#include "core/vectors.hpp"

namespace polybed::core {

namespace {

/// Above this the products with the waves cost more than multigrid.
constexpr int most_across = 64;

/// Limit on the ratio of the greatest to the least coefficient along a row. The iterations grow with its root; above it
/// multigrid is cheaper.
constexpr double most_contrast = 2.5;

constexpr int most_row_iterations = 20;

/// Sum of products in four interleaved partial sums along each row: the order of additions is the same for every vector
/// width.
void add_products(const double* a, const double* b, Index n, double* part) {
  Index i = 0;
  for (; i + 4 <= n; i += 4)
    for (Index k = 0; k < 4; ++k) part[k] += a[i + k] * b[i + k];
  for (Index k = 0; i < n; ++i, ++k) part[k] += a[i] * b[i];
}

double dot(const Grid& grid, const Field& a, const Field& b) {
  std::array<double, 4> part{};
  for_each_row(grid, [&](Index begin, Index end) {
    in_vectors<add_products>(a.data() + begin, b.data() + begin, end - begin, part.data());
  });
  return (part[0] + part[1]) + (part[2] + part[3]);
}

/// y += factor x or, with the factor first, x + factor y.
void add(const Grid& grid, double factor, const Field& x, Field& y) {
  for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) y[std::size_t(c)] += factor * x[std::size_t(c)];
  });
}
void scale_and_add(const Grid& grid, const Field& x, double factor, Field& y) {
  for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) y[std::size_t(c)] = x[std::size_t(c)] + factor * y[std::size_t(c)];
  });
}

/// Along one axis: adds w [low (p - p_below) + high (p - p_above)].
void add_differences(const double* b, const double* p, double w, Index s, Index n, double* out) {
  for (Index c = 0; c < n; ++c) out[c] += w * (b[c] * (p[c] - p[c - s]) + b[c + s] * (p[c] - p[c + s]));
}

}  // namespace

namespace {

bool is_tapered(const Grid& grid) { return grid.metric && grid.metric->tapered(); }
/// Whether a wall cuts cells, at every height alike.
bool is_cut_alike(const Grid& grid) { return grid.metric && grid.metric->cut() && !is_tapered(grid); }

}  // namespace

bool RowMeanSolver::serves(const Grid& grid) {
  if (grid.across[0] || grid.across[1]) return false;
  const Grid plain = PortPatch::without_ports(grid);
  if (is_cut_alike(plain)) return SectionModes::serves(plain);
  return grid.cells[0] <= most_across && grid.cells[2] <= most_across;
}

RowMeanSolver::RowMeanSolver(const Grid& grid)
    : grid_(grid),
      halo_(grid),
      up_(std::size_t(grid.cells[1] + 1)),
      diagonal_(std::size_t(grid.cells[1])),
      residual_(make_field(grid)),
      direction_(residual_),
      image_(residual_),
      preconditioned_(residual_) {
  across_[0] = across_[1] = diagonal_;
  const Grid plain = PortPatch::without_ports(grid);
  if (is_cut_alike(plain)) {
    if (plain.metric != grid.metric) ports_ = std::make_unique<PortPatch>(grid, plain);
    section_.emplace(plain);
    x_.rate = section_->rates();
    z_.rate = {0};
  } else {
    x_ = grid.metric && grid.metric->around_axis && !is_tapered(grid) ? modes_of_rings(grid) : modes_of(grid, 0);
    z_ = modes_of(grid, 2);
  }
  values_.resize(grid.cells[1] * Eigen::Index(z_.rate.size()), Eigen::Index(x_.rate.size()));
  turned_ = Matrix::Zero(values_.rows(), values_.cols());
  factor_.resize(std::size_t(values_.size()));
}

/// Cosines between walls; cosines and sines between joined sides.
RowMeanSolver::Modes RowMeanSolver::modes_of(const Grid& grid, int axis) {
  const int n = grid.cells[std::size_t(axis)];
  Modes modes{Matrix(n, n), std::vector<double>(std::size_t(n))};
  const bool joined = grid.periodic[std::size_t(axis)];
  for (int m = 0; m < n; ++m) {
    const int waves = joined ? 2 * ((m + 1) / 2) : m;  // half waves
    const double angle = std::numbers::pi * waves / n;
    modes.rate[std::size_t(m)] = axis < grid.dimensions ? 2 - 2 * std::cos(angle) : 0;
    const bool sine = joined && m % 2 == 0 && m > 0, alone = waves == 0 || (joined && waves == n);
    for (int i = 0; i < n; ++i)
      modes.waves(i, m) =
          std::sqrt((alone ? 1.0 : 2.0) / n) * (sine ? std::sin(angle * (i + 0.5)) : std::cos(angle * (i + 0.5)));
    // With an even number of joined cells the shortest wave, as a cosine, is zero at the centres.
    if (alone && waves > 0)
      for (int i = 0; i < n; ++i) modes.waves(i, m) = (i % 2 == 0 ? 1 : -1) / std::sqrt(double(n));
  }
  return modes;
}

/// Solves sum alpha (p - p_next) = rate theta p with the rings' alpha and theta.
RowMeanSolver::Modes RowMeanSolver::modes_of_rings(const Grid& grid) {
  const CrossSection& rings = grid.metric->layers.front();
  const int n = rings.width;
  Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(n, n), volume = differences;
  for (int i = 0; i < n; ++i) {
    volume(i, i) = rings.volume[std::size_t(i)];
    if (i == 0) continue;
    const double open = rings.open_x[std::size_t(i)];
    differences.block<2, 2>(i - 1, i - 1) += open * Eigen::Matrix2d{{1, -1}, {-1, 1}};
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(differences, volume);
  const Eigen::VectorXd rate = modes.eigenvalues().cwiseMax(0.0);
  return {modes.eigenvectors(), {rate.begin(), rate.end()}};
}

/// Computes means over the cells at each height; false if the coefficients at one differ too much.
bool RowMeanSolver::average(const FaceSpans& coefficient, std::span<const double> shift) {
  const auto n = grid_.cells;
  bool fine = ports_ || !is_tapered(grid_);  // no row is even at a sloping wall
  if (!fine) return false;
  double faces = 0;
  const auto mean = [&](int axis, int row) {
    const auto a = std::size_t(axis);
    std::array<int, 3> lo{0, row, 0}, hi{n[0], row + 1, n[2]};
    if (axis != 1 && !grid_.periodic[a]) lo[a] = std::min(1, n[a] - 1);  // between cells
    double sum = 0, least = INFINITY, most = 0;
    faces = 0;
    for_each_row(grid_, lo, hi, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        const double open = grid_.metric ? grid_.metric->open[a][c] : 1.0;
        if (!(open > 0)) continue;
        const double b = coefficient[a][c] / open;
        sum += b;
        ++faces;
        least = std::min(least, b);
        most = std::max(most, b);
      }
    });
    fine = fine && most <= most_contrast * least;
    return sum / (faces * grid_.spacing[a] * grid_.spacing[a]);
  };
  for (int row = 0; row <= n[1]; ++row) up_[std::size_t(row)] = mean(1, row);
  if (grid_.periodic[1]) {
    joined_ = up_.front();
    up_.front() = up_.back() = 0;
  }
  for (int row = 0; row < n[1]; ++row) {
    const auto r = std::size_t(row);
    across_[0][r] = n[0] > 1 ? mean(0, row) : 0;
    across_[1][r] = n[2] > 1 ? mean(2, row) : 0;
    if (section_)  // one mean for both directions
      across_[0][r] = 0.5 * (across_[0][r] * grid_.spacing[0] * grid_.spacing[0] +
                             across_[1][r] * grid_.spacing[2] * grid_.spacing[2]);
    for (std::vector<double>& across : across_) across[r] *= grid_.height(row) / grid_.spacing[1];
    diagonal_[r] = open_sides(coefficient, row);
    if (shift.empty()) continue;
    double sum = 0;
    for_each_row(grid_, {0, row, 0}, {n[0], row + 1, n[2]}, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) sum += shift[c];
    });
    diagonal_[r] += sum / open_cells_of_layer(grid_);
  }
  return fine;
}

/// Part of a row's mean diagonal from faces in the sides with a pressure outside.
double RowMeanSolver::open_sides(const FaceSpans& coefficient, int row) const {
  double sum = 0;
  for (const int axis : {0, 2}) {
    const auto a = std::size_t(axis);
    if (axis >= grid_.dimensions || grid_.periodic[a]) continue;
    for (const int side : {0, grid_.cells[a]}) {
      Box faces{{0, row, 0}, {grid_.cells[0], row + 1, grid_.cells[2]}};
      faces.lo[a] = side;
      faces.hi[a] = side + 1;
      for_each_row(grid_, faces, [&](Index begin, Index end) {
        for (auto f = std::size_t(begin); f < std::size_t(end); ++f)
          sum += coefficient[a][f] / (grid_.spacing[a] * grid_.spacing[a]);
      });
    }
  }
  return sum / open_cells_of_layer(grid_);
}

/// Gaussian elimination up the column, for each mode: pivot = d - up^2/(pivot below).
void RowMeanSolver::factorise() {
  const int nx = int(x_.rate.size()), ny = grid_.cells[1], nz = int(z_.rate.size());
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j) {
      const auto r = std::size_t(j);
      double* here = factor_.data() + (std::ptrdiff_t(k) * ny + j) * nx;
      const double own = diagonal_[r] + up_[r] + up_[r + 1] + across_[1][r] * z_.rate[std::size_t(k)];
      for (int m = 0; m < nx; ++m) {
        const double below = j > 0 ? up_[r] * up_[r] * here[m - nx] : 0.0;
        here[m] = 1 / (own + across_[0][r] * x_.rate[std::size_t(m)] - below);
      }
    }
}

/// Joined ends add c w w^T to each mode's matrix T, w = (1, 0, ..., 0, -1), c the coefficient between the top row and
/// the bottom row. Stores z = T^-1 w.
void RowMeanSolver::join_ends() {
  const int nx = int(x_.rate.size()), ny = grid_.cells[1], nz = int(z_.rate.size());
  values_.setZero();
  for (int k = 0; k < nz; ++k) {
    values_.row(Eigen::Index(k) * ny).array() += 1;
    values_.row(Eigen::Index(k) * ny + ny - 1).array() -= 1;
  }
  sweep_rows();
  around_.resize(std::size_t(nz) * std::size_t(nx));
  ends_ = values_;
  for (int k = 0; k < nz; ++k)
    for (int m = 0; m < nx; ++m) {
      const Eigen::Index bottom = Eigen::Index(k) * ny, top = bottom + ny - 1;
      around_[std::size_t(k) * std::size_t(nx) + std::size_t(m)] =
          joined_ / (1 + joined_ * (ends_(bottom, m) - ends_(top, m)));
    }
}

/// Solves for all modes; with joined ends by (T + c w w^T)^-1 = T^-1 - c z z^T/(1 + c w^T z) (Sherman and Morrison).
void RowMeanSolver::sweep() {
  sweep_rows();
  if (!grid_.periodic[1]) return;
  const int nx = int(x_.rate.size()), ny = grid_.cells[1], nz = int(z_.rate.size());
  for (int k = 0; k < nz; ++k)
    for (int m = 0; m < nx; ++m) {
      const Eigen::Index bottom = Eigen::Index(k) * ny, top = bottom + ny - 1;
      const double pull =
          around_[std::size_t(k) * std::size_t(nx) + std::size_t(m)] * (values_(bottom, m) - values_(top, m));
      values_.col(m).segment(bottom, ny) -= pull * ends_.col(m).segment(bottom, ny);
    }
}

/// Forward and backward substitution of all modes along unjoined rows.
void RowMeanSolver::sweep_rows() {
  const int nx = int(x_.rate.size()), ny = grid_.cells[1], nz = int(z_.rate.size());
  for (int k = 0; k < nz; ++k) {
    double* v = values_.data() + std::ptrdiff_t(k) * ny * nx;
    const double* factor = factor_.data() + std::ptrdiff_t(k) * ny * nx;
    for (int j = 0; j < ny; ++j)
      for (int m = 0; m < nx; ++m) {
        const std::ptrdiff_t at = std::ptrdiff_t(j) * nx + m;
        v[at] = (v[at] + (j > 0 ? up_[std::size_t(j)] * v[at - nx] : 0.0)) * factor[at];
      }
    for (int j = ny - 2; j >= 0; --j)
      for (int m = 0; m < nx; ++m) {
        const std::ptrdiff_t at = std::ptrdiff_t(j) * nx + m;
        v[at] += up_[std::size_t(j + 1)] * factor[at] * v[at + nx];
      }
  }
}

/// z = solution of the row-mean equation for r: transforms to waves, solves up and down the column, transforms back.
/// Next to ports z satisfies the equation itself, and r is 0 up to round-off.
void RowMeanSolver::precondition(const FaceSpans& coefficient, Field& r, Field& z) {
  if (section_) {
    if (ports_) ports_->clear(r);
    section_->to_modes(r, turned_, values_);
    sweep();
    section_->to_cells(values_, turned_, z);
    if (ports_) ports_->fill(coefficient, {}, z);
    return;
  }
  const auto [nx, ny, nz] = grid_.cells;
  double* to = turned_.data();
  for_each_row(grid_, [&](Index begin, Index end) { to = std::copy(r.begin() + begin, r.begin() + end, to); });
  values_.noalias() = turned_ * x_.waves;
  using Layers = Eigen::Map<Matrix>;
  if (nz > 1) {
    Layers(turned_.data(), nz, ny * nx).noalias() = z_.waves.transpose() * Layers(values_.data(), nz, ny * nx);
    values_.swap(turned_);
  }
  sweep();
  if (nz > 1) {
    Layers(turned_.data(), nz, ny * nx).noalias() = z_.waves * Layers(values_.data(), nz, ny * nx);
    values_.swap(turned_);
  }
  turned_.noalias() = values_ * x_.waves.transpose();
  const double* from = turned_.data();
  for_each_row(grid_, [&](Index begin, Index end) {
    std::copy(from, from + (end - begin), z.begin() + begin);
    from += end - begin;
  });
}

/// out = shift p - div(B grad p); sets the ghosts of p across joined sides.
void RowMeanSolver::apply(const FaceSpans& coefficient, std::span<const double> shift, Field& p, Field& out) {
  Field* const field = &p;
  for (int axis = 0; axis < grid_.dimensions; ++axis)
    if (grid_.periodic[std::size_t(axis)]) halo_.exchange(std::span(&field, 1), axis);
  for_each_row(grid_, [&](Index begin, Index end) {
    const auto c = std::size_t(begin);
    for (auto i = c; i < std::size_t(end); ++i) out[i] = shift.empty() ? 0.0 : shift[i] * p[i];
    for (std::size_t a = 0; a < std::size_t(grid_.dimensions); ++a)
      in_vectors<add_differences>(coefficient[a].data() + c, p.data() + c, 1 / (grid_.spacing[a] * grid_.spacing[a]),
                                  grid_.stride(int(a)), end - begin, out.data() + c);
  });
}

std::optional<int> RowMeanSolver::solve(const FaceSpans& coefficient, std::span<const double> shift,
                                        const Field& source, Field& p, double tolerance) {
  if (!average(coefficient, shift)) return std::nullopt;
  factorise();
  if (grid_.periodic[1]) join_ends();
  if (ports_ && !ports_->setup(coefficient, shift)) return std::nullopt;
  // An iteration gains a factor of 20 or more. Stopping just within the tolerance would save one iteration in some
  // solves but leave errors as large as the tolerance; multigrid ends far below it.
  constexpr double share = 0.05;
  const double enough = share * tolerance * std::sqrt(dot(grid_, source, source));
  std::fill(direction_.begin(), direction_.end(), 0.0);  // ghosts beyond the ends stay 0
  add(grid_, 1, p, direction_);
  if (ports_) {
    ports_->fill(coefficient, source, direction_);
    ports_->copy(direction_, p);
  }
  apply(coefficient, shift, direction_, image_);
  residual_ = source;
  add(grid_, -1, image_, residual_);
  double weight = 0;
  int iterations = 0;
  // At least one iteration, even from a good guess: a pressure that stays constant while all else moves is an error
  // that does not average out, and a bed at rest would respond to it.
  const auto goes_on = [&] {
    const double left = std::sqrt(dot(grid_, residual_, residual_)), round_off = 1e-14 * enough / (share * tolerance);
    return left > (iterations > 0 ? enough : round_off) && iterations < most_row_iterations;
  };
  while (goes_on()) {
    precondition(coefficient, residual_, preconditioned_);
    const double before = weight;
    weight = dot(grid_, residual_, preconditioned_);
    scale_and_add(grid_, preconditioned_, iterations == 0 ? 0.0 : weight / before, direction_);
    apply(coefficient, shift, direction_, image_);
    const double length = weight / dot(grid_, direction_, image_);
    add(grid_, length, direction_, p);
    add(grid_, -length, image_, residual_);
    ++iterations;
  }
  return iterations;
}

}  // namespace polybed::core
