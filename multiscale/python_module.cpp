#include "multiscale/python_module.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "multiscale/program.hpp"

namespace polybed::multiscale {

namespace {

/// Debian's own Python: another one earlier on the path could lack the packages.
constexpr const char* python = "/usr/bin/python3";

std::vector<std::string> words_of(const std::string& module, const std::vector<std::string>& arguments) {
  const std::filesystem::path package = beside_program(POLYBED_PYTHON_INSTALLED, POLYBED_PYTHON_SOURCE) / "polybed";
  std::vector<std::string> words{python, "-I", package / "isolated.py", module};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

/// Starts a program, with standard output and error to a descriptor unless that is -1; 0 or the reason for failure.
int start(std::vector<std::string> words, int output, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (const int its : {STDOUT_FILENO, STDERR_FILENO})
    if (output >= 0) posix_spawn_file_actions_adddup2(&actions, output, its);
  const int reason = posix_spawn(&child, words.front().c_str(), &actions, nullptr, pointers_to(words).data(), environ);
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

/// Exit code of a child, in a shell's form.
int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t begin = text.rfind('\n');
  return begin == std::string::npos ? text : text.substr(begin + 1);
}

}  // namespace

PythonEnd run_python(const std::string& module, const std::vector<std::string>& arguments, PythonOutput output) {
  const std::vector<std::string> words = words_of(module, arguments);
  PythonEnd end;
  pid_t child = 0;
  int reason = 0;
  std::array<int, 2> pipe{-1, -1};
  if (output == PythonOutput::show) {
    reason = start(words, -1, child);
  } else if (::pipe2(pipe.data(), O_CLOEXEC) == 0) {
    reason = start(words, pipe[1], child);
    ::close(pipe[1]);
    if (reason == 0) end.output = read_all(pipe[0]);
    ::close(pipe[0]);
  } else {
    reason = errno;
  }
  if (reason != 0)
    end.not_started = std::string("cannot start ") + python + ": " + std::system_category().message(reason);
  else
    end.code = wait_for(child);
  return end;
}

void become_python(const std::string& module, const std::vector<std::string>& arguments) {
  ::setenv("POLYBED", this_program().c_str(), 1);
  throw core::FileError(
      fmt::format("cannot start {}: {}; {}", python, become(words_of(module, arguments)), python_packages));
}

bool draw(const std::string& module, const std::filesystem::path& directory, std::string& message,
          std::vector<std::string> options) {
  options.insert(options.end(), {"--", directory.string()});
  const PythonEnd end = run_python(module, options, PythonOutput::keep);
  message = end.not_started.empty() ? last_line(end.output) : end.not_started;
  return end.not_started.empty() && end.code == 0;
}

bool draw_picture(const std::filesystem::path& run_directory, std::string& message) {
  return draw("polybed.plot", run_directory, message, {"--picture"});
}

}  // namespace polybed::multiscale
