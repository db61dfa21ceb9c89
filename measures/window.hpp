// What a run has measured over a window of its time, and how far two runs are apart there.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/output/history.hpp"
#include "measures/bed_table.hpp"
#include "measures/time_mean.hpp"

namespace polybed::measures {

/// A run as it is stored.
struct StoredRun {
  std::vector<std::string> species;
  core::History history = {};     ///< without columns: there is none
  std::vector<double> time = {};  ///< s, of the beds
  std::vector<Bed> beds = {};     ///< by their stored profiles
};

using Means = std::map<std::string, TimeMean>;

/// Pressure drop over buoyant weight, row by row; NaN without a weight. Empty where the history lacks the columns.
[[nodiscard]] std::vector<double> drop_over_weight(const core::History& history);
/// The columns of a history but the time, and pressure_drop_over_weight and centre_difference, which follow from them.
[[nodiscard]] std::map<std::string, std::vector<double>> series_of(const StoredRun& run);

/// The time over which means are taken, s.
struct Window {
  double begin = 0, end = 0;
  bool shortened = false;  ///< by the marginal standard error rule

  /// Which of the times it has, up to the rounding of its ends; these may lie beyond all of them.
  [[nodiscard]] Rows rows(std::span<const double> time) const;
};

/// \param time  of rows or profiles; not empty
[[nodiscard]] Window last_quarter(std::span<const double> time);

/// The last quarter of the time that all histories have, or what the marginal standard error rule leaves of it for bed
/// height and centre difference of each. Throws core::FileError if they have no time in common.
[[nodiscard]] Window common_window(const std::vector<const StoredRun*>& runs);

struct InWindow {
  std::size_t rows = 0;                          ///< of the history
  double step = 0;                               ///< s, from row to row, in the mean
  Means means = {};                              ///< of series_of()
  std::size_t profiles = 0;                      ///< stored ones
  std::vector<double> height = {};               ///< of the centres of slabs, m
  std::vector<std::vector<TimeMean>> mean = {};  ///< [species][slab]; intervals leave out groups of profiles
  Means of_mean = {};                            ///< measures of the mean profile; likewise
};

/// \param slabs  number of those on which the profiles are laid first, which moves the means of bed height and centres
///               by what it changes in the mean; 0: as they are
[[nodiscard]] InWindow in_window(const StoredRun& run, const Window& window, std::size_t slabs = 0);

/// Distances of the mean profile of a run from that of another one, by the rows of distance_table(); intervals leave
/// out groups of either's profiles. Empty without a profile of both. Throws core::FileError if the runs are of other
/// species, or of other slabs and are not laid on the same number. \param slabs  as of in_window()
[[nodiscard]] Means distances(const StoredRun& run, const StoredRun& reference, const Window& window,
                              std::size_t slabs = 0);

}  // namespace polybed::measures
