// This program as a process: where it and what was installed beside it lie, another program in its place, and itself on
// several ranks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace polybed::multiscale {

/// The file of this program.
[[nodiscard]] std::filesystem::path this_program();

/// Keeps what the user has typed to start this program, for this process and those that it starts; the launcher, or the
/// process that has started this one, may have done so.
void keep_typed_program(const char* word);
/// The same as a word for a shell: printed commands run as they stand.
[[nodiscard]] std::string typed_program();

/// A folder or file installed beside this program, or that of the sources if it is not there.
/// \param from_program  its path from the folder of the program, as CMake's file(RELATIVE_PATH) gives it
[[nodiscard]] std::filesystem::path beside_program(const std::filesystem::path& from_program,
                                                   const std::filesystem::path& in_sources);

/// This process's environment, NAME=VALUE.
[[nodiscard]] std::vector<std::string> environment();

/// Texts as exec wants them: their places, and a null behind.
[[nodiscard]] std::vector<char*> pointers_to(std::vector<std::string>& texts);

/// Goes on as another program. Returns only if it cannot be started: why not.
/// \param words  its path and its arguments
[[nodiscard]] std::string become(std::vector<std::string> words, std::vector<std::string> variables = environment());

/// mpirun with its path: that of the build or, where it is not, the first on PATH; a relative entry of PATH is not
/// searched. Throws core::MpiError if there is none.
[[nodiscard]] std::filesystem::path mpirun();

/// This process's environment and what Open MPI needs in a container and as root, and without binding; what the user
/// has set stands.
[[nodiscard]] std::vector<std::string> environment_of_mpirun();

/// Hands the number of ranks over to a study, which starts its runs on as many, by the environment's POLYBED_RANKS.
/// Throws core::MpiError as run_ranks does.
void keep_ranks_for_runs(int ranks);

/// Runs this program on several ranks by mpirun and returns how it ended. What asks a run to stop reaches the ranks as
/// SIGUSR1, which mpirun passes on and leaves them all the time that a step and a checkpoint take; a second one ends
/// them at once. Throws core::MpiError if mpirun cannot be started, or if this process is one of a launcher's ranks
/// already.
/// \param words  of the command line, behind the number of ranks
[[nodiscard]] core::ExitCode run_ranks(int ranks, const std::vector<std::string>& words);

}  // namespace polybed::multiscale
