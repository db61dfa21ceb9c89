// MPI for the files in core that call it.
#pragma once

#include <mpi.h>

#include "core/numerics/grid.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::core {

/// The communicator of the ranks that share a column; this process alone without ranks.
[[nodiscard]] inline MPI_Comm communicator(const Ranks* ranks) {
  return ranks == nullptr ? MPI_COMM_SELF : MPI_Comm_f2c(ranks->handle());
}
[[nodiscard]] inline MPI_Comm communicator(const Grid& grid) { return communicator(grid.ranks.get()); }

/// Throws MpiError if an MPI call failed.
void check_mpi(int code, const char* call);

}  // namespace polybed::core
