// Values in a case file: converts a TOML node to the kind of its key, or reports a problem with place and suggestion.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/case/keys.hpp"
#include "core/case/places.hpp"
#include "core/error.hpp"

namespace polybed::core {

/// A node's text for messages, one line, cut when long.
[[nodiscard]] std::string shown(const toml::node& node);

/// Reads values and collects their problems.
class CaseValues {
 public:
  explicit CaseValues(std::string file) : file_(std::move(file)) {}

  /// The value of a node, as the kind of the key requires; nothing after a problem.
  Value read(const Key& key, const toml::node& node);

  /// Place of a node; a region of the command line has no line.
  [[nodiscard]] Place place_of(const toml::source_region& region) const;
  /// Reports a problem at a place.
  void add(const toml::source_region& place, std::string message);
  /// Reports a problem with the file as a whole.
  void add(std::string message) { add(toml::source_region{}, std::move(message)); }
  [[nodiscard]] std::vector<CaseProblem>& problems() { return problems_; }

 private:
  std::optional<double> number(const Key& key, const toml::node& node);
  std::optional<std::int64_t> count(const Key& key, const toml::node& node);
  std::optional<bool> truth(const Key& key, const toml::node& node);
  std::optional<std::string> text(const Key& key, const toml::node& node);
  /// A table in time: a number (for all times), or pairs [time, value] with times that do not decrease.
  std::optional<Points> points(const Key& key, const toml::node& node);
  /// A sieve analysis: pairs [opening, share] with rising openings; shares sum to 1, the last is 0.
  std::optional<Points> sieves(const Key& key, const toml::node& node);
  void expected(const Key& key, const toml::node& node, std::string_view what);
  std::string file_;
  std::vector<CaseProblem> problems_;
};

}  // namespace polybed::core
