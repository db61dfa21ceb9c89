#include "core/output/json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/output/files.hpp"

namespace polybed::core {

namespace {

constexpr int deepest = 100;  // nested brackets: copies and texts of values recurse

/// The library would write null. \param where  names and indices on the way to the value
void refuse_not_finite(const Json& value, const std::string& where) {
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    throw NumericsError(fmt::format("{} was about to be written as JSON, and is not finite",
                                    where.empty() ? "a number" : where.substr(1)));
  if (!value.is_structured()) return;
  for (const auto& [name, part] : value.items()) refuse_not_finite(part, where + "." + name);
}

/// The library's message without its error number.
std::string reason_of(const Json::exception& error) {
  const std::string_view text = error.what();
  const std::size_t end = text.find("] ");
  return std::string(end == std::string_view::npos ? text : text.substr(end + 2));
}

}  // namespace

std::string json_text(const Json& value) {
  refuse_not_finite(value, "");
  return json_text_with_nulls(value);
}

std::string json_text_with_nulls(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json or_null(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

Json parse_json(std::string_view text) {
  try {
    return Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
      if (depth > deepest) throw FileError("no JSON: too many brackets within brackets");
      return true;
    });
  } catch (const Json::exception& error) {
    throw FileError("no JSON: " + reason_of(error));
  }
}

Json read_json(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  try {
    return parse_json(text);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

Json read_json(const std::filesystem::path& path, const std::string& filetype) {
  Json value = read_json(path);
  try {
    if (text_of(member_of(value, "filetype")) == filetype && number_of(member_of(value, "version")) == 1) return value;
  } catch (const FileError&) {  // it has no type at all
  }
  throw FileError(fmt::format("{}: no \"{}\" of version 1", path.string(), filetype));
}

std::string filetype_of(const std::filesystem::path& path) { return text_of(member_of(read_json(path), "filetype")); }

double number_of(const Json& value) {
  if (!value.is_number()) throw FileError("expected a number");
  return value.get<double>();
}

std::uint64_t count_of(const Json& value) {
  if (!value.is_number_unsigned()) throw FileError("expected a count");
  return value.get<std::uint64_t>();
}

const std::string& text_of(const Json& value) {
  if (!value.is_string()) throw FileError("expected a text");
  return value.get_ref<const std::string&>();
}

const std::vector<Json>& array_of(const Json& value) {
  if (!value.is_array()) throw FileError("expected an array");
  return value.get_ref<const Json::array_t&>();
}

const Json& member_of(const Json& object, const std::string& name) {
  if (!object.is_object()) throw FileError("expected an object");
  const auto found = object.find(name);
  if (found == object.end()) throw FileError("no member " + name);
  return *found;
}

}  // namespace polybed::core
