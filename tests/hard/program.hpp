// The program `polybed`, which lies beside this one, as a trial starts it: on one rank or several, and what it said.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hard/child_program.hpp"

namespace polybed::hard {

/// How it ended, and what it said.
struct ProgramEnd {
  int code = 0;               ///< 128 and the number of the signal that ended it
  std::string printed, said;  ///< on standard output, and on standard error
};

/// Runs `polybed words...` on a number of ranks; throws as ChildProgram does.
/// \param look  called with it while it runs
[[nodiscard]] ProgramEnd run_program(int ranks, const std::vector<std::string>& words,
                                     const std::function<void(const ChildProgram&)>& look = {});

}  // namespace polybed::hard
