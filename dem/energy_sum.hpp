// A sum of energies over a whole run, the same to the bit in any order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/numerics/ranks.hpp"

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
  /// The same for many, fewer than 2^33, times `per_energy`; none waits for the previous one.
  void add(std::span<const double> energies, double per_energy) {
    std::int64_t whole = 0, part = 0;
    for (const double energy : energies) {
      const double units = energy * per_energy;
      const auto cut = std::int64_t(units);
      whole += cut;
      part += std::int64_t((units - double(cut)) * parts);
    }
    add(EnergySum(whole, part));
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
