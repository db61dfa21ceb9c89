// polybed stability: hands over to polybed-hard, the program of hard cases.
#include <fmt/format.h>

#include "app/options.hpp"
#include "core/error.hpp"
#include "multiscale/become.hpp"
#include "multiscale/installed.hpp"

namespace polybed::app {

void run_stability(std::vector<std::string> words) {
  const std::string program = (this_program().parent_path() / "polybed-hard").string();
  words.insert(words.begin(), program);
  throw core::FileError(
      fmt::format("{}: cannot be started ({}); in a build tree: cmake --build build --target polybed-hard", program,
                  become(words)));
}

}  // namespace polybed::app
