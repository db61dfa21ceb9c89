#include "core/numerics/linear_solver.hpp"

#include <HYPRE.h>
#include <HYPRE_struct_ls.h>
#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/direct_solver.hpp"
#include "core/numerics/linear_solver_algebraic.hpp"
#include "core/numerics/mpi.hpp"
#include "core/numerics/mpi_start.hpp"
#include "core/numerics/row_mean_solver.hpp"
#include "core/numerics/whole_column.hpp"

namespace polybed::core {

namespace {

/// Above this the algebraic multigrid needs fewer.
constexpr int most_iterations = 60;

/// Above this a factorisation takes too long, above all in three dimensions.
constexpr std::size_t most_cells_of_factorisation = 20'000;

/// Cells longer than 3 to 1: at 5 to 1 the structured multigrid takes 93 iterations, the algebraic one 10.
bool long_cells(const Grid& grid) {
  double most = 0;
  for (int axis = 0; axis < grid.dimensions; ++axis)
    for (const int n : {grid.column_cells(axis) / 2, grid.column_cells(axis) - 1})
      most = std::max(most, grid.side(axis, n));
  return most > 3 * grid.smallest_spacing();
}

}  // namespace

void open_linear_solvers() {
  static const int opened = [] {
    open_mpi();
    return HYPRE_Init();
  }();
  if (opened != 0) throw NumericsError("hypre cannot be started");
}

struct PoissonSolver::Hypre {
  int dimensions;
  MPI_Comm all;
  std::array<HYPRE_Int, 3> lower{0, 0, 0}, upper{0, 0, 0};
  HYPRE_StructGrid grid = nullptr;
  HYPRE_StructStencil stencil = nullptr;
  HYPRE_StructMatrix matrix = nullptr;
  HYPRE_StructVector source = nullptr, solution = nullptr;
  HYPRE_StructSolver cg = nullptr, multigrid = nullptr;  ///< null: set up at the next solve
  int solves = 0, best = 0, spent = 0;  ///< since the setup; iterations of the first, and extra ones since
  std::vector<double> entries, packed;

  explicit Hypre(const Grid& g) : dimensions(g.dimensions), all(communicator(g)) {
    open_linear_solvers();
    std::array<HYPRE_Int, 3> period{0, 0, 0};
    for (std::size_t d = 0; d < 3; ++d) {
      lower[d] = g.before[d];
      upper[d] = g.before[d] + g.cells[d] - 1;
      if (g.periodic[d]) period[d] = g.column_cells(int(d));
    }
    HYPRE_StructGridCreate(all, dimensions, &grid);
    HYPRE_StructGridSetExtents(grid, lower.data(), upper.data());
    HYPRE_StructGridSetPeriodic(grid, period.data());
    HYPRE_StructGridAssemble(grid);
    HYPRE_StructStencilCreate(dimensions, dimensions + 1, &stencil);
    std::array<HYPRE_Int, 3> offset{0, 0, 0};
    HYPRE_StructStencilSetElement(stencil, 0, offset.data());
    for (int d = 0; d < dimensions; ++d) {
      offset = {0, 0, 0};
      offset[std::size_t(d)] = 1;
      HYPRE_StructStencilSetElement(stencil, d + 1, offset.data());
    }
    HYPRE_StructMatrixCreate(all, grid, stencil, &matrix);
    HYPRE_StructMatrixSetSymmetric(matrix, 1);
    HYPRE_StructMatrixInitialize(matrix);
    for (HYPRE_StructVector* v : {&source, &solution}) {
      HYPRE_StructVectorCreate(all, grid, v);
      HYPRE_StructVectorInitialize(*v);
    }
    entries.resize(g.cell_count() * std::size_t(dimensions + 1));
    packed.resize(g.cell_count());
  }
  ~Hypre() {
    forget();
    HYPRE_StructVectorDestroy(solution);
    HYPRE_StructVectorDestroy(source);
    HYPRE_StructMatrixDestroy(matrix);
    HYPRE_StructStencilDestroy(stencil);
    HYPRE_StructGridDestroy(grid);
  }
  Hypre(const Hypre&) = delete;
  Hypre& operator=(const Hypre&) = delete;

