// Answers of commands to questions of polybed ask.
#pragma once

#include "core/output/json.hpp"

namespace polybed::app {

/// What polybed drag --csv answers for each point [eps, Re, x1, D1, ...]. Throws core::CaseError for what is no point.
[[nodiscard]] core::Json drag_of_points(const core::Json& question);

/// What polybed measure --series answers. Throws core::FileError for what are no numbers.
[[nodiscard]] core::Json means_of_series(const core::Json& asked);

}  // namespace polybed::app
