// What the keys of [tfm] and the start of a bed require, whatever effects there are.
#pragma once

#include <string>
#include <vector>

#include "core/case/rule.hpp"

namespace polybed::tfm {

[[nodiscard]] std::vector<core::Rule> key_rules();

/// Of the solids at the start: a run stops where they lie too far above the maximum packing.
[[nodiscard]] std::vector<core::Rule> start_rules();

/// What is wrong with a relative tolerance of implicit steps; empty where nothing is.
[[nodiscard]] std::string wrong_with_implicit_tolerance(double rtol);

}  // namespace polybed::tfm
