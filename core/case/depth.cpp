#include "core/case/depth.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polybed::core {

namespace {

constexpr int deepest = 32;

/// Scans a text once and counts the levels that a parser would nest.
class DepthScanner {
 public:
  explicit DepthScanner(std::string_view text) : text_(text) {}

  /// The first place that is too deep, or npos.
  std::size_t find() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#')
        at_ = text_.find('\n', at_);
      else if (c == '"' || c == '\'')
        skip_text(c);
      else if (count(c))
        return at_;
      else
        ++at_;
    }
    return std::string_view::npos;
  }

 private:
  /// Returns true if this character exceeds the depth.
  bool count(char c) {
    if (c == '[' || c == '{') ++brackets_;
    if (c == ']' || c == '}') brackets_ = std::max(brackets_ - 1, 0);
    if (c == '.')
      ++dots_;
    else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos)
      dots_ = 0;
    return brackets_ > deepest || dots_ >= deepest;
  }

  /// Skips a text in quotes, on one line or on several.
  void skip_text(char quote) {
    const std::string three(3, quote);
    const bool lines = text_.substr(at_, 3) == three;
    const std::string_view end = lines ? std::string_view(three) : std::string_view(three).substr(0, 1);
    for (at_ += end.size(); at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"') {
        ++at_;
      } else if (text_.substr(at_, end.size()) == end) {
        at_ += end.size();
        return;
      } else if (text_[at_] == '\n' && !lines) {
        return;  // not closed: the parser reports it
      }
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int brackets_ = 0, dots_ = 0;
};

}  // namespace

std::optional<CaseProblem> too_deep(std::string_view text, const std::string& file) {
  const std::size_t at = DepthScanner(text).find();
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view before = text.substr(0, at);
  const std::size_t line_end = before.rfind('\n');
  const std::size_t column = line_end == std::string_view::npos ? at : at - line_end - 1;
  return CaseProblem{file, int(std::count(before.begin(), before.end(), '\n')) + 1, int(column) + 1,
                     fmt::format("nested more than {} deep: no key of a case is", deepest)};
}

}  // namespace polybed::core
