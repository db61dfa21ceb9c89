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

/// Divides the box into blocks. Two particles in the same block or in adjacent ones approach each other by at most the
/// difference of their displacements; all others cannot meet as long as none moves further than far().
class RelativeMotion {
 public:
  /// \param diameter  the greatest, m  \param reach  of the longest pair effect plus the skin, m
  /// \param particles  number on all ranks; there are not many more blocks
  RelativeMotion(const Box& box, double diameter, double reach, std::size_t particles);

  /// Stores the places of the owned particles when their list is made.
  void mark(const Particles& particles);

  /// Displacements since then, m.
  struct Moved {
    double apart;  ///< greatest difference between two particles in the same block or in adjacent ones
    double most;   ///< greatest of one particle
  };
  /// Collective; the same on any number of ranks. On one rank NaN if a displacement is NaN.
  [[nodiscard]] Moved since(const Particles& particles, const core::Ranks* ranks) const;
  /// Displacement up to which only particles in the same block or in adjacent ones can meet, m.
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
