// Requirements between the keys of [resolve].
#pragma once

#include <vector>

#include "core/case/rule.hpp"

namespace polybed::multiscale {

/// Grids that resolve the pores and the Reynolds number, spheres of every species, and requirements of moving and free
/// spheres.
[[nodiscard]] std::vector<core::Rule> resolve_rules();

}  // namespace polybed::multiscale
