#include "multiscale/calibrate/pool.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <numeric>
#include <thread>

#include "core/error.hpp"
#include "multiscale/child_program.hpp"

namespace polybed::multiscale {

namespace {

using Running = std::map<std::size_t, std::unique_ptr<ChildProgram>>;  // by its job

/// Ends and awaits all that still run; all are asked before the first is waited for.
void stop(Running& running) {
  for (const auto& [job, child] : running) child->ask_to_end();
  running.clear();
}

/// One that has ended.
Running::iterator ended(Running& running) {
  return std::find_if(running.begin(), running.end(), [](auto& entry) { return entry.second->has_ended(); });
}

}  // namespace

std::vector<std::size_t> run_jobs(const std::vector<Job>& jobs, int at_once,
                                  const std::function<void(std::size_t)>& finished, const std::function<bool()>& wait) {
  std::vector<std::size_t> order(jobs.size()), failed;
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return jobs[a].expected > jobs[b].expected; });
  Running running;
  std::size_t next = 0;
  while (next < order.size() || !running.empty()) {
    while (next < order.size() && running.size() < std::size_t(at_once)) {
      const std::size_t job = order[next++];
      running[job] = std::make_unique<ChildProgram>(ChildOrder{jobs[job].arguments});
    }
    if (const auto found = ended(running); found != running.end()) {
      if (found->second->code() == 0)
        finished(found->first);
      else
        failed.push_back(found->first);
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
