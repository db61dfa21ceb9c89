// How far neighbours have moved relative to each other: a bed that circulates as a whole keeps its list of pairs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "dem/box.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// The box in blocks. Particles in one block or in adjacent ones approach by no more than their displacements differ;
/// others are too far apart to meet while none moves by more than far().
class Company {
 public:
  /// \param diameter  the greatest, m  \param reach  of the longest pair effect plus the skin, m
  /// \param particles  of all ranks: not many more blocks
  Company(const Box& box, double diameter, double reach, std::size_t particles);

  /// Stores the places of the owned particles when their list is made.
  void mark(const Particles& particles);

  /// Displacements since then, m.
  struct Moved {
    double apart;  ///< upper bound of the approach of two particles that were less than far() from each other
    double most;   ///< greatest of a particle
  };
  /// The same on any number of ranks, and collective. Without ranks NaN if a displacement is.
  [[nodiscard]] Moved since(const Particles& particles, const core::Ranks* ranks) const;
  /// Displacement up to which only particles in adjacent blocks can meet, m.
  [[nodiscard]] double far() const { return far_; }

 private:
  [[nodiscard]] std::int32_t block_of(const Vector& x) const;

  std::array<int, 3> count_{};
  std::array<bool, 3> joined_;
  Vector inverse_{};  ///< blocks per length, 1/m
  double far_;
  std::vector<Vector> marked_;
  std::vector<std::int32_t> block_;  ///< of each owned particle when marked
};

}  // namespace polybed::dem
