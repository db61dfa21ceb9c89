// Lateral variation of a bed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tfm/fields.hpp"

namespace polybed::tfm {

/// The greatest difference of the solids fraction between lateral neighbours, on all ranks. 0 in a column of one cell
/// across.
[[nodiscard]] double lateral_difference(const core::Grid& grid, const Fields& fields);

/// A warning if a column with several cells across contains a bed as uniform as a single column of cells: the
/// difference is below a tenth of the initial perturbation. Empty otherwise.
[[nodiscard]] std::vector<std::string> warning_of_an_even_bed(const core::Grid& grid, const Fields& fields);

/// The same warning during a run, once: if the bed is still laterally uniform after the fluid has crossed it ten times.
/// Bubbles of a gas bed need several crossings to grow from the perturbation of the start.
class EvennessWatch {
 public:
  /// Empty if a column is one cell across, or no fluid flows. \param velocity  greatest superficial one, m/s
  [[nodiscard]] static std::optional<EvennessWatch> of(const core::Grid& grid, double velocity);

  /// Collective; checks the fields once. \param time  s  \param bed_height  m, the same on all ranks
  [[nodiscard]] std::vector<std::string> look(double time, double bed_height, const core::Grid& grid,
                                              const Fields& fields);

 private:
  explicit EvennessWatch(double velocity) : velocity_(velocity) {}
  double velocity_;
  bool looked_ = false;
};

}  // namespace polybed::tfm
