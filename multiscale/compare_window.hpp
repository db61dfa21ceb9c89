// The time over which two runs are compared, and what they have measured in it.
#pragma once

#include <string>
#include <vector>

#include "core/output/output.hpp"
#include "measures/profile.hpp"
#include "measures/time_mean.hpp"

namespace polybed::multiscale {

/// What a run has measured.
struct Measured {
  core::History history;
  core::Profiles profiles;
};

/// The time over which means are taken, s.
struct Window {
  double begin = 0, end = 0;
  bool shortened = false;  ///< by the marginal standard error rule
};

/// Names of the species, from the columns of the history.
[[nodiscard]] std::vector<std::string> species_of(const core::History& history);

/// The last quarter of the time that both runs have, or what the marginal standard error rule leaves of it for bed
/// height and centre difference of either (cost.md, section 6). Throws core::FileError if they have no time in common.
[[nodiscard]] Window window_of(const Measured& tfm, const Measured& dem);
/// The same of one run.
[[nodiscard]] Window window_of(const core::History& history);

using Series = std::vector<double>;

/// Quotients; NaN where the divisor is not above 0.
[[nodiscard]] Series ratio(const Series& above, const Series& below);

/// The history's column of a species' centre.
[[nodiscard]] std::string centre_column(const std::string& species);

/// Centre of species 2 less that of species 1, over the bed height, row by row; empty for one species.
[[nodiscard]] Series centre_difference(const core::History& history, const std::vector<std::string>& species);

/// The part of a series in the window. \param time  of its rows
[[nodiscard]] Series within(const Series& time, const Series& values, const Window& window);

/// What of a run still drifts up to the end of the window, a line each.
[[nodiscard]] std::vector<std::string> drifts_in(const core::History& history, const std::vector<std::string>& species,
                                                 const Window& window);

/// Solids fractions over time of each species in each slab, [species][slab].
using MeanProfiles = std::vector<std::vector<measures::TimeMean>>;

/// Profiles of a run in the window.
class WindowProfiles {
 public:
  /// Borrows the profiles. Throws core::FileError if one of the species has none.
  WindowProfiles(const core::Profiles& profiles, const std::vector<std::string>& species, const Window& window);

  [[nodiscard]] std::size_t count() const { return rows_.size(); }
  /// Mean over time. \param kept  which of them; empty: all
  [[nodiscard]] measures::Profile mean(const std::vector<bool>& kept = {}) const;
  /// Mean solids fractions over time, each with the half-width of its 95 % interval from leaving out groups of profiles
  /// (measures::jackknife), which of a mean is that of batch means; empty with less than four profiles. Without a
  /// profile in the window no species has a slab.
  [[nodiscard]] MeanProfiles time_means() const;

 private:
  double slab_;
  std::size_t slabs_;
  std::vector<const Series*> values_;  // [species]
  std::vector<std::size_t> rows_;
};

}  // namespace polybed::multiscale
