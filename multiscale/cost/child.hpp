// Starts programs and waits for them, so that one that fails or hangs ends nothing but itself.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace polybed::multiscale {

struct ChildEnd {
  int code = 0;            ///< its exit code; 128 and the number of the signal if one ended it
  bool timed_out = false;  ///< it was ended because its time was over
  double wall = 0;         ///< s
};

/// Runs a program found on the path or by it; its output goes into a file. It ends with this process if that is killed.
/// Throws core::FileError if it cannot be started. \param seconds  after which it is ended; infinite: never
[[nodiscard]] ChildEnd run_child(const std::vector<std::string>& words, const std::filesystem::path& output,
                                 double seconds);

/// The file of this program.
[[nodiscard]] std::filesystem::path this_program();

}  // namespace polybed::multiscale
