// The nesting depth of a case, checked before a parser runs: a recursive parser would run out of its stack.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace polybed::core {

/// Place where a TOML text has a key of more than 32 parts, or more than 32 nested brackets; nothing if there is none.
/// No key of a case is that deep. Texts in quotes and comments do not count.
/// \param file  name of the text in the problem
[[nodiscard]] std::optional<CaseProblem> too_deep(std::string_view text, const std::string& file);

}  // namespace polybed::core
