// Reads a case file, or a resolved case, into a scene, and reports everything that is wrong with it at once.
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

/// How roles are set that [effects] does not name and effects.others does not decide.
enum class OtherRoles { off, chosen };
/// The key in [effects] for this: "auto" chooses them, "none" turns them off.
inline constexpr const char* other_roles = "others";

/// Reads a case file. Throws CaseError with all problems (place, key, value, range, suggestion), FileError if
/// the file cannot be read.
/// \param overrides  "key=value" each, e.g. "inlet.superficial_velocity=37 mm/s",
/// "species.fine.diameter=1 mm"
/// \param roles      valid roles in [effects]
/// \param classes    rule that turns a size distribution into species; a case without it must have no distribution
/// \param rules      further rules of the scene and its models besides case_rules(); all are reported together
/// \param others     how roles are set that the case does not name
[[nodiscard]] Scene read_case(const std::filesystem::path& path, std::span<const std::string> overrides,
                              std::span<const Role> roles, const ClassRule& classes = {}, const Rulebook& rules = {},
                              OtherRoles others = OtherRoles::off);

/// The same from text; `name` is the file's in messages.
[[nodiscard]] Scene parse_case(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                               std::span<const Role> roles, const ClassRule& classes = {}, const Rulebook& rules = {},
                               OtherRoles others = OtherRoles::off);

/// The whole case in SI as TOML. It reads back to the same scene.
[[nodiscard]] std::string resolved_case(const Scene& scene);

/// FNV-1a hash of a text, 64 bits, as 16 hexadecimal digits.
[[nodiscard]] std::string text_hash(std::string_view text);

/// Hash of the resolved case and of the content of the law file that it names.
[[nodiscard]] std::string case_hash(const Scene& scene);

}  // namespace polybed::core
