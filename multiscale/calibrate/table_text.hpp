// A table beside its file: the same meta data as TOML, and what was fitted.
#pragma once

#include <string>

#include "fluid/solids_table.hpp"
#include "multiscale/calibrate/box_result.hpp"

namespace polybed::multiscale {

/// TOML of a table of sheared boxes.
[[nodiscard]] std::string table_toml(const fluid::SolidsTable& table, const Plan& plan,
                                     const std::vector<BoxResult>& boxes);

/// One line per box for people, with a header.
[[nodiscard]] std::string box_lines(const std::vector<BoxResult>& boxes);

}  // namespace polybed::multiscale
