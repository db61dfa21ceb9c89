// Writes JSON: one value at a time, in the order given. A number that is not finite is refused.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace polybed::core {

class Json {
 public:
  Json& begin_object() { return open('{'); }
  Json& end_object() { return close('}'); }
  Json& begin_array() { return open('['); }
  Json& end_array() { return close(']'); }
  /// Name of the next value.
  Json& key(std::string_view name);
  Json& value(std::string_view text);
  Json& value(const char* text) { return value(std::string_view(text)); }
  Json& value(const std::string& text) { return value(std::string_view(text)); }
  Json& value(bool truth);
  Json& value(double number);  ///< 17 digits at most, shortest that reads back; throws NumericsError if not finite
  Json& value(std::int64_t number);
  Json& value(std::uint64_t number);
  Json& value(int number) { return value(std::int64_t(number)); }
  Json& value(const std::optional<double>& number) { return number ? value(*number) : null(); }
  Json& null();
  template <class T>
  Json& member(std::string_view name, const T& v) {
    return key(name).value(v);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  Json& open(char bracket);
  Json& close(char bracket);
  void separate();
  std::string text_;
  bool first_ = true, after_key_ = false;
};

}  // namespace polybed::core
