// Runs a case by the program itself, one child process a run, and keeps what came of it: a sweep that is killed goes on
// with the runs that were done.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/compare_window.hpp"
#include "multiscale/cost/work.hpp"

namespace polybed::multiscale {

/// What is run: the case with settings of its own.
struct RunOrder {
  std::string model;  ///< tfm | dem
  int ranks = 1;
  std::vector<std::string> overrides;
};

struct RunOutcome {
  std::string state;   ///< done | failed | refused | not run
  std::string reason;  ///< of what is not done
  double wall = 0;     ///< s, of the first time it was run
  double cpu = 0;      ///< s, without output
  double simulated = 0;
  bool invariants_held = true;
  Counters counters;
  std::optional<Measured> measured;
  [[nodiscard]] bool done() const { return state == "done"; }
  /// Weighed work for a simulated second.
  [[nodiscard]] double work_rate() const { return simulated > 0 ? weighed(counters) / simulated : 0; }
  [[nodiscard]] double cpu_rate() const { return simulated > 0 ? cpu / simulated : 0; }
};

class Runner {
 public:
  /// \param scene  the case at `case_path` as given: runs of another are not taken up
  /// \param folder  of the runs; what lies there is taken up if `resume`, else it is done again
  Runner(const core::Scene& scene, std::filesystem::path case_path, std::vector<std::string> overrides,
         std::filesystem::path folder, bool resume);

  /// Does it, unless it was done. \param seconds  wall time that it may take
  /// \param again  beyond what is kept: a repetition for its time, 1, 2, ...; 0 for the run itself
  [[nodiscard]] RunOutcome run(const RunOrder& order, double seconds, int again = 0);

  /// Wall time of all runs that stand for this sweep, s: those taken up count as if they had been done now.
  [[nodiscard]] double spent() const { return spent_; }

 private:
  [[nodiscard]] std::vector<std::string> words_of(const RunOrder& order, const std::filesystem::path& directory) const;
  [[nodiscard]] RunOutcome read(const std::filesystem::path& directory) const;
  void start(const RunOrder& order, const std::filesystem::path& directory, double seconds) const;

  std::filesystem::path case_path_, folder_;
  std::string case_text_;
  std::vector<std::string> overrides_;
  bool resume_;
  double cells_;
  std::vector<std::string> seen_;
  double spent_ = 0;
};

}  // namespace polybed::multiscale
