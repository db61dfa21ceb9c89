// How deep a case nests, before a parser follows it down: one that recurses would run out of its stack.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace polybed::core {

/// Where a TOML text has a key of more than 32 parts, or more than 32 brackets within brackets; nothing if nowhere.
/// Deeper than any key of a case. Texts in quotes and comments do not count.
/// \param file  stands for the text in the problem
[[nodiscard]] std::optional<CaseProblem> too_deep(std::string_view text, const std::string& file);

}  // namespace polybed::core
