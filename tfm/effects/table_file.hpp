// Laws from a table in a file: "table:FILE".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/case/scene.hpp"

namespace polybed::tfm {

/// The file of a tabulated law; nothing for other laws.
[[nodiscard]] inline std::optional<std::string> table_file(const std::string& law) {
  constexpr std::string_view word = "table:";
  return law.starts_with(word) ? std::optional(law.substr(word.size())) : std::nullopt;
}

/// Why a table does not fit a scene as its solids_stress, or as its species_exchange; empty if it does, or if the file
/// cannot be read, which the model reports.
[[nodiscard]] std::string wrong_with_stress_table(const core::Scene& scene, const std::string& file);
[[nodiscard]] std::string wrong_with_exchange_table(const core::Scene& scene, const std::string& file);

}  // namespace polybed::tfm
