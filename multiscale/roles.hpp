// All roles that a case file may name in [effects]: those of the models that exist, and those of the DEM.
#pragma once

#include <vector>

#include "core/registry.hpp"

namespace polybed::multiscale {

/// The roles of the continuum model, then those that act between particles alone.
[[nodiscard]] std::vector<core::Role> all_roles();

}  // namespace polybed::multiscale
