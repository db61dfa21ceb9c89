// Whether a run has become steady: the remaining drift of its measures at the end.
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

/// Least squares through the means over ten equal parts of the time span, which filters fluctuations within a part. The
/// interval is Student's with eight degrees of freedom. Empty if a part has no value.
[[nodiscard]] std::optional<Drift> drift_of(std::span<const double> time, std::span<const double> value);

struct DriftOfMeasure {
  std::string name;
  Drift drift;         ///< m/s
  bool steady = true;  ///< the drift cannot be distinguished from 0, or is negligible
};

/// A height of a run at each of its times.
struct HeightSeries {
  std::string name;
  std::vector<double> values;  ///< m
  double settling = 0;         ///< s, for the slowest solids to settle alone through the height of the bed
};

/// The drift of a run's heights over the last quarter of its time. A drift matters if, over another run of the same
/// length or over the settling time if that is longer, it would move a height by more than a thousandth of the bed's
/// height and by more than a twentieth of a cell. Empty for a height with too few rows there, or with a row without a
/// value. \param heights  the bed's height comes first  \param cell  height of a cell, m
[[nodiscard]] std::vector<DriftOfMeasure> drifts_of(std::span<const double> time,
                                                    const std::vector<HeightSeries>& heights, double cell);

}  // namespace polybed::measures
