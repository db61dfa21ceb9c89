// Starts and ends MPI, for files that do not call it.
#pragma once

namespace polybed::core {

/// Whether mpirun, srun or another launcher has started this process, from the environment variables that they set.
[[nodiscard]] bool started_by_launcher();

/// Whether this process is the launcher's first rank or was started without a launcher.
[[nodiscard]] bool first_by_launcher();

/// Starts MPI if it does not run yet. A single process gets neither a network nor a daemon, for which Open MPI needs
/// ssh. Ranks that outnumber the cores yield while they wait. Throws MpiError.
void open_mpi();

/// Ends MPI if it runs.
void close_mpi();

}  // namespace polybed::core
