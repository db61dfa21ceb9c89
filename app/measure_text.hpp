// The measures of profiles as tables on the screen, at most 100 columns wide.
#pragma once

#include <string>
#include <vector>

#include "app/studies.hpp"
#include "measures/window.hpp"

namespace polybed::app {

/// One measure, for each profile.
struct MeasuredColumn {
  std::string name, unit, help, heading;
  std::vector<measures::Value> values;
};

/// All values, in blocks of as many columns as fit. Each block repeats the first column, the time.
void print_table(const std::vector<MeasuredColumn>& columns);

/// For each measure of a run its mean over the last quarter with the interval, and its final value, as on its result
/// card: from the rows of the history if they contain the measure, else from the stored profiles.
/// \param run  with the beds of the columns
void print_summary(const measures::StoredRun& run, const std::vector<MeasuredColumn>& columns);

}  // namespace polybed::app
