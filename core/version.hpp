// What this program is: recorded in every file that it writes.
#pragma once

#include <string>

namespace polybed::core {

/// Version of the program, "major.minor.patch".
[[nodiscard]] std::string version();

/// Full hash of the commit the program was built from, "-dirty" after it if the sources had been changed;
/// "unknown" if they were not under git.
[[nodiscard]] std::string git_commit();

/// How the program was built, where that matters to who runs it: "sanitizers", else empty.
[[nodiscard]] std::string build_kind();

}  // namespace polybed::core
