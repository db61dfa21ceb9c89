// This program on several ranks, by mpirun.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace polybed::multiscale {

/// mpirun with its path: that of the build or, where it is not, the first on PATH; a relative entry of PATH is not
/// searched. Throws core::MpiError if there is none.
[[nodiscard]] std::filesystem::path mpirun();

/// This process's environment and what Open MPI needs in a container and as root, and without binding; what the user
/// has set stands.
[[nodiscard]] std::vector<std::string> environment_of_mpirun();

/// Hands the number of ranks over to a study, which starts its runs on as many, by the environment's POLYBED_RANKS.
/// Throws core::MpiError as become_ranks does.
void keep_ranks_for_runs(int ranks);

/// Goes on as mpirun of this program; returns never. Throws core::MpiError if it cannot be started, or if this process
/// is one of a launcher's ranks already.
/// \param words  of the command line, behind the number of ranks
[[noreturn]] void become_ranks(int ranks, std::vector<std::string> words);

}  // namespace polybed::multiscale
