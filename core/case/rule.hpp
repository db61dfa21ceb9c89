// Requirements on a scene, each stated once where it arises, and when it can be judged.
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

/// Paths of keys that are missing or wrong. A check that depends on one of them would only repeat the error.
class WrongKeys {
 public:
  void add(std::string path) { paths_.insert(std::move(path)); }

  /// True if none of these keys is wrong. \param path  a key, or the prefix of a table: "jet."
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

/// The violations of a rule by a scene, for example one for each of its jets. Nothing if the scene satisfies the rule.
class Broken {
 public:
  using Words = std::vector<std::string>;  ///< words of one violation, in the order of the gaps in the rule's message
  Broken() = default;
  struct Fault {
    Words words;
    std::optional<std::size_t> entry;  ///< index in the array of tables that the first key of the rule belongs to
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
  std::vector<std::string> keys;  ///< where it is reported, then others that it reads; not judged if one is wrong
  std::string message;            ///< with {} for each word
  std::function<Broken(const Scene&)> broken;  ///< wrong keys have their defaults
  /// Judged before the filling in. If a scene breaks it, rules that depend on its first key are not judged.
  bool first = false;

  /// The message with the words of each violation, at its place in the case.
  [[nodiscard]] std::vector<CaseProblem> problems(const Scene& scene) const;
};

/// A violation without words.
[[nodiscard]] inline Broken broken_if(bool broken) { return broken ? Broken(Broken::Words()) : Broken(); }

/// Problems from all rules that a scene breaks. \param wrong  keys whose rules are not judged
[[nodiscard]] std::vector<CaseProblem> problems_of(std::span<const Rule> rules, const Scene& scene,
                                                   const WrongKeys& wrong = {});

/// Texts of the problems, with their places.
[[nodiscard]] std::vector<std::string> texts_of(const std::vector<CaseProblem>& problems);

/// Throws CaseError with the problems from all rules that a scene breaks, if there are any.
void refuse(std::span<const Rule> rules, const Scene& scene);

/// Requirements of one model, besides those of every model.
struct ModelRules {
  std::string model;         ///< its command, "tfm"
  std::vector<Rule> cannot;  ///< limits of its equations: a scene that breaks one is for another model
  std::vector<Rule> rules;   ///< requirements of its keys, its effects and its start

  /// The problems that keep a scene from this model. A scene for another model gets only the problems in `cannot`.
  [[nodiscard]] std::vector<CaseProblem> problems(const Scene& scene, const WrongKeys& wrong = {}) const;
};

/// The rules that a case is judged by when it is read.
struct Rulebook {
  std::span<const Rule> rules = {};            ///< for every scene
  std::vector<const ModelRules*> models = {};  ///< the models that are to run it, or alternatives

  Rulebook() = default;
  Rulebook(const std::vector<Rule>& of_all, std::vector<const ModelRules*> of_models = {})
      : rules(of_all), models(std::move(of_models)) {}

  /// The problems of a scene: broken rules for every scene and, if there are such problems or no model can run it,
  /// broken rules of the models that suit it. \param more  there are problems besides these
  [[nodiscard]] std::vector<CaseProblem> refusals(const Scene& scene, const WrongKeys& wrong = {},
                                                  bool more = false) const;
};

}  // namespace polybed::core
