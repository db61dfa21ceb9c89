// What the keys of a case require of each other, whatever the laws of its effects and whichever model runs it.
#pragma once

#include <span>
#include <vector>

#include "core/case/rule.hpp"

namespace polybed::core {

/// All of them; the reader judges them in this order, those first that the filling in rests on.
[[nodiscard]] std::span<const Rule> case_rules();

// The parts of the list.
[[nodiscard]] std::vector<Rule> column_rules();   ///< its axes, gravity, ends and sides; the fluid; times
[[nodiscard]] std::vector<Rule> opening_rules();  ///< jets, feeds, an opening of the bottom
[[nodiscard]] std::vector<Rule> wall_rules();     ///< a round column, and walls inside
[[nodiscard]] std::vector<Rule> bed_rules();      ///< species, pairs of them, how much there is and where
[[nodiscard]] std::vector<Rule> layer_rules();    ///< [[layer]]: what it contains and where it lies
[[nodiscard]] std::vector<Rule> idle_rules();     ///< keys that cannot act beside others

}  // namespace polybed::core
