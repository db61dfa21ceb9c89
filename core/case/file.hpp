// Reads a case file, or a case resolved before, into a scene; finds everything that is wrong with it at once.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "core/case/registry.hpp"
#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "core/case/size_classes.hpp"
#include "core/error.hpp"

namespace polybed::core {

/// What becomes of the roles of [effects] that a case does not name, unless it says so itself by effects.others.
enum class OtherRoles { off, chosen };
/// The name in [effects] that says it: "auto", they are chosen; "none", they are off.
inline constexpr const char* other_roles = "others";

/// Reads a case file. Throws CaseError with all problems (place, key, value, range, suggestion), FileError if
/// the file cannot be read.
/// \param overrides  "key=value" each, e.g. "inlet.superficial_velocity=37 mm/s",
/// "species.fine.diameter=1 mm"
/// \param roles      what [effects] may name
/// \param classes    how a distribution of sizes becomes species; without it a case may have none
/// \param rules      what a scene and the models that are to run it must satisfy beyond case_rules(); reported with all others
/// \param others     what becomes of roles that the case does not name
[[nodiscard]] Scene read_case(const std::filesystem::path& path, std::span<const std::string> overrides,
                              std::span<const Role> roles, const ClassRule& classes = {}, const Rulebook& rules = {},
                              OtherRoles others = OtherRoles::off);

/// The same from text; `name` stands for the file in messages.
[[nodiscard]] Scene parse_case(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                               std::span<const Role> roles, const ClassRule& classes = {}, const Rulebook& rules = {},
                               OtherRoles others = OtherRoles::off);

/// The whole case in SI as TOML; reads back to the same scene.
[[nodiscard]] std::string resolved_case(const Scene& scene);

/// FNV-1a hash of a text, 64 bits, as 16 hexadecimal digits.
[[nodiscard]] std::string text_hash(std::string_view text);

/// Of the case written out whole and of the law file that it names, by content.
[[nodiscard]] std::string case_hash(const Scene& scene);

}  // namespace polybed::core
