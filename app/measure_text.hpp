// The measures of profiles as tables on the screen, at most 100 columns wide.
#pragma once

#include <string>
#include <vector>

#include "app/studies.hpp"
#include "measures/window.hpp"

namespace polybed::app {

/// A measure of each of the profiles.
struct MeasuredColumn {
  std::string name, unit, help, heading;
  std::vector<measures::Value> values;
};

/// All values, in blocks of as many columns as fit. Each block repeats the first column, the time.
void print_table(const std::vector<MeasuredColumn>& columns);

/// Of each measure of a run its mean over the last quarter with the interval, and its value at the end: those of its
/// result card, by the rows of the history where these have the measure, else by the stored profiles.
/// \param run  with beds, of which the columns are
void print_summary(const measures::StoredRun& run, const std::vector<MeasuredColumn>& columns);

}  // namespace polybed::app
