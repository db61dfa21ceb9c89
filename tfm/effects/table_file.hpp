// Laws that are a table in a file: "table:FILE".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/case/scene.hpp"

namespace polybed::tfm {

/// The file of a law that is a table; nothing if it is none.
[[nodiscard]] inline std::optional<std::string> table_file(const std::string& law) {
  constexpr std::string_view word = "table:";
  return law.starts_with(word) ? std::optional(law.substr(word.size())) : std::nullopt;
}

/// Throws core::CaseError unless a table of sheared particles is of the scene's regime: the other misses the stress by
/// factors.
void require_regime(const core::Scene& scene, const std::string& role, const std::string& file, core::BoxRegime regime);

}  // namespace polybed::tfm
