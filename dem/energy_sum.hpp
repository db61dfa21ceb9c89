// A sum of energies over a whole run, the same to the bit in any order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/numerics/ranks.hpp"
#include "dem/several.hpp"

namespace polybed::dem {

/// Whole units and fractions of one. The unit suits the greatest possible sum; the energy of one contact or kick can be
/// far smaller, millions of them in a step, and would vanish or drift if cut to whole units.
class EnergySum {
 public:
  static constexpr int part_bits = 30;
  static constexpr double parts = std::int64_t(1) << part_bits;  ///< per unit

  EnergySum() = default;
  EnergySum(std::int64_t whole, std::int64_t part) : whole_(whole), part_(part) { carry(); }

  /// \param units  below 2^63
  void add(double units) {
    const auto whole = std::int64_t(units);
    whole_ += whole;
    part_ += std::int64_t((units - double(whole)) * parts);
    carry();
  }
  /// The same for many, fewer than 2^25, times `per_energy`: in doubles if these contain each sum exactly.
  void add(std::span<const double> energies, double per_energy) {
    const std::size_t in_fours = energies.size() / 4 * 4;
    Four all{}, wholes{}, some{};
    for (std::size_t n = 0; n < in_fours; n += 4) {
      Four units;
      get_four(energies.data() + n, units);
      units *= per_energy;
      const Four size = units < 0 ? -units : units, whole = cut(size), part = cut((size - whole) * parts);
      all += size;
      wholes += units < 0 ? -whole : whole;
      some += units < 0 ? -part : part;
    }
    const bool exact = all[0] + all[1] + all[2] + all[3] < 0x1p52;
    if (exact)
      for (std::size_t k = 0; k < 4; ++k) add(EnergySum(std::int64_t(wholes[k]), std::int64_t(some[k])));
    for (const double energy : energies.subspan(exact ? in_fours : 0)) add(energy * per_energy);
  }
  void add(const EnergySum& other) {
    whole_ += other.whole_;
    part_ += other.part_;
    carry();
  }

  [[nodiscard]] double units() const { return double(whole_) + double(part_) / parts; }
  [[nodiscard]] std::int64_t whole() const { return whole_; }
  /// 0 <= part < parts.
  [[nodiscard]] std::int64_t part() const { return part_; }
  bool operator==(const EnergySum&) const = default;

 private:
  /// The whole part of 0 <= x < 2^52.
  [[gnu::always_inline]] static Four cut(const Four& x) {
    const Four near = x + 0x1p52 - 0x1p52;
    return near > x ? near - 1 : near;
  }
  void carry() {
    whole_ += part_ >> part_bits;
    part_ &= (std::int64_t(1) << part_bits) - 1;
  }

  std::int64_t whole_ = 0, part_ = 0;
};

/// Collective: the sum over all ranks, on each of them.
template <std::size_t count>
void add_over_ranks(const core::Ranks* ranks, std::array<EnergySum, count>& sums) {
  std::array<std::int64_t, 2 * count> numbers;
  for (std::size_t n = 0; n < count; ++n) {
    numbers[2 * n] = sums[n].whole();
    numbers[2 * n + 1] = sums[n].part();
  }
  core::add_over_ranks(ranks, numbers);
  for (std::size_t n = 0; n < count; ++n) sums[n] = EnergySum(numbers[2 * n], numbers[2 * n + 1]);
}

}  // namespace polybed::dem
