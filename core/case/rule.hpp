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
#include <utility>
#include <vector>

#include "core/case/scene.hpp"
#include "core/error.hpp"

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
  struct Fault {
    Words words;
    std::optional<std::size_t> entry;  ///< of the array of tables that the first key of the rule belongs to
  };
  Broken(Words words) { add(std::move(words)); }
  void add(Words words, std::optional<std::size_t> entry = {}) { faults_.push_back({std::move(words), entry}); }
  explicit operator bool() const { return !faults_.empty(); }
  [[nodiscard]] const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// One requirement.
struct Rule {
  std::vector<std::string> keys;  ///< where it is reported, then those it rests on: it is not judged if one is wrong
  std::string message;            ///< with {} for each word
  std::function<Broken(const Scene&)> broken;  ///< values of keys that are wrong are at their defaults
  /// Judged before what follows from its keys is filled in. A scene that breaks it is judged by no rule that rests on
  /// the first of its keys.
  bool first = false;

  /// The message with the words of each fault, at its place in the case.
  [[nodiscard]] std::vector<CaseProblem> problems(const Scene& scene) const;
};

/// Broken without words.
[[nodiscard]] inline Broken broken_if(bool broken) { return broken ? Broken(Broken::Words()) : Broken(); }

/// Of all rules that a scene breaks. \param wrong  keys that no rule is judged by
[[nodiscard]] std::vector<CaseProblem> problems_of(std::span<const Rule> rules, const Scene& scene,
                                                   const WrongKeys& wrong = {});

/// Their texts, with their places.
[[nodiscard]] std::vector<std::string> texts_of(const std::vector<CaseProblem>& problems);

/// Throws CaseError with the problems of all rules that a scene breaks, if there are any.
void refuse(std::span<const Rule> rules, const Scene& scene);

/// What a model asks of a scene beyond what all models do.
struct ModelRules {
  std::string model;         ///< its command, "tfm"
  std::vector<Rule> cannot;  ///< what it has no equations for: a scene that breaks one of them is for another model
  std::vector<Rule> rules;   ///< what its keys, its effects and its start require

  /// What keeps a scene from the model; of a scene for another model only that.
  [[nodiscard]] std::vector<CaseProblem> problems(const Scene& scene, const WrongKeys& wrong = {}) const;
};

/// What a case is judged by as it is read.
struct Rulebook {
  std::span<const Rule> rules = {};            ///< of every scene
  std::vector<const ModelRules*> models = {};  ///< that are to run it, or of which one is

  Rulebook() = default;
  Rulebook(const std::vector<Rule>& of_all, std::vector<const ModelRules*> of_models = {})
      : rules(of_all), models(std::move(of_models)) {}

  /// What refuses a scene: the rules of every scene that it breaks and, if there are such or no model could run it,
  /// those of the models that it is for. \param more  there are problems beside these
  [[nodiscard]] std::vector<CaseProblem> refusals(const Scene& scene, const WrongKeys& wrong = {},
                                                  bool more = false) const;
};

}  // namespace polybed::core
