// When MPI starts and ends, for those that do not speak it.
#pragma once

namespace polybed::core {

/// Whether mpirun, srun or another launcher has started this process, by what they leave in its environment.
[[nodiscard]] bool started_by_launcher();

/// Whether this process is the launcher's first rank, or was started by none.
[[nodiscard]] bool first_by_launcher();

/// Starts MPI if nobody has. A process of its own gets neither a network nor a daemon, for which Open MPI needs ssh;
/// ranks that outnumber the cores yield while they wait. Throws MpiError.
void open_mpi();

/// Ends MPI if it runs.
void close_mpi();

}  // namespace polybed::core
