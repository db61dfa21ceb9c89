// What the keys of [resolve] require of each other.
#pragma once

#include <vector>

#include "core/case/rule.hpp"

namespace polybed::multiscale {

/// Grids that resolve the pores and the Reynolds number, spheres of every species, and what moving and free spheres
/// need.
[[nodiscard]] std::vector<core::Rule> resolve_rules();

}  // namespace polybed::multiscale
