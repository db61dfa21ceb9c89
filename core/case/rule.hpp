// What a scene must satisfy, stated once by whoever needs it, and when it may be judged.
#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::core {

/// Paths of keys that are missing or have a wrong value: a check that rests on one of them would only repeat the fault.
class WrongKeys {
 public:
  void add(std::string path) { paths_.insert(std::move(path)); }

  /// True if none of these keys is wrong. \param path  of a key, or of all keys of a table: "jet."
  [[nodiscard]] bool sound(std::string_view path) const {
    const auto found = paths_.lower_bound(path);
    return found == paths_.end() || !(path.ends_with('.') ? found->starts_with(path) : *found == path);
  }
  [[nodiscard]] bool sound(std::initializer_list<std::string_view> paths) const {
    return std::all_of(paths.begin(), paths.end(), [this](std::string_view path) { return sound(path); });
  }

 private:
  std::set<std::string, std::less<>> paths_;
};

/// The words of a rule that a scene breaks, in the order of its gaps; empty if the scene keeps it.
using Broken = std::optional<std::vector<std::string>>;

/// One requirement.
struct Rule {
  std::vector<std::string> keys;  ///< where it is reported, then those it rests on: it is not judged if one is wrong
  std::string message;            ///< with {} for each word
  std::function<Broken(const Scene&)> broken;  ///< values of keys that are wrong are at their defaults

  /// The message with its words; empty if the scene keeps the rule.
  [[nodiscard]] std::string fault(const Scene& scene) const;
};

/// Broken without words.
[[nodiscard]] inline Broken broken_if(bool broken) { return broken ? Broken(std::in_place) : std::nullopt; }

/// Throws CaseError with the messages of all rules that a scene breaks, if there are any: for scenes that no reader has
/// seen.
void refuse(std::span<const Rule> rules, const Scene& scene);

}  // namespace polybed::core
