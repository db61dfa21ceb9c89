// What stands beside the program: files that were installed with it, or those of the sources it was built from.
#pragma once

#include <filesystem>

namespace polybed::multiscale {

/// The file of this program.
[[nodiscard]] std::filesystem::path this_program();

/// A folder or file installed beside this program, or that of the sources if it is not there.
/// \param from_program  its path from the folder of the program, as CMake's file(RELATIVE_PATH) gives it
[[nodiscard]] std::filesystem::path beside_program(const std::filesystem::path& from_program,
                                                   const std::filesystem::path& in_sources);

}  // namespace polybed::multiscale
