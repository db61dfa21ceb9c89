// JSON by nlohmann-json; an object keeps its members in the order in which they were given. A source that builds a
// value includes <nlohmann/json.hpp> itself: it takes more than a second to compile, which headers spare all others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace polybed::core {

using Json = nlohmann::ordered_json;

/// The value on one line; each number reads back to the bit. Throws NumericsError if a number is not finite. Bytes that
/// are no UTF-8, as the name of a file may have them, become U+FFFD.
[[nodiscard]] std::string json_text(const Json& value);
/// The same with null for each number that is not finite: the record of a run that failed over it.
[[nodiscard]] std::string json_text_with_nulls(const Json& value);

/// The number, or null without one.
[[nodiscard]] Json or_null(const std::optional<double>& number);
/// The text, or null in place of an empty one.
[[nodiscard]] Json text_or_null(const std::string& text);

/// Reads one value that is all of the text. Throws FileError with the place of what is no JSON, as of a text that ends
/// early or has brackets within brackets beyond all measure.
[[nodiscard]] Json parse_json(std::string_view text);

/// The same of a file; the error names it.
[[nodiscard]] Json read_json(const std::filesystem::path& path);

/// The same of a file that has to say of itself that it is of this type, and of version 1.
[[nodiscard]] Json read_json(const std::filesystem::path& path, const std::string& filetype);

/// The type that a file says it is of; throws FileError if it says none.
[[nodiscard]] std::string filetype_of(const std::filesystem::path& path);

/// What a value that was read is. Each throws FileError if it is something else, or if there is no such member.
[[nodiscard]] double number_of(const Json& value);
/// How often something was done.
[[nodiscard]] std::uint64_t count_of(const Json& value);
[[nodiscard]] const std::string& text_of(const Json& value);
[[nodiscard]] const std::vector<Json>& array_of(const Json& value);
[[nodiscard]] const Json& member_of(const Json& object, const std::string& name);

}  // namespace polybed::core
