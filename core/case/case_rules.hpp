// The rules between the keys of a case that do not depend on the laws of its effects or on the model that runs it.
#pragma once

#include <span>
#include <vector>

#include "core/case/rule.hpp"

namespace polybed::core {

/// All rules. The reader judges them in this order, which starts with those that the filling in depends on.
[[nodiscard]] std::span<const Rule> case_rules();

// The parts of the list.
[[nodiscard]] std::vector<Rule> column_rules();   ///< the column's axes, gravity, ends and sides; the fluid; times
[[nodiscard]] std::vector<Rule> opening_rules();  ///< jets, feeds, an opening of the bottom
[[nodiscard]] std::vector<Rule> wall_rules();     ///< a round column, and walls inside
[[nodiscard]] std::vector<Rule> bed_rules();      ///< species, pairs of species, the amount of solids and its position
[[nodiscard]] std::vector<Rule> layer_rules();    ///< [[layer]]: what it contains and where it lies
[[nodiscard]] std::vector<Rule> idle_rules();     ///< keys that cannot act together with others

}  // namespace polybed::core
