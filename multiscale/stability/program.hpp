// This program itself as another process, on one rank or several.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/checkpoint.hpp"

namespace polybed::stability {

/// How it ended, and what it said on standard error.
struct ProgramEnd {
  int code = 0;  ///< 128 and the number of the signal that ended it
  std::string said;
  double seconds = 0;
};

/// Runs `polybed words...` on a number of ranks in a directory; above one by mpirun. Throws core::MpiError without it.
/// \param until_exists  the program is killed as soon as this file is there; empty: never
[[nodiscard]] ProgramEnd run_program(int ranks, const std::vector<std::string>& words,
                                     const std::filesystem::path& until_exists = {});

}  // namespace polybed::stability
