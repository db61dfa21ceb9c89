// Measures of a run over a time window, and the distance between two runs there.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/output/history.hpp"
#include "measures/bed_table.hpp"
#include "measures/time_mean.hpp"

namespace polybed::measures {

/// A run as stored.
struct StoredRun {
  std::vector<std::string> species;
  core::History history = {};     ///< without columns: not stored
  std::vector<double> time = {};  ///< s, of the beds
  std::vector<Bed> beds = {};     ///< from their stored profiles
  /// Whether it is of a box with joined ends in a fluid, which has no bottom to measure from.
  [[nodiscard]] bool around() const { return history.find("superficial_slip_m_s") != nullptr; }
};

using Means = std::map<std::string, TimeMean>;

/// Pressure drop over buoyant weight, row by row; NaN without a weight. Empty if the history lacks the columns.
[[nodiscard]] std::vector<double> drop_over_weight(const core::History& history);
/// The columns of a history except time, plus pressure_drop_over_weight and centre_difference, which follow from them.
[[nodiscard]] std::map<std::string, std::vector<double>> series_of(const StoredRun& run);

/// The time window for means, s.
struct Window {
  double begin = 0, end = 0;
  bool shortened = false;  ///< by the marginal standard error rule

  /// The rows inside the window, up to rounding at its ends; the ends can lie beyond all rows.
  [[nodiscard]] Rows rows(std::span<const double> time) const;
};

/// \param time  of rows or profiles; not empty
[[nodiscard]] Window last_quarter(std::span<const double> time);

/// The last quarter of the time common to all histories, shortened by the marginal standard error rule for the bed
/// height and centre difference of each. Throws core::FileError if they have no time in common.
[[nodiscard]] Window common_window(const std::vector<const StoredRun*>& runs);

struct InWindow {
  std::size_t rows = 0;                          ///< of the history
  double step = 0;                               ///< s, mean distance between rows
  Means means = {};                              ///< of series_of()
  std::size_t profiles = 0;                      ///< number of stored profiles
  std::vector<double> height = {};               ///< of the centres of slabs, m
  std::vector<std::vector<TimeMean>> mean = {};  ///< [species][slab]; intervals leave out groups of profiles
  Means of_mean = {};                            ///< measures of the mean profile; intervals likewise
};

/// \param slabs  number of slabs to convert the profiles to; the means of bed height and centres then shift by the mean
/// change. 0: no conversion
[[nodiscard]] InWindow in_window(const StoredRun& run, const Window& window, std::size_t slabs = 0);

/// Distances between the mean profiles of two runs, by the rows of distance_table(); intervals leave out groups of
/// either run's profiles. Empty unless both have profiles. Throws core::FileError for different species, or for
/// different slabs that are not converted. \param slabs  as for in_window()
[[nodiscard]] Means distances(const StoredRun& run, const StoredRun& reference, const Window& window,
                              std::size_t slabs = 0);

}  // namespace polybed::measures
