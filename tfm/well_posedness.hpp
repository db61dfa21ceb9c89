// Distance of the state from ill-posedness, where the averaged equations lose their real characteristics.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/numerics/reduction.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Least solids fraction in a cell of bed.
constexpr double bed_begins = 0.01;

/// The cell of the bed with the smallest G/G_crit of closures::critical_slope, G = dp_s/dphi. Several solids count as
/// one with their mean density and the velocity of their centre of mass. If cells share the smallest value, as all do
/// without stress, it is the one with the greatest G_crit.
struct WellPosedness {
  double least = std::numeric_limits<double>::infinity();  ///< infinite: no slip
  double critical_slope = 0;                               ///< G_crit there, Pa
  std::array<double, 3> place{};                           ///< its centre, m
  double share_below = 0;                                  ///< share of the bed's cells with G < G_crit

  /// Whether it is nearer to ill-posedness than another, or further beyond.
  [[nodiscard]] bool lacks_more_than(const WellPosedness& other) const {
    return least < other.least || (least == other.least && critical_slope > other.critical_slope);
  }
};

/// For the block, from fields of a finished evaluation; for the column once a reduction has combined the blocks. Empty
/// in form B, for which G_crit is not valid.
class WellPosednessOfBlocks {
 public:
  WellPosednessOfBlocks(const Constants& constants, const Fields& fields);
  void put_into(core::Reduction& all) { all.sum(numbers_); }
  [[nodiscard]] WellPosedness column() const;

 private:
  /// Cells of bed, those of them below 1, then the smallest value of each rank's block: all 0 except this rank's own.
  std::vector<double> numbers_;
};

/// Collective.
[[nodiscard]] WellPosedness well_posedness(const Constants& constants, const Fields& fields);

}  // namespace polybed::tfm
