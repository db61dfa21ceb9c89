// Sums of energies in a checkpoint.
#pragma once

#include <string>

#include "core/output/checkpoint.hpp"
#include "dem/energy_sum.hpp"

namespace polybed::dem {

/// Writes the sum over all ranks. Collective.
inline void write_sum(core::Checkpoint& checkpoint, const core::Ranks* ranks, const std::string& key,
                      const EnergySum& sum) {
  std::array<EnergySum, 1> all{sum};
  add_over_ranks(ranks, all);
  checkpoint.integers[key] = all[0].whole();
  checkpoint.integers[key + "_part"] = all[0].part();
}

/// The sum over all ranks, on the first; 0 on the others and for a checkpoint without it, for example one of particles
/// that were not sheared.
[[nodiscard]] inline EnergySum sum_on_first(const core::Ranks* ranks, const core::Checkpoint& checkpoint,
                                            const std::string& key) {
  const auto found = [&](const std::string& name) {
    return core::is_first(ranks) && checkpoint.integers.contains(name) ? checkpoint.integers.at(name) : 0;
  };
  return {found(key), found(key + "_part")};
}

/// Throws core::FileError if a checkpoint has no such sum.
inline void require_sum(const core::Checkpoint& checkpoint, const std::string& key) {
  (void)checkpoint.integer(key);
  (void)checkpoint.integer(key + "_part");
}

}  // namespace polybed::dem
