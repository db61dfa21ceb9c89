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

/// A height of a run at each of its times.
struct HeightSeries {
  std::string name;
  std::vector<double> values;  ///< m
  double settling = 0;         ///< s, in which what has it settles alone through the height of the bed
};

/// What the heights of a run still drift by over the last quarter of its time. It matters if another run as long, or
/// the time of settling if that is longer, would move one by more than a thousandth of the bed's height. Empty for a
/// height that has too few rows there, or a row without a value.
/// \param heights  the first is that of the bed
[[nodiscard]] std::vector<DriftOfMeasure> drifts_of(std::span<const double> time,
                                                    const std::vector<HeightSeries>& heights);

}  // namespace polybed::measures
