// Progress on the screen: a bar with one line of state on a terminal, plain lines in a pipe, nothing when quiet.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace polybed::core {

/// The content of one line.
struct ProgressLine {
  double time = 0, until = 0, step = 0;  ///< s
  std::string limited_by;
  std::optional<double> bed_height;  ///< m; empty: not measured yet, or no bed
  std::string worst_invariant;
  bool to_steady = false;  ///< the end is not known: the run goes on until its bed is steady
};

class Progress {
 public:
  /// from: time at which the run begins, s; until: its end, or a time after which it can end once its bed is steady.
  /// Writes to standard error, so that standard output contains only answers.
  Progress(bool quiet, double from, double until);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether a line is due: four times a second on a terminal, at every twentieth of the run in a pipe.
  [[nodiscard]] bool due(double time) const;
  void show(const ProgressLine& line);

 private:
  bool quiet_, terminal_;
  double from_, until_, next_, last_time_ = -1;
  std::chrono::steady_clock::time_point begin_, last_;
};

/// A duration for people: "42 s", "3 min 20 s", "2 h 5 min".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace polybed::core
