#include "multiscale/picture.hpp"

#include <spawn.h>
#include <sys/wait.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace polybed::multiscale {

bool draw_picture(const std::filesystem::path& run_directory, std::string& message) {
  const std::filesystem::path package =
      std::filesystem::exists(POLYBED_PYTHON_INSTALLED) ? POLYBED_PYTHON_INSTALLED : POLYBED_PYTHON_SOURCE;
  std::vector<std::string> environment{"PYTHONPATH=" + package.string(), "MPLBACKEND=Agg"};
  for (const char* name : {"PATH", "HOME", "LANG", "TMPDIR"})
    if (const char* value = std::getenv(name)) environment.push_back(std::string(name) + "=" + value);
  std::vector<std::string> words{"/usr/bin/python3", "-m", "polybed.plot", run_directory.string()};
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> list;
    for (std::string& text : texts) list.push_back(text.data());
    list.push_back(nullptr);
    return list;
  };
  pid_t child = 0;
  if (const int error = posix_spawn(&child, words[0].c_str(), nullptr, nullptr, pointers(words).data(),
                                    pointers(environment).data());
      error != 0) {
    message = std::string("/usr/bin/python3 cannot be started (") + std::strerror(error) + ")";
    return false;
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
  message = "polybed.plot failed; it needs python3-numpy, python3-h5py and python3-matplotlib";
  return false;
}

}  // namespace polybed::multiscale
