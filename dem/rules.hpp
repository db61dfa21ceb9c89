// What the keys of [dem] require, of the effects that read them and whatever effects there are.
#pragma once

#include <vector>

#include "core/case/rule.hpp"

namespace polybed::dem {

[[nodiscard]] std::vector<core::Rule> key_rules();

}  // namespace polybed::dem
