// Stores the fluid's loads on each particle while particles change places and ranks.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "dem/coupling/fluid_motion.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

struct KeptLoad {
  std::int64_t id;
  FluidLoad load;
};

/// Loads of the owned particles, in their order.
[[nodiscard]] inline std::vector<KeptLoad> keep(const Particles& particles, const std::vector<FluidLoad>& loads) {
  std::vector<KeptLoad> kept;
  kept.reserve(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) kept.push_back({particles.id[i], loads[i]});
  return kept;
}

/// Restores the loads of the owned particles; others without stored loads stay unchanged.
inline void recall(const std::vector<KeptLoad>& kept, const Particles& particles, std::vector<FluidLoad>& loads) {
  std::unordered_map<std::int64_t, const FluidLoad*> found;
  found.reserve(kept.size());
  for (const KeptLoad& k : kept) found[k.id] = &k.load;
  loads.assign(particles.owned, FluidLoad{});
  for (std::size_t i = 0; i < particles.owned; ++i)
    if (const auto at = found.find(particles.id[i]); at != found.end()) loads[i] = *at->second;
}

}  // namespace polybed::dem
