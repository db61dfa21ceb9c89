#include "core/output/json_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

#include "core/error.hpp"
#include "core/output/files.hpp"

namespace polybed::core {

namespace {

constexpr int deepest = 100;  // brackets within brackets: a damaged file does not exhaust the stack

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  JsonValue all() {
    JsonValue found = value();
    if (next() != '\0') fail("something after the end");
    return found;
  }

 private:
  [[noreturn]] void fail(const char* why) const { throw FileError(fmt::format("no JSON at byte {}: {}", at_, why)); }

  /// The next character that is no space, not taken; 0 at the end.
  char next() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool take(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }

  void expect(char c) {
    if (!take(c)) fail("a bracket, comma, colon or quotation mark is missing");
  }

  bool take_word(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  JsonValue value() {
    const char c = next();
    if (c == '{') return object();
    if (c == '[') return array();
    if (c == '"') return JsonValue(text());
    if (take_word("true")) return JsonValue(true);
    if (take_word("false")) return JsonValue(false);
    if (take_word("null")) return {};
    return number();
  }

  JsonValue number() {
    double found = 0;
    if (const char c = next(); c != '-' && (c < '0' || c > '9')) fail("a value is missing");
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), found);
    if (error != std::errc()) fail("no number");
    at_ += std::size_t(end - begin);
    return JsonValue(found);
  }

  std::string text() {
    expect('"');
    std::string found;
    while (at_ < text_.size() && text_[at_] != '"') found += text_[at_] == '\\' ? escaped() : text_[at_++];
    if (at_ == text_.size()) fail("a text does not end");
    ++at_;
    return found;
  }

  char escaped() {
    ++at_;
    const char c = at_ < text_.size() ? text_[at_++] : '\0';
    if (c == 'u') return by_number();
    constexpr std::string_view letters = "\"\\/nrtbf", meanings = "\"\\/\n\r\t\b\f";
    const std::size_t n = letters.find(c);
    if (n == std::string_view::npos) fail("an unknown escape");
    return meanings[n];
  }

  char by_number() {
    unsigned code = 0;
    const std::string_view digits = text_.substr(std::min(at_, text_.size()), 4);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (digits.size() != 4 || error != std::errc() || end != digits.data() + 4 || code > 0x7f)
      fail("an unknown escape");
    at_ += 4;
    return char(code);
  }

  JsonValue object() {
    const Depth depth(*this);
    JsonValue::Object found;
    expect('{');
    if (take('}')) return JsonValue(std::move(found));
    do {
      if (next() != '"') fail("a name is missing");
      std::string name = text();
      expect(':');
      found.insert_or_assign(std::move(name), value());
    } while (take(','));
    expect('}');
    return JsonValue(std::move(found));
  }

  JsonValue array() {
    const Depth depth(*this);
    JsonValue::Array found;
    expect('[');
    if (take(']')) return JsonValue(std::move(found));
    do found.push_back(value());
    while (take(','));
    expect(']');
    return JsonValue(std::move(found));
  }

  struct Depth {
    explicit Depth(Parser& p) : parser(p) {
      if (++parser.depth_ > deepest) parser.fail("too many brackets within brackets");
    }
    ~Depth() { --parser.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    Parser& parser;
  };

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

void JsonValue::refuse(Kind expected) {
  constexpr std::array<const char*, 6> names{"null", "true or false", "a number", "a text", "an array", "an object"};
  throw FileError(fmt::format("expected {}", names[std::size_t(expected)]));
}

const JsonValue& JsonValue::of(const std::string& member) const {
  const auto found = object().find(member);
  if (found == object().end()) throw FileError("no member " + member);
  return found->second;
}

JsonValue parse_json(std::string_view text) { return Parser(text).all(); }

JsonValue read_json(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  try {
    return parse_json(text);
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

JsonValue read_json(const std::filesystem::path& path, const std::string& filetype) {
  JsonValue value = read_json(path);
  try {
    if (value.of("filetype").text() == filetype && value.of("version").number() == 1) return value;
  } catch (const FileError&) {  // it does not even say
  }
  throw FileError(fmt::format("{}: no \"{}\" of version 1", path.string(), filetype));
}

}  // namespace polybed::core
