// The search for the inversion velocity by runs: at which velocities, each continued from which other run, and when it
// ends. What a run is, its caller knows.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace polybed::multiscale {

/// Time mean of centre_difference over the window of a run.
struct ScanMean {
  double value = 0;
  double error = 0;  ///< half-width of its 95 % interval, which stands for two standard errors
  /// Whether the interval leaves out 0: who is on top is known.
  [[nodiscard]] bool certain() const { return value > error || value < -error; }
};

struct ScanRun {
  double velocity = 0;              ///< m/s
  std::optional<std::size_t> from;  ///< the run it goes on from; empty: it began as the case says
  ScanMean mean;
};

/// Runs one velocity, continued from the run of that number or begun as the case says.
using RunAt = std::function<ScanMean(double velocity, std::optional<std::size_t> from)>;

struct ScanRange {
  double low = 0, high = 0;  ///< first guess, m/s; left where both ends have the same species on top
};

/// Why a scan ended.
enum class ScanEnd {
  bracket,     ///< the bracket is narrow enough
  indistinct,  ///< from both sides the centres differ by less than two standard errors
  not_found    ///< no velocity tried has the other species on top
};
[[nodiscard]] std::string name_of(ScanEnd end);

struct ScanResult {
  ScanEnd end = ScanEnd::not_found;
  std::vector<ScanRun> runs;       ///< in the order in which they were made
  double low = 0, high = 0;        ///< the bracket, or the range that was searched, m/s
  std::optional<double> velocity;  ///< of the inversion, m/s; empty: not found
  std::optional<double> error;     ///< half-width of its 95 % interval by the noise of the means, m/s
  std::optional<double> slope;     ///< of the means over the bracket, s/m

  /// How well the velocity is known, over itself: the bracket where it is narrow, else the interval by the noise. Only
  /// where one was found.
  [[nodiscard]] double width() const { return (end == ScanEnd::bracket ? high - low : 2 * *error) / *velocity; }
};

/// Width at which a scan ends (cost.md, section 3).
constexpr double scan_width = 0.03;

/// Zero of the mean over the velocity: the range is widened until its ends are certain and of opposite sign, then cut
/// by bisection, or by the secant kept within the middle 80 % after a cut that halved it. Each run goes on from the
/// nearer end of the bracket; one that is not certain is repeated from the other end, and what counts is the mean of
/// both, as uncertain as half their difference at least.
[[nodiscard]] ScanResult scan_inversion(const ScanRange& range, const RunAt& run);

}  // namespace polybed::multiscale
