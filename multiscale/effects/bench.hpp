// What each effect costs on this machine: short runs with and without it.
#pragma once

#include <string>
#include <vector>

#include "core/output/json.hpp"

namespace polybed::multiscale {

/// What the cost of an effect is of; a cell is the two-fluid model's, the others are the particle model's.
enum class CostUnit { particle, contact, cell };

struct EffectCost {
  std::string effect, law;
  CostUnit unit{};
  double nanoseconds = 0;  ///< of each step (of the two-fluid model: of each right-hand side), over the same without
  double spread = 0;       ///< of the least times from the next: less than this is nothing
  std::size_t bytes = 0;   ///< kept of each particle or contact

  [[nodiscard]] std::string model() const;
  [[nodiscard]] std::string per() const;  ///< the unit in words
};

/// \param rounds  repetitions, each of all runs in turn
[[nodiscard]] std::vector<EffectCost> bench_effects(int rounds);

[[nodiscard]] std::string bench_table(const std::vector<EffectCost>& costs);
void write_bench(core::Json& json, const std::vector<EffectCost>& costs);

}  // namespace polybed::multiscale
