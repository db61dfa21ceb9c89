#include <algorithm>
#include <array>

#include "core/numerics/blocks.hpp"
#include "core/numerics/direct_solver.hpp"
#include "core/numerics/hypre_rows.hpp"
#include "core/numerics/layer_solver.hpp"
#include "core/numerics/linear_solver.hpp"
#include "core/numerics/linear_solver_algebraic.hpp"
#include "core/numerics/ranks.hpp"
#include "core/numerics/whole_column.hpp"

namespace polybed::core {

/// Solves shift x - div(B grad x) = r: exactly with short rows, else by cycles of multigrid.
class BlockSolver::Scalar {
 public:
  explicit Scalar(const Grid& grid) {
    if (LayerSolver::serves(grid))
      layers_ = std::make_unique<LayerSolver>(grid);
    else
      multigrid_ = std::make_unique<AlgebraicCycles>(grid);
  }
  [[nodiscard]] bool setup(const FaceSpans& coefficient, std::span<const double> shift) {
    if (multigrid_) return multigrid_->setup(coefficient, shift);
    layers_->setup(coefficient, shift);
    return true;
  }
  void apply(const Field& r, Field& x, int cycles) {
    if (multigrid_)
      multigrid_->apply(r, x, cycles);
    else
      layers_->solve(r, x);
  }

 private:
  std::unique_ptr<LayerSolver> layers_;
  std::unique_ptr<AlgebraicCycles> multigrid_;
};

/// The equations of the whole column, on every rank.
struct BlockSolver::Whole {
  WholeColumn column;
  BlockSolver solver;
  std::array<FaceField, 4> coefficient;  ///< C11, C12, C21, C22
  Field slope, diagonal_p, r1, r2, p, q;

  explicit Whole(const Grid& block)
      : column(block),
        solver(column.grid()),
        slope(make_field(column.grid())),
        diagonal_p(slope),
        r1(slope),
        r2(slope),
        p(slope),
        q(slope) {
    coefficient.fill(make_face_field(column.grid()));
  }
};

BlockSolver::BlockSolver(const Grid& grid)
    : grid_(grid),
      halo_(grid),
      whole_(grid.ranks && LayerSolver::serves(whole_column(grid)) ? std::make_unique<Whole>(grid) : nullptr),
      of_p_(whole_ ? nullptr : std::make_unique<Scalar>(grid)),
      of_q_(whole_ ? nullptr : std::make_unique<Scalar>(grid)),
      c12_(make_face_field(grid)),
      rest_(make_face_field(grid)),
      share_(make_field(grid)),
      own_(make_field(grid)),
      pinned_(make_field(grid)),
      source_(make_field(grid)) {}
BlockSolver::~BlockSolver() = default;
BlockSolver::BlockSolver(BlockSolver&&) noexcept = default;
BlockSolver& BlockSolver::operator=(BlockSolver&&) noexcept = default;

bool BlockSolver::setup(const FaceSpans& c11, const FaceSpans& c12, const FaceSpans& c21, const FaceSpans& c22,
                        const Field& slope, const Field& diagonal_p, double c) {
  if (whole_) {
    std::vector<WholeColumn::Part> parts{{slope, &whole_->slope}};
    if (!diagonal_p.empty()) parts.push_back({diagonal_p, &whole_->diagonal_p});
    auto& [w11, w12, w21, w22] = whole_->coefficient;
    add_faces(c11, w11, parts);
    add_faces(c12, w12, parts);
    add_faces(c21, w21, parts);
    add_faces(c22, w22, parts);
    whole_->column.gather(parts);
    return whole_->solver.setup(spans(w11), spans(w12), spans(w21), spans(w22), whole_->slope,
                                diagonal_p.empty() ? Field() : whole_->diagonal_p, c);
  }
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const double w = 1 / (grid_.spacing[a] * grid_.spacing[a]);
    for (std::size_t f = 0; f < c12_[a].size(); ++f) {
      c12_[a][f] = w * c12[a][f];
      const double through_p = c11[a][f] > 0 ? c21[a][f] * c12[a][f] / c11[a][f] : 0;
      rest_[a][f] = std::max(c22[a][f] - through_p, 0.0);
    }
  }
  for_each_row(grid_, [&](Index begin, Index end) {
    for (auto cell = std::size_t(begin); cell < std::size_t(end); ++cell) {
      double to_p = 0, to_q = 0, stiffness = 0;
      for (int axis = 0; axis < grid_.dimensions; ++axis) {
        const auto a = std::size_t(axis);
        const double w = 1 / (grid_.spacing[a] * grid_.spacing[a]);
        for (const std::size_t face : {cell, cell + std::size_t(grid_.stride(axis))}) {
          to_p += w * c11[a][face];
          to_q += w * c21[a][face];
          stiffness += w * rest_[a][face];
        }
      }
      share_[cell] = to_p > 0 ? to_q / to_p : 0;
      constexpr double firm = 1e12;  // q is 0 to round-off where the slope is 0
      const double most = firm * (stiffness + c);
      own_[cell] = slope[cell] * most > c ? c / slope[cell] : most;
    }
  });
  std::fill(pinned_.begin(), pinned_.end(), 0.0);
  if (!diagonal_p.empty())
    pinned_ = diagonal_p;
  else if (const std::optional<Pin> pin = pin_of(grid_, c11, {}))
    pinned_[std::size_t(pin->cell)] = pin->diagonal;
  const bool fine = of_p_->setup(c11, pinned_);
  return of_q_->setup({rest_[0], rest_[1], rest_[2]}, own_) && fine;
}

void BlockSolver::apply(const Field& r1, const Field& r2, Field& p, Field& q, int cycles) {
  if (whole_) {
    whole_->column.gather({{r1, &whole_->r1}, {r2, &whole_->r2}});
    whole_->solver.apply(whole_->r1, whole_->r2, whole_->p, whole_->q, cycles);
    whole_->column.copy_cells(whole_->p, p);
    return whole_->column.copy_cells(whole_->q, q);
  }
  for_each_row(grid_, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) source_[c] = r2[c] - share_[c] * r1[c];
  });
  of_q_->apply(source_, q, cycles);
  set_beyond_ends(q);
  for_each_row(grid_, [&](Index begin, Index end) {
    std::copy(r1.begin() + begin, r1.begin() + end, source_.begin() + begin);
    for (int axis = 0; axis < grid_.dimensions; ++axis) {
      const double* c12 = c12_[std::size_t(axis)].data();
      const Index s = grid_.stride(axis);
      for (Index c = begin; c < end; ++c)
        source_[std::size_t(c)] += c12[c + s] * (q[std::size_t(c + s)] - q[std::size_t(c)]) -
                                   c12[c] * (q[std::size_t(c)] - q[std::size_t(c - s)]);
    }
  });
  of_p_->apply(source_, p, cycles);
}

/// Sets the ghosts owned by other cells, and 0 beyond the column's ends.
void BlockSolver::set_beyond_ends(Field& q) const {
  for (int axis = 0; axis < grid_.dimensions; ++axis) {
    for (const int side : {0, 1})
      if (grid_.ends(axis, side))
        for_each_layer_row(grid_, axis, side == 0 ? -1 : grid_.cells[std::size_t(axis)],
                           [&](Index begin, Index end) { std::fill(q.begin() + begin, q.begin() + end, 0.0); });
    halo_.exchange(std::array<Field*, 1>{&q}, axis);
  }
}

}  // namespace polybed::core
