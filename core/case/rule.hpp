// Faults that are found in a case beyond its single values, and when they may be looked for.
#pragma once

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <set>
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

/// A fault of a scene that only those who know the laws can find.
struct SceneFault {
  std::string key;                    ///< where it is reported, e.g. "effects.rolling"
  std::vector<std::string> rests_on;  ///< other keys; the fault is not reported while one of them is wrong itself
  std::string message;
};

/// The faults of a scene. The laws belong to upper folders: the case file is given the rule, as it is given the roles.
/// Values of keys that are wrong are at their defaults.
using SceneRule = std::function<std::vector<SceneFault>(const Scene&)>;

/// Throws CaseError with all of the faults, if there are any.
void refuse(const std::vector<SceneFault>& faults);

}  // namespace polybed::core
