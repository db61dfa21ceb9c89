// What a scene must satisfy, stated once by whoever needs it, and when it may be judged.
#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

/// How often a scene breaks a rule: once for each of its jets, say. Nothing if the scene keeps it.
class Broken {
 public:
  using Words = std::vector<std::string>;  ///< of one fault, in the order of the gaps of the rule's message
  Broken() = default;
  Broken(Words words) { add(std::move(words)); }
  void add(Words words) { faults_.push_back(std::move(words)); }
  explicit operator bool() const { return !faults_.empty(); }
  [[nodiscard]] const std::vector<Words>& faults() const { return faults_; }

 private:
  std::vector<Words> faults_;
};

/// One requirement.
struct Rule {
  std::vector<std::string> keys;  ///< where it is reported, then those it rests on: it is not judged if one is wrong
  std::string message;            ///< with {} for each word
  std::function<Broken(const Scene&)> broken;  ///< values of keys that are wrong are at their defaults
  /// Judged before what follows from its keys is filled in. A scene that breaks it is judged by no rule that rests on
  /// the first of its keys.
  bool first = false;

  /// The message with the words of each fault.
  [[nodiscard]] std::vector<std::string> faults(const Scene& scene) const;
};

/// Broken without words.
[[nodiscard]] inline Broken broken_if(bool broken) { return broken ? Broken(Broken::Words()) : Broken(); }

/// The messages of all rules that a scene breaks.
[[nodiscard]] std::vector<std::string> faults_of(std::span<const Rule> rules, const Scene& scene);

/// Throws CaseError with them, if there are any: for scenes that no reader has seen.
void refuse(std::span<const Rule> rules, const Scene& scene);

}  // namespace polybed::core
