// Runs this program several times at once, one box each.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace polybed::multiscale {

/// One run of this program: its arguments, and how long it is expected to take, s.
struct Job {
  std::vector<std::string> arguments;
  double expected = 0;
};

/// Runs jobs, longest first, at most `at_once` at a time; their standard output goes to standard error. `finished` is
/// called with the place of each that ended with 0, `wait` four times a second and stops all if it is false. Returns
/// the places of those that failed. Throws core::Stopped when stopped.
[[nodiscard]] std::vector<std::size_t> run_jobs(const std::vector<Job>& jobs, int at_once,
                                                const std::function<void(std::size_t)>& finished,
                                                const std::function<bool()>& wait);

}  // namespace polybed::multiscale
