// This program as a process: its path and the files installed next to it, another program in its place, and itself on
// several ranks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace polybed::multiscale {

/// The file of this program.
[[nodiscard]] std::filesystem::path this_program();

/// Stores the word that the user typed to start this program, for this process and those that it starts, unless the
/// launcher or the parent process has stored it.
void keep_typed_program(const char* word);
/// The same as a word for a shell: printed commands can be run unchanged.
[[nodiscard]] std::string typed_program();

/// A folder or file installed next to this program, or the one in the sources if it is not there.
/// \param from_program  its path from the folder of the program, as from CMake's file(RELATIVE_PATH)
[[nodiscard]] std::filesystem::path beside_program(const std::filesystem::path& from_program,
                                                   const std::filesystem::path& in_sources);

/// This process's environment, NAME=VALUE.
[[nodiscard]] std::vector<std::string> environment();

/// Texts in the form for exec: their addresses, then a null.
[[nodiscard]] std::vector<char*> pointers_to(std::vector<std::string>& texts);

/// Replaces this process by another program. Returns the reason if it cannot be started.
/// \param words  its path and its arguments
[[nodiscard]] std::string become(std::vector<std::string> words, std::vector<std::string> variables = environment());

/// Path of mpirun: the build's or, if that is missing, the first on PATH; relative entries of PATH are skipped. Throws
/// core::MpiError if there is none.
[[nodiscard]] std::filesystem::path mpirun();

/// This process's environment plus Open MPI's settings for a container, for root, and without binding; the user's own
/// settings take precedence.
[[nodiscard]] std::vector<std::string> environment_of_mpirun();

/// Passes the number of ranks for its runs to a study, in the environment's POLYBED_RANKS. Throws core::MpiError as
/// run_ranks does.
void keep_ranks_for_runs(int ranks);

/// Runs this program on several ranks with mpirun and returns how it ended. Requests to stop a run reach the ranks as
/// SIGUSR1, which mpirun passes on without a time limit for the step and the checkpoint; a second request ends them at
/// once. Throws core::MpiError if mpirun cannot be started, or if this process is already one of a launcher's ranks.
/// \param words  of the command line, after the number of ranks
[[nodiscard]] core::ExitCode run_ranks(int ranks, const std::vector<std::string>& words);

}  // namespace polybed::multiscale
