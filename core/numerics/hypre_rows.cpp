#include "core/numerics/hypre_rows.hpp"

#include <numeric>

#include "core/numerics/blocks.hpp"
#include "core/numerics/linear_solver.hpp"
#include "core/numerics/mpi.hpp"

namespace polybed::core {

namespace {

HYPRE_ParVector vector(HYPRE_IJVector v) {
  void* object = nullptr;
  HYPRE_IJVectorGetObject(v, &object);
  return static_cast<HYPRE_ParVector>(object);
}

}  // namespace

HypreRows::HypreRows(const Grid& grid) : all_(communicator(grid)), rows_(HYPRE_Int(grid.cell_count())) {
  open_linear_solvers();
  numbers_ = cell_numbers(grid);
  row_.resize(std::size_t(rows_));
  std::iota(row_.begin(), row_.end(), row_of(grid.index(0, 0)));
  for (HYPRE_IJVector* v : {&right_, &solution_}) {
    HYPRE_IJVectorCreate(all_, row_.front(), row_.back(), v);
    HYPRE_IJVectorSetObjectType(*v, HYPRE_PARCSR);
    HYPRE_IJVectorInitialize(*v);
  }
}

HypreRows::~HypreRows() {
  clear();
  HYPRE_IJVectorDestroy(right_);
  HYPRE_IJVectorDestroy(solution_);
}

void HypreRows::clear() {
  if (multigrid_ != nullptr) HYPRE_BoomerAMGDestroy(multigrid_);
  if (matrix_ != nullptr) HYPRE_IJMatrixDestroy(matrix_);
  multigrid_ = nullptr;
  matrix_ = nullptr;
}

void HypreRows::begin() {
  column_.clear();
  value_.clear();
  row_size_.clear();
}

void HypreRows::add(HYPRE_Int column, double value) {
  for (std::size_t n = first_; n < value_.size(); ++n)
    if (column_[n] == column) {
      value_[n] += value;
      return;
    }
  column_.push_back(column);
  value_.push_back(value);
}

void HypreRows::assemble() {
  clear();
  HYPRE_IJMatrixCreate(all_, row_.front(), row_.back(), row_.front(), row_.back(), &matrix_);
  HYPRE_IJMatrixSetObjectType(matrix_, HYPRE_PARCSR);
  HYPRE_IJMatrixSetRowSizes(matrix_, row_size_.data());
  HYPRE_IJMatrixInitialize(matrix_);
  HYPRE_IJMatrixSetValues(matrix_, rows_, row_size_.data(), row_.data(), column_.data(), value_.data());
  HYPRE_IJMatrixAssemble(matrix_);
  HYPRE_BoomerAMGCreate(&multigrid_);
  HYPRE_BoomerAMGSetPrintLevel(multigrid_, 0);
  HYPRE_BoomerAMGSetCoarsenType(multigrid_, 10);  // HMIS
  HYPRE_BoomerAMGSetInterpType(multigrid_, 6);    // extended+i
  HYPRE_BoomerAMGSetPMaxElmts(multigrid_, 4);
  HYPRE_BoomerAMGSetStrongThreshold(multigrid_, 0.25);
  constexpr HYPRE_Int hybrid_symmetric = 6;  // Gauss-Seidel on each rank, Jacobi between ranks
  HYPRE_BoomerAMGSetRelaxType(multigrid_, hybrid_symmetric);
  HYPRE_BoomerAMGSetTol(multigrid_, 0);
  HYPRE_BoomerAMGSetMaxIter(multigrid_, 1);
  HYPRE_BoomerAMGSetup(multigrid_, parcsr(), vector(right_), vector(solution_));
}

HYPRE_ParCSRMatrix HypreRows::parcsr() const {
  void* object = nullptr;
  HYPRE_IJMatrixGetObject(matrix_, &object);
  return static_cast<HYPRE_ParCSRMatrix>(object);
}

void HypreRows::set_right(std::span<const double> values) {
  HYPRE_IJVectorSetValues(right_, rows_, row_.data(), values.data());
}

void HypreRows::set_solution(std::span<const double> values) {
  HYPRE_IJVectorSetValues(solution_, rows_, row_.data(), values.data());
}

void HypreRows::get_solution(std::span<double> values) {
  HYPRE_IJVectorGetValues(solution_, rows_, row_.data(), values.data());
}

void HypreRows::cycles(int count) {
  HYPRE_ParVectorSetConstantValues(vector(solution_), 0);
  HYPRE_BoomerAMGSetMaxIter(multigrid_, count);
  HYPRE_BoomerAMGSolve(multigrid_, parcsr(), vector(right_), vector(solution_));
}

int HypreRows::conjugate_gradients(double tolerance, int most_iterations) {
  HYPRE_Solver cg = nullptr;
  HYPRE_ParCSRPCGCreate(all_, &cg);
  HYPRE_PCGSetTol(cg, tolerance);
  HYPRE_PCGSetMaxIter(cg, most_iterations);
  HYPRE_PCGSetTwoNorm(cg, 1);
  HYPRE_BoomerAMGSetMaxIter(multigrid_, 1);
  HYPRE_ParCSRPCGSetPrecond(cg, HYPRE_BoomerAMGSolve, HYPRE_BoomerAMGSetup, multigrid_);
  HYPRE_ParCSRPCGSetup(cg, parcsr(), vector(right_), vector(solution_));
  HYPRE_ParCSRPCGSolve(cg, parcsr(), vector(right_), vector(solution_));
  HYPRE_Int iterations = 0;
  HYPRE_PCGGetNumIterations(cg, &iterations);
  HYPRE_ParCSRPCGDestroy(cg);
  return int(iterations);
}

}  // namespace polybed::core
