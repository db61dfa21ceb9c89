#include "multiscale/installed.hpp"

#include <system_error>

namespace polybed::multiscale {

namespace fs = std::filesystem;

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

fs::path beside_program(const fs::path& from_program, const fs::path& in_sources) {
  if (this_program().parent_path() == POLYBED_BUILD) return in_sources;  // what is beside the build is not ours
  std::error_code unknown;
  const fs::path installed = (this_program().parent_path() / from_program).lexically_normal();
  return fs::exists(installed, unknown) ? installed : in_sources;
}

}  // namespace polybed::multiscale
