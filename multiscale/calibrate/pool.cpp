#include "multiscale/calibrate/pool.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <numeric>
#include <thread>

#include "core/error.hpp"

extern char** environ;

namespace polybed::multiscale {

namespace {

/// Starts this program with arguments; returns the process.
pid_t start(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"polybed"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& a : all) pointers.push_back(a.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t child = 0;
  const int reason = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (reason != 0) throw core::FileError(fmt::format("polybed cannot be started again ({})", std::strerror(reason)));
  return child;
}

/// Ends and awaits all that still run.
void stop(const std::map<pid_t, std::size_t>& running) {
  for (const auto& [child, job] : running) kill(child, SIGTERM);
  for (const auto& [child, job] : running) waitpid(child, nullptr, 0);
}

}  // namespace

std::vector<std::size_t> run_jobs(const std::vector<Job>& jobs, int at_once,
                                  const std::function<void(std::size_t)>& finished, const std::function<bool()>& wait) {
  std::vector<std::size_t> order(jobs.size()), failed;
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return jobs[a].expected > jobs[b].expected; });
  std::map<pid_t, std::size_t> running;
  std::size_t next = 0;
  while (next < order.size() || !running.empty()) {
    while (next < order.size() && running.size() < std::size_t(at_once)) {
      const std::size_t job = order[next++];
      running[start(jobs[job].arguments)] = job;
    }
    int status = 0;
    const pid_t child = waitpid(-1, &status, WNOHANG);
    if (const auto found = running.find(child); child > 0 && found != running.end()) {
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        finished(found->second);
      else
        failed.push_back(found->second);
      running.erase(found);
      continue;
    }
    if (!wait()) {
      stop(running);
      throw core::Stopped("stopped by the user; boxes that are finished are kept, the same command goes on");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
  }
  return failed;
}

}  // namespace polybed::multiscale
