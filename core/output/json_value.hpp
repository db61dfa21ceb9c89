// Reads JSON as this program writes it: the records of its runs.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace polybed::core {

/// One value with all that is in it.
class JsonValue {
 public:
  using Object = std::map<std::string, JsonValue>;
  using Array = std::vector<JsonValue>;

  JsonValue() = default;  ///< null
  explicit JsonValue(bool truth) : kind_(Kind::truth), truth_(truth) {}
  explicit JsonValue(double number) : kind_(Kind::number), number_(number) {}
  explicit JsonValue(std::string text) : kind_(Kind::text), text_(std::move(text)) {}
  explicit JsonValue(Array array) : kind_(Kind::array), array_(std::move(array)) {}
  explicit JsonValue(Object object) : kind_(Kind::object), object_(std::move(object)) {}

  /// Each throws FileError if it is something else, or if there is no such member.
  [[nodiscard]] double number() const { return checked(Kind::number, number_); }
  [[nodiscard]] bool truth() const { return checked(Kind::truth, truth_); }
  [[nodiscard]] const std::string& text() const { return checked(Kind::text, text_); }
  [[nodiscard]] const Array& array() const { return checked(Kind::array, array_); }
  [[nodiscard]] const Object& object() const { return checked(Kind::object, object_); }
  [[nodiscard]] const JsonValue& of(const std::string& member) const;
  [[nodiscard]] bool is_number() const { return kind_ == Kind::number; }
  [[nodiscard]] bool is_null() const { return kind_ == Kind::null; }

 private:
  enum class Kind { null, truth, number, text, array, object };

  template <class T>
  [[nodiscard]] const T& checked(Kind kind, const T& content) const {
    if (kind_ != kind) refuse(kind);
    return content;
  }
  [[noreturn]] static void refuse(Kind expected);

  Kind kind_ = Kind::null;
  bool truth_ = false;
  double number_ = 0;
  std::string text_;
  Array array_;
  Object object_;
};

/// Reads one value that is all of the text. Numbers are doubles: integers above 2^53 lose digits. Texts are UTF-8; of
/// the escapes \uXXXX those below 0x80. Throws FileError with the place, counted in bytes, of what is no JSON, as of a
/// text that ends early.
[[nodiscard]] JsonValue parse_json(std::string_view text);

/// The same of a file; the error names it.
[[nodiscard]] JsonValue read_json(const std::filesystem::path& path);

/// The same of a file that has to say of itself that it is of this type, and of version 1.
[[nodiscard]] JsonValue read_json(const std::filesystem::path& path, const std::string& filetype);

}  // namespace polybed::core
