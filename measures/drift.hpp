// Whether a run has become steady: what its measures still drift by at its end.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace polybed::measures {

/// A straight line through a series in time.
struct Drift {
  double rate = 0;   ///< its slope, per s
  double error = 0;  ///< half-width of the 95 % interval of the slope, per s
};

/// Least squares through the means of ten equal parts of the time spanned, which leaves out what varies within a part;
/// the interval is Student's of eight degrees of freedom. Empty where a part has no value.
[[nodiscard]] std::optional<Drift> drift_of(std::span<const double> time, std::span<const double> value);

struct DriftOfMeasure {
  std::string name;
  Drift drift;         ///< m/s
  bool steady = true;  ///< the drift cannot be told from 0, or does not matter
};

/// Follows the heights of a run: the first is that of the bed.
class Drifts {
 public:
  explicit Drifts(std::vector<std::string> names) : names_(std::move(names)), values_(names_.size()) {}

  /// A row of heights, m, in the order of the names; one that has none is not judged while the window holds it.
  void see(double time, std::span<const std::optional<double>> heights);

  /// Length of the window that is judged, the last quarter of what was seen, s.
  [[nodiscard]] double window() const;
  /// What drifts in the window. It matters if another run as long would move it by more than a thousandth of the bed's
  /// height. Empty for a measure that the window holds too few rows of.
  [[nodiscard]] std::vector<DriftOfMeasure> judge() const;

 private:
  std::vector<std::string> names_;
  std::vector<double> time_;
  std::vector<std::vector<double>> values_;  ///< [measure][row]; NaN: none
};

}  // namespace polybed::measures
