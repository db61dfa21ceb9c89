// How far a bed varies from side to side.
#pragma once

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

}  // namespace polybed::tfm