  void set_matrix(const Grid& g, const FaceSpans& coefficient, std::span<const double> shift) {
    std::array<double, 3> weight{};
    for (std::size_t d = 0; d < std::size_t(dimensions); ++d) weight[d] = 1 / (g.spacing[d] * g.spacing[d]);
    double* to = entries.data();
    for_each_row(g, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) {
        double* diagonal = to++;
        *diagonal = shift.empty() ? 0.0 : shift[std::size_t(c)];
        for (int d = 0; d < dimensions; ++d) {
          const auto a = std::size_t(d);
          const double low = weight[a] * coefficient[a][std::size_t(c)];
          const double high = weight[a] * coefficient[a][std::size_t(c + g.stride(d))];
          *diagonal += low + high;
          *to++ = -high;
        }
      }
    });
    drop_outward(g);
    std::array<HYPRE_Int, 4> which{0, 1, 2, 3};
    HYPRE_StructMatrixSetBoxValues(matrix, lower.data(), upper.data(), dimensions + 1, which.data(), entries.data());
    HYPRE_StructMatrixAssemble(matrix);
  }

  /// Entries beyond the column must be zero; their part of the diagonal remains (Dirichlet).
  void drop_outward(const Grid& g) {
    const auto n = g.cells;
    for (int d = 0; d < dimensions; ++d) {
      if (!g.ends(d, 1)) continue;
      Box last = owned_cells(g);
      last.lo[std::size_t(d)] = n[std::size_t(d)] - 1;
      for (int k = last.lo[2]; k < last.hi[2]; ++k)
        for (int j = last.lo[1]; j < last.hi[1]; ++j)
          for (int i = last.lo[0]; i < last.hi[0]; ++i) {
            const auto cell = std::size_t(i + n[0] * (j + n[1] * k));
            entries[cell * std::size_t(dimensions + 1) + std::size_t(d + 1)] = 0;
          }
    }
  }

  void set(HYPRE_StructVector v, const Grid& g, const Field& field) {
    double* to = packed.data();
    for_each_row(g, [&](Index begin, Index end) { to = std::copy(field.begin() + begin, field.begin() + end, to); });
    HYPRE_StructVectorSetBoxValues(v, lower.data(), upper.data(), packed.data());
    HYPRE_StructVectorAssemble(v);
  }
  void get(const Grid& g, Field& field) {
    HYPRE_StructVectorGetBoxValues(solution, lower.data(), upper.data(), packed.data());
    const double* from = packed.data();
    for_each_row(g, [&](Index begin, Index end) {
      std::copy(from, from + (end - begin), field.begin() + begin);
      from += end - begin;
    });
  }

  /// Conjugate gradients with one PFMG cycle as preconditioner; returns the iterations. The hierarchy can come from
  /// earlier coefficients, as it is only a preconditioner; it is renewed when it costs too many iterations.
  int solve(const Grid& g, const FaceSpans& coefficient, std::span<const double> shift, const Field& right, Field& p,
            double tolerance) {
    set_matrix(g, coefficient, shift);
    set(source, g, right);
    set(solution, g, p);
    if (cg == nullptr) renew();
    HYPRE_StructPCGSetTol(cg, tolerance);
    HYPRE_StructPCGSolve(cg, matrix, source, solution);
    HYPRE_Int iterations = 0;
    HYPRE_StructPCGGetNumIterations(cg, &iterations);
    get(g, p);
    return int(iterations);
  }

  void forget() {
    if (multigrid != nullptr) HYPRE_StructPFMGDestroy(multigrid);
    if (cg != nullptr) HYPRE_StructPCGDestroy(cg);
    multigrid = cg = nullptr;
  }

  /// Sets up the hierarchy for the present matrix.
  void renew() {
    forget();
    HYPRE_StructPCGCreate(all, &cg);
    HYPRE_StructPCGSetMaxIter(cg, most_iterations);
    HYPRE_StructPCGSetTwoNorm(cg, 1);
    HYPRE_StructPFMGCreate(all, &multigrid);
    HYPRE_StructPFMGSetMaxIter(multigrid, 1);
    HYPRE_StructPFMGSetTol(multigrid, 0);
    HYPRE_StructPFMGSetZeroGuess(multigrid);
    HYPRE_StructPFMGSetRelaxType(multigrid, 2);  // red-black Gauss-Seidel: a quarter fewer iterations than Jacobi
    HYPRE_StructPFMGSetRAPType(multigrid, 0);
    HYPRE_StructPCGSetPrecond(cg, HYPRE_StructPFMGSolve, HYPRE_StructPFMGSetup, multigrid);
    HYPRE_StructPCGSetup(cg, matrix, source, solution);
    solves = spent = 0;
  }

  /// Records the iterations of a solve. A setup costs as much as about four; the mean over the solves since the last
  /// one must not exceed the cost of a setup for each solve.
  void age(int iterations) {
    if (solves == 0) best = iterations;
    ++solves;
    spent += std::max(iterations - best, 0);
    constexpr int cost_of_set_up = 4;
    if (spent >= cost_of_set_up) forget();
  }
};

/// The equation of the whole column, on every rank.
struct PoissonSolver::Whole {
  WholeColumn column;
  PoissonSolver solver;
  FaceField coefficient;
  Field shift, source, p;

  explicit Whole(const Grid& block)
      : column(block),
        solver(column.grid()),
        coefficient(make_face_field(column.grid())),
        shift(make_field(column.grid())),
        source(shift),
        p(shift) {}
};

