#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <mpi.h>

#include <vector>

#include "core/linear_solver.hpp"

namespace polybed::core {

/// The matrix by rows, the two unknowns of a cell next to each other, and its multigrid hierarchy.
struct BlockSolver::Hypre {
  HYPRE_Int rows;
  HYPRE_IJMatrix matrix = nullptr;
  HYPRE_IJVector right = nullptr, solution = nullptr;
  HYPRE_Solver multigrid = nullptr;
  std::vector<HYPRE_Int> row, row_size, column;
  std::vector<double> value, packed;
  std::size_t first = 0;  ///< of the row that is being filled

  explicit Hypre(const Grid& grid) : rows(HYPRE_Int(2 * grid.cell_count())), packed(std::size_t(rows)) {
    open_linear_solvers();
    row.resize(std::size_t(rows));
    row_size.resize(std::size_t(rows));
    for (HYPRE_Int n = 0; n < rows; ++n) row[std::size_t(n)] = n;
    for (HYPRE_IJVector* v : {&right, &solution}) {
      HYPRE_IJVectorCreate(MPI_COMM_SELF, 0, rows - 1, v);
      HYPRE_IJVectorSetObjectType(*v, HYPRE_PARCSR);
      HYPRE_IJVectorInitialize(*v);
    }
  }
  ~Hypre() {
    clear();
    HYPRE_IJVectorDestroy(right);
    HYPRE_IJVectorDestroy(solution);
  }
  Hypre(const Hypre&) = delete;
  Hypre& operator=(const Hypre&) = delete;

  void clear() {
    if (multigrid != nullptr) HYPRE_BoomerAMGDestroy(multigrid);
    if (matrix != nullptr) HYPRE_IJMatrixDestroy(matrix);
    multigrid = nullptr;
    matrix = nullptr;
  }

  void begin_row() { first = value.size(); }
  /// Adds to an entry of the present row; across periodic sides of one or two cells both neighbours are one.
  void add(HYPRE_Int at, double v) {
    for (std::size_t n = first; n < value.size(); ++n)
      if (column[n] == at) {
        value[n] += v;
        return;
      }
    column.push_back(at);
    value.push_back(v);
  }
  void end_row(HYPRE_Int n) { row_size[std::size_t(n)] = HYPRE_Int(value.size() - first); }

  void assemble() {
    clear();
    HYPRE_IJMatrixCreate(MPI_COMM_SELF, 0, rows - 1, 0, rows - 1, &matrix);
    HYPRE_IJMatrixSetObjectType(matrix, HYPRE_PARCSR);
    HYPRE_IJMatrixSetRowSizes(matrix, row_size.data());
    HYPRE_IJMatrixInitialize(matrix);
    HYPRE_IJMatrixSetValues(matrix, rows, row_size.data(), row.data(), column.data(), value.data());
    HYPRE_IJMatrixAssemble(matrix);
    HYPRE_BoomerAMGCreate(&multigrid);
    HYPRE_BoomerAMGSetPrintLevel(multigrid, 0);
    HYPRE_BoomerAMGSetNumFunctions(multigrid, 2);
    HYPRE_BoomerAMGSetCoarsenType(multigrid, 10);  // HMIS
    HYPRE_BoomerAMGSetInterpType(multigrid, 6);    // extended+i
    HYPRE_BoomerAMGSetPMaxElmts(multigrid, 4);
    HYPRE_BoomerAMGSetStrongThreshold(multigrid, 0.25);
    HYPRE_BoomerAMGSetTol(multigrid, 0);
    HYPRE_BoomerAMGSetup(multigrid, parcsr(), vector(right), vector(solution));
  }

