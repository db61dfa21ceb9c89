// Quantities of interest of a finished run: time means over a window with their intervals, on slabs of one thickness.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "fluid/profile.hpp"
#include "fluid/time_mean.hpp"
#include "multiscale/compare_window.hpp"

namespace polybed::multiscale {

/// What a quantity is measured in and what its errors are relative to.
enum class Scale { length, share, itself };

struct QuantityInfo {
  std::string id, unit, definition;
  Scale scale = Scale::share;  ///< length: the reference's bed height; share: 1; itself: the reference's value
};

/// Of a case with these species.
[[nodiscard]] std::vector<QuantityInfo> quantities_of(const std::vector<std::string>& species);

/// Slabs of the case as it is given, whatever the grid of the run.
struct MeasureOn {
  double slab = 0;  ///< m
  std::size_t count = 0;
  Window window;
};

struct RunQuantities {
  std::map<std::string, fluid::TimeMean> values;  ///< those that the run has
  fluid::Profile profile;                         ///< mean over the window
  std::string too_short;                          ///< a quantity with fewer than 30 autocorrelation times; else empty
};

/// Heights and centres: means of the rows of the history, moved by what the profiles stored in the window differ by if
/// measured on the slabs asked for. The rest by the definitions of docs/reference/measures.md. The interval of a mean
/// is that of fluid::time_mean; those of a quantity of the mean profile leave out groups of profiles.
[[nodiscard]] RunQuantities quantities_of_run(const Measured& run, const MeasureOn& on);

/// Distances between the mean profiles: "composition" (of two species and more) and "profile", the mean over species.
[[nodiscard]] std::map<std::string, double> distances(const fluid::Profile& profile, const fluid::Profile& reference);

}  // namespace polybed::multiscale
