// JSON with nlohmann-json; an object keeps its members in the given order. A source that builds a value includes
// <nlohmann/json.hpp> itself: it takes more than a second to compile, which this header spares all others.
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

/// The value on one line; each number reads back to the bit. Throws NumericsError if a number is not finite. Invalid
/// UTF-8, which file names can contain, becomes U+FFFD.
[[nodiscard]] std::string json_text(const Json& value);
/// The same with null for each number that is not finite: for the record of a run that failed because of it.
[[nodiscard]] std::string json_text_with_nulls(const Json& value);

/// The number, or null without one.
[[nodiscard]] Json or_null(const std::optional<double>& number);
/// The text, or null in place of an empty one.
[[nodiscard]] Json text_or_null(const std::string& text);

/// Reads a text that is exactly one value. Throws FileError with the place of the error, also if the text ends early or
/// its brackets are nested too deep.
[[nodiscard]] Json parse_json(std::string_view text);

/// The same from a file; the error names it.
[[nodiscard]] Json read_json(const std::filesystem::path& path);

/// The same from a file that must state this type and version 1.
[[nodiscard]] Json read_json(const std::filesystem::path& path, const std::string& filetype);

/// The type that a file states; throws FileError if it states none.
[[nodiscard]] std::string filetype_of(const std::filesystem::path& path);

/// A value of a known type. Each throws FileError for another type or a missing member.
[[nodiscard]] double number_of(const Json& value);
/// A count.
[[nodiscard]] std::uint64_t count_of(const Json& value);
[[nodiscard]] const std::string& text_of(const Json& value);
[[nodiscard]] const std::vector<Json>& array_of(const Json& value);
[[nodiscard]] const Json& member_of(const Json& object, const std::string& name);

}  // namespace polybed::core
