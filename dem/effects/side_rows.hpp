// Stored data of side forces per particle: the sum of the forces, then the memory of each effect. They move with their
// particle from rank to rank and into a checkpoint.
#pragma once

#include <algorithm>
#include <cstddef>
#include <unordered_map>
#include <vector>

#include "dem/particles.hpp"

namespace polybed::dem {

struct SideRows {
  static constexpr std::size_t force_size = 3;  ///< first in a row, N
  std::size_t width = 0;                        ///< numbers per particle; 0 without an effect
  std::vector<double> numbers;

  [[nodiscard]] double* of(std::size_t i) { return numbers.data() + i * width; }
  [[nodiscard]] const double* of(std::size_t i) const { return numbers.data() + i * width; }
  [[nodiscard]] Vector force(std::size_t i) const { return {of(i)[0], of(i)[1], of(i)[2]}; }
  void clear(std::size_t particles) { numbers.assign(particles * width, 0.0); }
};

/// Rows that begin with the id of their particle, in any order.
struct KeptRows {
  std::size_t width = 0;  ///< including the id; 0: no data
  std::vector<double> numbers;

  [[nodiscard]] std::size_t count() const { return width == 0 ? 0 : numbers.size() / width; }
  [[nodiscard]] const double* of(std::size_t n) const { return numbers.data() + n * width; }
};

/// Rows of the owned particles, in their order.
[[nodiscard]] inline KeptRows keep(const Particles& particles, const SideRows& rows) {
  KeptRows kept;
  if (rows.width == 0) return kept;
  kept.width = rows.width + 1;
  kept.numbers.reserve(particles.owned * kept.width);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    kept.numbers.push_back(double(particles.id[i]));
    kept.numbers.insert(kept.numbers.end(), rows.of(i), rows.of(i) + rows.width);
  }
  return kept;
}

/// Restores the rows of the owned particles; zeros for others.
inline void recall(const KeptRows& kept, const Particles& particles, SideRows& rows) {
  if (rows.width == 0) return;
  std::unordered_map<std::int64_t, std::size_t> found;
  found.reserve(kept.count());
  for (std::size_t n = 0; n < kept.count(); ++n) found[std::int64_t(kept.of(n)[0])] = n;
  rows.clear(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i)
    if (const auto at = found.find(particles.id[i]); at != found.end())
      std::copy_n(kept.of(at->second) + 1, rows.width, rows.of(i));
}

}  // namespace polybed::dem
