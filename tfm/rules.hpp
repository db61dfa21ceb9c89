// What the keys of [tfm] and the start of a bed require, whatever effects there are.
#pragma once

#include <vector>

#include "core/case/rule.hpp"

namespace polybed::tfm {

[[nodiscard]] std::vector<core::Rule> key_rules();

/// Of the solids at the start: a run stops where they lie too far above the maximum packing.
[[nodiscard]] std::vector<core::Rule> start_rules();

}  // namespace polybed::tfm
