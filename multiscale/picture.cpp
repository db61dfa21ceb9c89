#include "multiscale/picture.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <vector>

namespace polybed::multiscale {

namespace {

/// Debian's own Python: another one may come first on the path and lack the packages.
constexpr const char* python = "/usr/bin/python3";

/// The installed package, or that of the sources the program was built from.
std::string package() {
  return std::filesystem::exists(POLYBED_PYTHON_INSTALLED) ? POLYBED_PYTHON_INSTALLED : POLYBED_PYTHON_SOURCE;
}

/// This process's environment with the package in front of Python's search path.
std::vector<std::string> environment() {
  constexpr std::string_view name = "PYTHONPATH=";
  std::string path = std::string(name) + package();
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry;
    if (text.starts_with(name))
      path += ":" + std::string(text.substr(name.size()));
    else
      all.emplace_back(text);
  }
  all.push_back(path);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

/// Starts a program whose output goes into a pipe; 0 or the reason why it did not start.
int start(std::vector<std::string> arguments, int output, int unused, pid_t& child) {
  std::vector<std::string> settings = environment();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addclose(&actions, unused);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  const int reason = posix_spawn(&child, arguments.front().c_str(), &actions, nullptr, pointers(arguments).data(),
                                 pointers(settings).data());
  posix_spawn_file_actions_destroy(&actions);
  return reason;
}

std::string read_all(int input) {
  std::string text;
  std::array<char, 4096> buffer;
  for (;;) {
    const ssize_t count = ::read(input, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), std::size_t(count));
  }
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return status;
}

}  // namespace

bool draw_picture(const std::filesystem::path& run_directory, std::string& message) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) {
    message = std::system_category().message(errno);
    return false;
  }
  pid_t child = 0;
  const int reason = start({python, "-m", "polybed.plot", run_directory.string()}, ends[1], ends[0], child);
  ::close(ends[1]);
  const std::string output = reason == 0 ? read_all(ends[0]) : "";
  ::close(ends[0]);
  if (reason != 0) {
    message = std::string("cannot start ") + python + ": " + std::system_category().message(reason);
    return false;
  }
  const bool drawn = wait_for(child) == 0;
  message = last_line(output);
  return drawn;
}

}  // namespace polybed::multiscale