PoissonSolver::PoissonSolver(const Grid& grid) : grid_(grid), halo_(grid) {
  if (!RowMeanSolver::serves(whole_column(grid))) return;
  if (grid.ranks)
    whole_ = std::make_unique<Whole>(grid);
  else
    rows_ = std::make_unique<RowMeanSolver>(grid);
}
PoissonSolver::~PoissonSolver() = default;
PoissonSolver::PoissonSolver(PoissonSolver&&) noexcept = default;
PoissonSolver& PoissonSolver::operator=(PoissonSolver&&) noexcept = default;

namespace {

void subtract(const Grid& grid, double constant, Field& field) {
  for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) field[std::size_t(c)] -= constant;
  });
}

/// Subtracts the mean over the column from a field. \param owned  work space for the cells
void remove_mean(const Grid& grid, Field& field, std::vector<double>& owned) {
  owned.clear();
  for_each_row(grid,
               [&](Index begin, Index end) { owned.insert(owned.end(), field.begin() + begin, field.begin() + end); });
  subtract(grid, sum_of_ranks(grid, owned) / double(grid.column_cell_count()), field);
}

}  // namespace

PoissonResult PoissonSolver::solve_whole(const FaceSpans& coefficient, std::span<const double> shift,
                                         const Field& source, Field& p, double tolerance) {
  Whole& whole = *whole_;
  std::vector<WholeColumn::Part> parts{{source, &whole.source}, {p, &whole.p}};
  if (!shift.empty()) parts.push_back({shift, &whole.shift});
  add_faces(coefficient, whole.coefficient, parts);
  whole.column.gather(parts);
  const std::span<const double> whole_shift = shift.empty() ? shift : std::span<const double>(whole.shift);
  const PoissonResult result =
      whole.solver.solve(spans(whole.coefficient), whole_shift, whole.source, whole.p, tolerance);
  whole.column.copy_cells(whole.p, p);
  return result;
}

PoissonResult PoissonSolver::solve(const FaceSpans& coefficient, std::span<const double> shift,
                                   const Field& given_source, Field& p, double tolerance) {
  if (whole_) return solve_whole(coefficient, shift, given_source, p, tolerance);
  const bool constant_open = leaves_constant_open(grid_, coefficient, shift);
  if (constant_open) {
    balanced_ = given_source;
    remove_mean(grid_, balanced_, owned_);
    pinned_.assign(grid_.padded_size(), 0.0);
    const std::optional<Pin> pin = pin_of(grid_, coefficient, shift);
    if (pin) pinned_[std::size_t(pin->cell)] = pin->diagonal;
    subtract(grid_, sum_of_ranks(grid_, pin ? p[std::size_t(pin->cell)] : 0), p);
  }
  const std::span<const double> diagonal = constant_open ? std::span<const double>(pinned_) : shift;
  const Field& source = constant_open ? balanced_ : given_source;
  PoissonResult result;
  // The residual carried along in the iteration differs from the true one by round-off: accept twice the tolerance.
  const auto judge = [&](const char* solver, bool fine) {
    result.solver = solver;
    result.residual = relative_residual(grid_, halo_, coefficient, shift, source, p);
    result.converged = fine && result.residual <= 2 * tolerance;
  };
  if (rows_)
    if (const std::optional<int> iterations = rows_->solve(coefficient, diagonal, source, p, tolerance)) {
      result.iterations += *iterations;
      judge("PCG + row means", true);
    }
  const auto solve_with_multigrid = [&] {
    if (!hypre_) hypre_ = std::make_unique<Hypre>(grid_);
    const bool aged = hypre_->solves > 0;
    const int iterations = hypre_->solve(grid_, coefficient, diagonal, source, p, tolerance);
    const bool error = HYPRE_GetError() != 0;
    HYPRE_ClearAllErrors();
    result.iterations += iterations;
    judge("PCG + PFMG", on_all_ranks(grid_, !error));
    if (result.converged)
      hypre_->age(iterations);
    else
      hypre_->forget();
    return result.converged || !aged;
  };
  if (!result.converged && !long_cells(grid_) && !solve_with_multigrid()) solve_with_multigrid();
  if (!result.converged) {
    open_linear_solvers();
    result.iterations += solve_algebraically(grid_, coefficient, diagonal, source, p, tolerance);
    judge("PCG + BoomerAMG", true);
  }
  if (!result.converged && !grid_.ranks && grid_.cell_count() <= most_cells_of_factorisation)
    judge("direct", solve_directly(grid_, coefficient, shift, source, p));
  if (constant_open) remove_mean(grid_, p, owned_);
  return result;
}

void PoissonSolver::forget() {
  if (hypre_) hypre_->forget();
  if (whole_) whole_->solver.forget();
}

}  // namespace polybed::core
