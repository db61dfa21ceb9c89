#include "multiscale/program.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/numerics/mpi_start.hpp"
#include "core/print.hpp"

namespace polybed::multiscale {

namespace fs = std::filesystem;

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

void keep_typed_program(const char* word) {
  if (word != nullptr) (void)::setenv("POLYBED_TYPED", word, 0);
}

std::string typed_program() {
  const char* word = std::getenv("POLYBED_TYPED");
  return word == nullptr ? "polybed" : core::shell_word(word);
}

fs::path beside_program(const fs::path& from_program, const fs::path& in_sources) {
  if (this_program().parent_path() == POLYBED_BUILD) return in_sources;  // ignores files next to the build
  std::error_code unknown;
  const fs::path installed = (this_program().parent_path() / from_program).lexically_normal();
  return fs::exists(installed, unknown) ? installed : in_sources;
}

std::vector<std::string> environment() {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

std::string become(std::vector<std::string> words, std::vector<std::string> variables) {
  ::execve(words.front().c_str(), pointers_to(words).data(), pointers_to(variables).data());
  return std::system_category().message(errno);
}

namespace {

constexpr std::array<std::string_view, 5> settings{
    "OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", "OMPI_MCA_rmaps_base_oversubscribe=1",
    "OMPI_MCA_hwloc_base_binding_policy=none", "OMPI_MCA_btl_vader_single_copy_mechanism=none"};

void refuse_launcher(int ranks) {
  if (core::started_by_launcher())
    throw core::MpiError(fmt::format("-n {}: this is one of the ranks of a launcher already; leave out -n", ranks));
}

}  // namespace

fs::path mpirun() {
  if (::access(POLYBED_MPIRUN, X_OK) == 0) return POLYBED_MPIRUN;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path program = fs::path(folder) / "mpirun";
    if (program.is_absolute() && ::access(program.c_str(), X_OK) == 0) return program;
  }
  throw core::MpiError(fmt::format("mpirun is neither {} nor on PATH: install openmpi-bin", POLYBED_MPIRUN));
}

std::vector<std::string> environment_of_mpirun() {
  std::vector<std::string> all = environment();
  for (const std::string_view setting : settings) {
    const std::string_view name = setting.substr(0, setting.find('=') + 1);
    if (std::none_of(all.begin(), all.end(), [&](const std::string& entry) { return entry.starts_with(name); }))
      all.emplace_back(setting);
  }
  return all;
}

void keep_ranks_for_runs(int ranks) {
  if (ranks < 2) return;
  refuse_launcher(ranks);
  ::setenv("POLYBED_RANKS", std::to_string(ranks).c_str(), 1);
}

namespace {

/// mpirun as a child that ends with this process. It has its own process group: Ctrl-C on a terminal reaches a whole
/// group, and mpirun gives ranks only a second before it kills them.
[[noreturn]] void become_child(const std::vector<std::string>& words, pid_t parent, const sigset_t& signals) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  ::sigprocmask(SIG_SETMASK, &signals, nullptr);
  const std::string reason = ::getppid() == parent ? become(words, environment_of_mpirun()) : "its parent has ended";
  core::print(stderr, "cannot start {}: {}\n", words.front(), reason);
  ::_exit(int(core::ExitCode::mpi));
}

}  // namespace

core::ExitCode run_ranks(int ranks, const std::vector<std::string>& words) {
  refuse_launcher(ranks);
  std::vector<std::string> all{mpirun(), "-q", "-n", std::to_string(ranks), this_program()};
  all.insert(all.end(), words.begin(), words.end());
  sigset_t watched, before;
  ::sigemptyset(&watched);
  ::sigaddset(&watched, SIGCHLD);
  for (const int signal : core::stop_signals()) ::sigaddset(&watched, signal);
  ::sigprocmask(SIG_BLOCK, &watched, &before);
  std::signal(SIGCHLD, SIG_DFL);  // a process that ignores it would not learn how a child ended
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw core::MpiError(fmt::format("cannot start {}: {}", all.front(), std::strerror(errno)));
  if (child == 0) become_child(all, parent, before);
  int status = 0, asked = 0;
  while (::waitpid(child, &status, WNOHANG) != child) {
    const int signal = ::sigwaitinfo(&watched, nullptr);
    if (signal > 0 && signal != SIGCHLD) ::kill(child, asked++ == 0 ? SIGUSR1 : SIGTERM);
  }
  ::sigprocmask(SIG_SETMASK, &before, nullptr);
  const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  const bool ended_by_wish = asked > 0 && (code == 1 || code > 128);  // 1 is mpirun's own
  return ended_by_wish ? core::ExitCode::stopped : core::ExitCode(code);
}

}  // namespace polybed::multiscale
