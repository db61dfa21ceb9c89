// The XDMF text that shows stored fields in ParaView.
#pragma once

#include <span>
#include <string>

#include "core/numerics/grid.hpp"
#include "core/output/fields.hpp"

namespace polybed::core {

/// XDMF 3.0: a temporal collection of rectilinear grids, one per stored step.
[[nodiscard]] std::string fields_xdmf(const Grid& grid, std::span<const FieldName> names,
                                      std::span<const double> times);

}  // namespace polybed::core
