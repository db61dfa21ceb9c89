#include "hard/child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/error.hpp"
#include "core/interrupt.hpp"

namespace polybed::hard {

namespace {

struct Child {
  std::size_t piece;
  pid_t process;
  int answers;  ///< what it writes comes out here
  std::string text = {};
};

/// The last thing that a child writes: an answer without it is not whole.
constexpr char whole = '\x04';

void write_all(int output, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(output, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    done += std::size_t(count);
  }
}

/// The life of a child: no buffer of its parent is written twice, since it ends without their destructors.
[[noreturn]] void live(int output, std::size_t piece, const ChildLimits& limits,
                       const std::function<std::string(std::size_t)>& work) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a parent that is killed leaves nothing behind
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const auto limit = [](auto what, double most, rlim_t beyond) {
    const rlimit value{rlim_t(std::ceil(most)), rlim_t(std::ceil(most)) + beyond};
    if (most > 0) ::setrlimit(what, &value);
  };
  limit(RLIMIT_CPU, limits.cpu, 5);  // first SIGXCPU, so that SIGKILL is somebody else's: of a system without memory
  limit(RLIMIT_AS, limits.bytes, 0);
  ::alarm(unsigned(std::ceil(limits.seconds)));
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  try {
    write_all(output, work(piece) + whole);
  } catch (...) {
    std::abort();  // a crash, as which it is told
  }
  ::_exit(0);
}

Child start(std::size_t piece, const ChildLimits& limits, const std::function<std::string(std::size_t)>& work) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw core::FileError(fmt::format("no pipe: {}", std::strerror(errno)));
  std::fflush(nullptr);
  const pid_t process = ::fork();
  if (process < 0) throw core::FileError(fmt::format("no process can be started: {}", std::strerror(errno)));
  if (process == 0) {
    ::close(pipe[0]);
    live(pipe[1], piece, limits, work);
  }
  ::setpgid(process, process);
  ::close(pipe[1]);
  return {piece, process, pipe[0]};
}

/// Reads what is there; false at its end.
bool read_some(Child& child) {
  std::array<char, 4096> buffer;
  const ssize_t count = ::read(child.answers, buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return true;
  if (count > 0) child.text.append(buffer.data(), std::size_t(count));
  return count > 0;
}

ChildEnd end_of(Child& child, const ChildLimits& limits) {
  ::kill(-child.process, SIGKILL);  // it, if it still runs, and what it has left behind
  int status = 0;
  pid_t found = 0;
  do found = ::waitpid(child.process, &status, 0);
  while (found < 0 && errno == EINTR);
  ::close(child.answers);
  if (found < 0) return {false, fmt::format("lost: {}", std::strerror(errno))};
  if (!child.text.empty() && child.text.back() == whole) {
    child.text.pop_back();
    return {true, child.text};
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return {false, fmt::format("no end after {:.0f} s", limits.seconds)};
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return {false, fmt::format("no end after {:.0f} s of computing", limits.cpu)};
  if (WIFSIGNALED(status)) return {false, fmt::format("crashed: {}", strsignal(WTERMSIG(status)))};
  return {false, fmt::format("ended with code {} and no answer", WEXITSTATUS(status))};
}

/// Those that run; what still does when it goes, by an exception for one, ends with it.
class Children {
 public:
  explicit Children(const ChildLimits& limits) : limits_(limits) {}
  ~Children() {
    for (Child& child : all) (void)end_of(child, limits_);
  }
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;
  std::vector<Child> all;

 private:
  const ChildLimits& limits_;
};

}  // namespace

void in_children(std::size_t count, const ChildLimits& limits, const std::function<std::string(std::size_t)>& work,
                 const std::function<void(std::size_t, const ChildEnd&)>& done) {
  Children children(limits);
  std::vector<Child>& running = children.all;
  std::size_t next = 0;
  const core::Interrupt interrupt;
  while (next < count || !running.empty()) {
    while (next < count && running.size() < std::size_t(limits.jobs)) running.push_back(start(next++, limits, work));
    std::vector<pollfd> inputs;
    for (const Child& child : running) inputs.push_back({child.answers, POLLIN, 0});
    constexpr int look_every = 100;  // ms, whether the user stops it
    ::poll(inputs.data(), inputs.size(), look_every);
    if (interrupt.wanted()) throw core::Stopped("stopped by the user");
    for (std::size_t n = running.size(); n-- > 0;) {
      if (inputs[n].revents == 0 || read_some(running[n])) continue;
      const ChildEnd end = end_of(running[n], limits);
      const std::size_t piece = running[n].piece;
      running.erase(running.begin() + std::ptrdiff_t(n));
      done(piece, end);
    }
  }
}

}  // namespace polybed::hard
