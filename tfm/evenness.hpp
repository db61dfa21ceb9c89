// How far a bed varies from side to side.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tfm/fields.hpp"

namespace polybed::tfm {

/// The greatest difference of the solids fraction between neighbours side by side, on all ranks.
/// 0 in a column of one cell across.
[[nodiscard]] double lateral_difference(const core::Grid& grid, const Fields& fields);

/// A warning where a column of several cells across holds a bed that is as even as a single column of cells: it differs
/// by less than a tenth of the perturbation that starts have. Empty otherwise.
[[nodiscard]] std::vector<std::string> warning_of_an_even_bed(const core::Grid& grid, const Fields& fields);

/// The same warning while a run goes on, once: when the fluid has crossed the bed and the bed is still even.
class EvennessWatch {
 public:
  /// Empty where a column is one cell across, or no fluid flows. \param velocity  greatest superficial one, m/s
  [[nodiscard]] static std::optional<EvennessWatch> of(const core::Grid& grid, double velocity);

  /// Collective; looks at the fields once. \param time  s  \param bed_height  m, the same on all ranks
  [[nodiscard]] std::vector<std::string> look(double time, double bed_height, const core::Grid& grid,
                                              const Fields& fields);

 private:
  explicit EvennessWatch(double velocity) : velocity_(velocity) {}
  double velocity_;
  bool looked_ = false;
};

}  // namespace polybed::tfm
