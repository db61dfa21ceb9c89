// Identity of this program, recorded in every file that it writes.
#pragma once

#include <string>

namespace polybed::core {

/// Version of the program, "major.minor.patch".
[[nodiscard]] std::string version();

/// Full hash of the commit the program was built from, "-dirty" after it if the sources had been changed;
/// "unknown" if they were not under git.
[[nodiscard]] std::string git_commit();

/// Build kind where it matters to the user: "sanitizers", else empty.
[[nodiscard]] std::string build_kind();

}  // namespace polybed::core
