// Random numbers that depend on their place in a sequence, not on the order of the draws: the same seed gives the same
// numbers on any number of ranks.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace polybed::core {

/// Mixes 64 bits thoroughly (splitmix64; Steele, Lea and Flood, OOPSLA 2014).
[[nodiscard]] constexpr std::uint64_t mixed_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The number of a sequence at an index, uniform in [0, 1).
[[nodiscard]] constexpr double uniform(std::uint64_t seed, std::uint64_t sequence, std::uint64_t index) {
  return double(mixed_bits(mixed_bits(mixed_bits(seed) ^ sequence) + index) >> 11) * 0x1p-53;
}

/// Likewise from the normal distribution with mean 0 and deviation 1 (Box and Muller, 1958).
[[nodiscard]] inline double normal(std::uint64_t seed, std::uint64_t sequence, std::uint64_t index) {
  const double radius = std::sqrt(-2 * std::log(1 - uniform(seed, sequence, 2 * index)));
  return radius * std::cos(2 * std::numbers::pi * uniform(seed, sequence, 2 * index + 1));
}

}  // namespace polybed::core
