// Pairs that may touch before the list is made again, those that touch now, and what is kept of each contact.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace polybed::dem {

/// Pairs of particles, or of a particle and a wall. Of two particles the first has the lower id, on every rank, so that
/// a pair has one orientation and one history.
struct Contacts {
  struct Pair {
    std::int32_t first, second;  ///< particles; or a particle, and which wall
    std::int32_t image;          ///< of the second, that the first may touch (see Images)
    std::int32_t kind;           ///< of the two materials
  };
  std::vector<Pair> pairs;
  std::size_t inner = 0;               ///< pairs at the beginning of the list that need no ghost
  std::vector<std::int32_t> touching;  ///< pairs in contact (or within the reach of cohesion), rising
  std::vector<double> memory;          ///< memory_size numbers of each pair; zero of pairs that do not touch
  int memory_size = 0;

  [[nodiscard]] double* memory_of(std::int32_t pair) { return memory.data() + std::ptrdiff_t(pair) * memory_size; }
  [[nodiscard]] const double* memory_of(std::int32_t pair) const {
    return memory.data() + std::ptrdiff_t(pair) * memory_size;
  }

  /// Calls for each of the pairs that touched (`before`, rising) and do so no longer.
  template <class Act>
  void each_parted(std::span<const std::int32_t> before, Act&& act) const {
    auto now = touching.begin();
    for (const std::int32_t pair : before) {
      while (now != touching.end() && *now < pair) ++now;
      if (now == touching.end() || *now != pair) act(pair);
    }
  }

  /// Forgets the memory of pairs that have parted.
  void forget_parted(std::span<const std::int32_t> before) {
    if (memory_size == 0) return;
    each_parted(before, [&](std::int32_t pair) { std::fill_n(memory_of(pair), memory_size, 0.0); });
  }
};

}  // namespace polybed::dem
