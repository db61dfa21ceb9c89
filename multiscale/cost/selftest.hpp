// The oracles of cost that need no run: what `polybed cost selftest` shows.
#pragma once

#include <string>
#include <vector>

namespace polybed::multiscale {

struct Oracle {
  std::string id, found, wanted;
  bool passed = false;
};

/// K1, K2, K3, K4, K5, K6, K7, K12, K13 and K14 of cost.md, section 10.
[[nodiscard]] std::vector<Oracle> pure_oracles();

/// K4 of them: a particle settles, by both integrators.
[[nodiscard]] Oracle settling_oracle();

/// All of them, as a table; whether all pass.
[[nodiscard]] bool print_selftest();

}  // namespace polybed::multiscale
