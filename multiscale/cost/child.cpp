#include "multiscale/cost/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

#include "core/error.hpp"

namespace polybed::multiscale {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int not_started = 127;

/// What the child does before it becomes the program: only what is safe after fork.
[[noreturn]] void become(const std::vector<char*>& words, const char* output) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int file = ::open(output, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) ::_exit(not_started);
  ::dup2(file, STDOUT_FILENO);
  ::dup2(file, STDERR_FILENO);
  ::execvp(words.front(), words.data());
  ::_exit(not_started);
}

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

ChildEnd run_child(const std::vector<std::string>& words, const std::filesystem::path& output, double seconds) {
  std::vector<std::string> kept = words;
  std::vector<char*> pointers;
  for (std::string& word : kept) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const std::string path = output.string();
  const Clock::time_point begin = Clock::now();
  const pid_t child = ::fork();
  if (child < 0)
    throw core::FileError(fmt::format("cannot start {}: {}", words.front(), std::system_category().message(errno)));
  if (child == 0) become(pointers, path.c_str());
  ChildEnd end;
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (!end.timed_out && seconds_since(begin) > seconds) {
      end.timed_out = true;
      ::kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  end.wall = seconds_since(begin);
  end.code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  if (end.code == not_started) throw core::FileError(fmt::format("cannot start {}", words.front()));
  return end;
}

std::filesystem::path this_program() { return std::filesystem::read_symlink("/proc/self/exe"); }

}  // namespace polybed::multiscale
