#include "multiscale/python_module.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "multiscale/child_program.hpp"
#include "multiscale/installed.hpp"

namespace polybed::multiscale {

namespace {

/// Debian's own Python: another one may come first on the path and lack the packages.
constexpr const char* python = "/usr/bin/python3";

std::vector<std::string> words_of(const std::string& module, const std::vector<std::string>& arguments) {
  const std::filesystem::path package = beside_program(POLYBED_PYTHON_INSTALLED, POLYBED_PYTHON_SOURCE) / "polybed";
  std::vector<std::string> words{python, "-I", package / "isolated.py", module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

/// Starts a program whose output goes into a pipe, or where ours goes if there is none; 0 or why it did not start.
int start(std::vector<std::string> arguments, const std::optional<std::array<int, 2>>& pipe, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (pipe) {
    posix_spawn_file_actions_addclose(&actions, (*pipe)[0]);
    posix_spawn_file_actions_adddup2(&actions, (*pipe)[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, (*pipe)[1], STDERR_FILENO);
  }
  const int reason =
      posix_spawn(&child, arguments.front().c_str(), &actions, nullptr, pointers_to(arguments).data(), environ);
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

/// Exit code of a child, as a shell tells it.
int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

PythonEnd run_python(const std::string& module, const std::vector<std::string>& arguments, PythonOutput output) {
  std::vector<std::string> words = words_of(module, arguments);
  PythonEnd end;
  std::optional<std::array<int, 2>> pipe;
  if (output == PythonOutput::keep && ::pipe(pipe.emplace().data()) != 0) {
    end.not_started = std::system_category().message(errno);
    return end;
  }
  pid_t child = 0;
  const int reason = start(std::move(words), pipe, child);
  if (pipe) {
    ::close((*pipe)[1]);
    if (reason == 0) end.output = read_all((*pipe)[0]);
    ::close((*pipe)[0]);
  }
  if (reason != 0)
    end.not_started = std::string("cannot start ") + python + ": " + std::system_category().message(reason);
  else
    end.code = wait_for(child);
  return end;
}

void become_python(const std::string& module, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = words_of(module, arguments);
  ::setenv("POLYBED", this_program().c_str(), 1);
  ::execv(python, pointers_to(words).data());
  throw core::FileError(
      fmt::format("cannot start {}: {}; {}", python, std::system_category().message(errno), python_packages));
}

}  // namespace polybed::multiscale