  HYPRE_ParCSRMatrix parcsr() const {
    void* object = nullptr;
    HYPRE_IJMatrixGetObject(matrix, &object);
    return static_cast<HYPRE_ParCSRMatrix>(object);
  }
  static HYPRE_ParVector vector(HYPRE_IJVector v) {
    void* object = nullptr;
    HYPRE_IJVectorGetObject(v, &object);
    return static_cast<HYPRE_ParVector>(object);
  }
};

BlockSolver::BlockSolver(const Grid& grid) : grid_(grid), hypre_(std::make_unique<Hypre>(grid)) {}
BlockSolver::~BlockSolver() = default;
BlockSolver::BlockSolver(BlockSolver&&) noexcept = default;
BlockSolver& BlockSolver::operator=(BlockSolver&&) noexcept = default;

bool BlockSolver::setup(const FaceSpans& c11, const FaceSpans& c12, const FaceSpans& c21, const FaceSpans& c22,
                        const Field& slope, double diagonal_p, double c) {
  Hypre& h = *hypre_;
  h.column.clear();
  h.value.clear();
  const auto cells = grid_.cells;
  const std::array<HYPRE_Int, 3> jump{1, cells[0], cells[0] * cells[1]};
  HYPRE_Int cell = 0;
  /// Flux of one unknown's equation through one face of cell (i, j, k): there, and to the cell beyond.
  const auto couple = [&](const std::array<int, 3>& here, int d, int side, double of_p, double of_s) {
    const auto a = std::size_t(d);
    std::array<int, 3> beyond = here;
    beyond[a] += side;
    HYPRE_Int other = cell + side * jump[a];
    h.add(2 * cell, of_p);
    if (beyond[a] < 0 || beyond[a] >= cells[a]) {
      if (!grid_.periodic[a]) return;
      beyond[a] -= side * cells[a];
      other -= side * HYPRE_Int(cells[a]) * jump[a];
    }
    h.add(2 * cell + 1, of_s * slope[std::size_t(grid_.index(here[0], here[1], here[2]))]);
    h.add(2 * other, -of_p);
    h.add(2 * other + 1, -of_s * slope[std::size_t(grid_.index(beyond[0], beyond[1], beyond[2]))]);
  };
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i, ++cell)
        for (int unknown = 0; unknown < 2; ++unknown) {
          const FaceSpans& of_p = unknown == 0 ? c11 : c21;
          const FaceSpans& of_s = unknown == 0 ? c12 : c22;
          h.begin_row();
          h.add(2 * cell, unknown == 0 ? diagonal_p : 0.0);
          h.add(2 * cell + 1, unknown == 0 ? 0.0 : c);
          for (int d = 0; d < grid_.dimensions; ++d) {
            const auto a = std::size_t(d);
            const double w = 1 / (grid_.spacing[a] * grid_.spacing[a]);
            for (const int side : {-1, 1}) {
              const auto face = std::size_t(grid_.index(i, j, k) + (side < 0 ? 0 : grid_.stride(d)));
              couple({i, j, k}, d, side, w * of_p[a][face], w * of_s[a][face]);
            }
          }
          h.end_row(2 * cell + unknown);
        }
  h.assemble();
  const bool fine = HYPRE_GetError() == 0;
  HYPRE_ClearAllErrors();
  return fine;
}

void BlockSolver::apply(const Field& r1, const Field& r2, Field& p, Field& s, int cycles) {
  Hypre& h = *hypre_;
  double* to = h.packed.data();
  for_each_row(grid_, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      *to++ = r1[c];
      *to++ = r2[c];
    }
  });
  HYPRE_IJVectorSetValues(h.right, h.rows, h.row.data(), h.packed.data());
  HYPRE_ParVectorSetConstantValues(Hypre::vector(h.solution), 0);
  HYPRE_BoomerAMGSetMaxIter(h.multigrid, cycles);
  HYPRE_BoomerAMGSolve(h.multigrid, h.parcsr(), Hypre::vector(h.right), Hypre::vector(h.solution));
  HYPRE_ClearAllErrors();
  HYPRE_IJVectorGetValues(h.solution, h.rows, h.row.data(), h.packed.data());
  const double* from = h.packed.data();
  for_each_row(grid_, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      p[c] = *from++;
      s[c] = *from++;
    }
  });
}

}  // namespace polybed::core
