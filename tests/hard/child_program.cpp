#include "hard/child_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>
#include <thread>

#include "core/error.hpp"
#include "core/output/descriptor.hpp"
#include "core/output/files.hpp"
#include "multiscale/program.hpp"

namespace polybed::hard {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds look_every{2};
constexpr std::chrono::seconds grace{5};  // mpirun gives its ranks one

std::vector<std::string> words_of(const ChildOrder& order) {
  std::vector<std::string> words;
  if (order.ranks > 1) words = {multiscale::mpirun(), "-q", "--oversubscribe", "-n", std::to_string(order.ranks)};
  words.push_back((order.program.empty() ? multiscale::this_program() : order.program).string());
  words.insert(words.end(), order.words.begin(), order.words.end());
  return words;
}

core::Descriptor file_of(const std::filesystem::path& path) {
  return path.empty() ? core::Descriptor(-1) : core::new_file(path);
}

/// Made before the fork, behind which nothing may be allocated.
struct Start {
  std::vector<char*> words, environment;
  int output, errors, failure;  ///< files; into the last goes why it did not start
  pid_t parent;
  int with_parent;  ///< the signal that it gets when its parent is gone
};

[[noreturn]] void become(const Start& start) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, start.with_parent);
  if (::getppid() != start.parent) ::_exit(1);  // it was gone before
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);  // a group in the background may not read from the terminal
  ::dup2(start.output, STDOUT_FILENO);
  ::dup2(start.errors, STDERR_FILENO);
  ::execvpe(start.words[0], start.words.data(), start.environment.data());
  const int reason = errno;
  if (::write(start.failure, &reason, sizeof(reason)) < 0) ::_exit(1);
  ::_exit(1);
}

/// Why a process did not start; 0: it did, and the pipe was closed by that.
int reason_of(int pipe) {
  int reason = 0;
  ssize_t count = 0;
  do count = ::read(pipe, &reason, sizeof(reason));
  while (count < 0 && errno == EINTR);
  return count == ssize_t(sizeof(reason)) ? reason : 0;
}

[[noreturn]] void not_started(const ChildOrder& order, const std::string& what, int reason) {
  const std::string text = fmt::format("cannot start {}: {}", what, std::system_category().message(reason));
  if (order.ranks > 1) throw core::MpiError(text);
  throw core::FileError(text);
}

}  // namespace

ChildProgram::ChildProgram(const ChildOrder& order) {
  std::vector<std::string> words = words_of(order);
  std::vector<std::string> variables =
      order.ranks > 1 ? multiscale::environment_of_mpirun() : multiscale::environment();
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) not_started(order, words.front(), errno);
  const core::Descriptor reading(pipe[0]);
  int reason = 0;
  {
    const core::Descriptor writing(pipe[1]);
    const core::Descriptor output = file_of(order.output), errors = file_of(order.errors);
    const int out = order.output.empty() ? STDERR_FILENO : output.number();
    const Start start{multiscale::pointers_to(words),
                      multiscale::pointers_to(variables),
                      out,
                      order.errors.empty() ? out : errors.number(),
                      writing.number(),
                      ::getpid(),
                      order.ranks > 1 ? SIGTERM : SIGKILL};
    process_ = ::fork();
    reason = errno;
    if (process_ == 0) become(start);
  }
  if (process_ < 0) not_started(order, words.front(), reason);
  ::setpgid(process_, process_);
  reason = reason_of(reading.number());
  if (reason == 0) return;
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  not_started(order, words.front(), reason);
}

ChildProgram::~ChildProgram() {
  try {
    end();
  } catch (const core::FileError&) {  // lost: there is nothing to end
  }
}

bool ChildProgram::has_ended() {
  if (ended_) return true;
  int status = 0;
  const pid_t found = ::waitpid(process_, &status, WNOHANG);
  if (found == 0 || (found < 0 && errno == EINTR)) return false;
  ended_ = true;
  if (found < 0)
    throw core::FileError(fmt::format("lost process {}: {}", process_, std::system_category().message(errno)));
  code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return true;
}

void ChildProgram::end() {
  if (has_ended()) return;
  ::kill(process_, SIGTERM);
  for (const Clock::time_point last = Clock::now() + grace; !has_ended(); std::this_thread::sleep_for(look_every))
    if (Clock::now() > last) ::kill(-process_, SIGKILL);
}

int run_child(const ChildOrder& order, const std::function<void(const ChildProgram&)>& look) {
  ChildProgram child(order);
  for (; !child.has_ended(); std::this_thread::sleep_for(look_every))
    if (look) look(child);
  return child.code();
}

}  // namespace polybed::hard
