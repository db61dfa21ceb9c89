// Forms of drag laws with fitted constants.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "closures/drag.hpp"

namespace polybed::closures {

struct DragFormConstant {
  std::string name;
  double published;  ///< above 0, as every constant in a form must be
};

struct DragForm {
  std::string name;  ///< of the law with the published constants
  std::vector<DragFormConstant> constants;
};

[[nodiscard]] std::vector<DragForm> drag_forms();

/// A form with other constants: a law for one size and for mixtures. Throws std::invalid_argument for an unknown form,
/// and for a constant that is missing, unknown, or not above 0.
[[nodiscard]] DragLaw fitted_drag_law(std::string_view form, const std::map<std::string, double>& constants,
                                      Guard guard);

/// A point at which the base law is not above 0, not finite, or gives a force that decreases with velocity; nothing if
/// there is no such point for voidage 0.1 to 1 and Re 0 to 1e5. A solver cannot run with such a law.
struct UnusableAt {
  double voidage, reynolds, f;
};
[[nodiscard]] std::optional<UnusableAt> unusable_at(const DragLaw& law);

}  // namespace polybed::closures
