// Pairs that can touch before the list is rebuilt, pairs that touch now, and the stored data of each contact.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace polybed::dem {

/// Pairs of particles, or of a particle and a wall. The first of two particles has the lower id, on every rank, so that
/// a pair has one orientation and one history.
struct Contacts {
  struct Pair {
    std::int32_t first, second;  ///< particles; or a particle, and which wall
    std::int32_t image;          ///< of the second, which the first can touch (see Images)
    std::int32_t kind;           ///< pair of the two materials
  };
  std::vector<Pair> pairs;
  std::size_t inner = 0;               ///< pairs at the start of the list that need no ghost
  std::vector<std::int32_t> touching;  ///< pairs in contact (or within the range of cohesion), increasing
  std::vector<std::int32_t> touched;   ///< the same at the previous force
  std::vector<double> memory;          ///< memory_size numbers per pair; zero for pairs that do not touch
  int memory_size = 0;

  [[nodiscard]] double* memory_of(std::int32_t pair) { return memory.data() + std::ptrdiff_t(pair) * memory_size; }
  [[nodiscard]] const double* memory_of(std::int32_t pair) const {
    return memory.data() + std::ptrdiff_t(pair) * memory_size;
  }

  /// Clears the touching pairs before a force finds them.
  void begin_touching() {
    std::swap(touched, touching);
    touching.clear();
  }
  /// Calls act for each pair that touched at the previous force and no longer does. A step changes few of them, so
  /// equal stretches of both lists are skipped as a whole.
  template <class Act>
  void each_parted(Act&& act) const {
    constexpr std::ptrdiff_t stretch = 16;
    auto now = touching.begin();
    for (auto before = touched.begin(); before != touched.end();) {
      if (touched.end() - before >= stretch && touching.end() - now >= stretch) {
        std::int32_t differs = 0;
        for (std::ptrdiff_t k = 0; k < stretch; ++k) differs |= before[k] ^ now[k];
        if (differs == 0) {
          before += stretch;
          now += stretch;
          continue;
        }
      }
      while (now != touching.end() && *now < *before) ++now;
      if (now == touching.end() || *now != *before) act(*before);
      ++before;
    }
  }

  /// Clears the memory of pairs that have separated.
  void forget_parted() {
    if (memory_size == 0) return;
    each_parted([&](std::int32_t pair) { std::fill_n(memory_of(pair), memory_size, 0.0); });
  }
};

}  // namespace polybed::dem
