// Two runs of one case, one by each model, measured over the same window and scored: pure functions of what the runs
// have left on the disk.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measures/time_mean.hpp"
#include "multiscale/compare_window.hpp"
#include "multiscale/inversion/scan_file.hpp"

namespace polybed::multiscale {

/// A time mean by both models; empty where a run has none.
struct ComparedMeasure {
  std::string name;  ///< with its unit: "bed_height_m"
  std::optional<measures::TimeMean> tfm, dem;

  [[nodiscard]] std::optional<double> difference() const;        ///< TFM less DEM
  [[nodiscard]] std::optional<double> difference_error() const;  ///< half-width of its 95 % interval
};

/// How far apart the models are, and how far they may be.
struct Score {
  std::string name;                          ///< as in the contract: e_H, e_b, D1, profile_<name>, u_inv
  std::optional<double> value, error, goal;  ///< error: half-width of the 95 % interval
  /// Whether the value itself, whatever its interval, is within the goal; empty without one of them.
  [[nodiscard]] std::optional<bool> reached() const;
};

/// The species with the highest centre.
struct OnTop {
  std::string species;
  bool certain = false;  ///< the centres of the two highest differ by more than the interval of their difference
};

struct Comparison {
  Window window;
  std::vector<ComparedMeasure> measures;
  std::vector<Score> scores;
  std::optional<OnTop> tfm_top, dem_top;           ///< empty for one species
  std::size_t tfm_profiles = 0, dem_profiles = 0;  ///< stored profiles in the window
  std::vector<std::string> species;
  std::vector<double> height;         ///< of the slabs' centres, m
  MeanProfiles tfm_means, dem_means;  ///< of the species in the slabs
  std::string inversion_file;         ///< where u_inv is from; empty without it
  std::vector<std::string> warnings;
};

/// Adds what a scan by both models has found as the score u_inv; a comparison near to an inversion has a wider goal of
/// D1.
/// \param velocity  at which the runs of the comparison are, m/s
void take_up(Comparison& comparison, const FoundInversion& found, double velocity);

/// Measures and scores of two runs of one case (calibration.md, section 8). Throws core::FileError if the species or
/// the slabs of the profiles are not the same.
[[nodiscard]] Comparison compare(const Measured& tfm, const Measured& dem);

}  // namespace polybed::multiscale
