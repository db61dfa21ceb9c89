// How far the state is from where the averaged equations lose their real characteristics, over the whole column.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/numerics/reduction.hpp"
#include "tfm/fields.hpp"

namespace polybed::tfm {

/// Fraction of solids from which a cell counts as bed.
constexpr double bed_begins = 0.01;

/// The cell of the bed with the smallest G/G_crit of closures::critical_slope, G = dp_s/dphi. Several solids enter as
/// one of their mean density and of the velocity of their centre of mass. Where cells share the smallest one, as all do
/// that no stress reaches, it is the one with the greatest G_crit.
struct WellPosedness {
  double least = std::numeric_limits<double>::infinity();  ///< infinite: nothing slips
  double critical_slope = 0;                               ///< G_crit there, Pa
  std::array<double, 3> place{};                           ///< its centre, m
  double share_below = 0;                                  ///< of the cells of the bed, those with G < G_crit

  /// Whether it is nearer to ill-posedness than another, or further beyond.
  [[nodiscard]] bool lacks_more_than(const WellPosedness& other) const {
    return least < other.least || (least == other.least && critical_slope > other.critical_slope);
  }
};

/// Of the block, from fields of a finished evaluation; of the column once a reduction has put the blocks together.
/// Nothing in form B, whose waves G_crit does not know.
class WellPosednessOfBlocks {
 public:
  WellPosednessOfBlocks(const Constants& constants, const Fields& fields);
  void put_into(core::Reduction& all) { all.sum(numbers_); }
  [[nodiscard]] WellPosedness column() const;

 private:
  /// Cells of bed, those of them below 1, then of each rank the smallest of its block: all 0 but this rank's own.
  std::vector<double> numbers_;
};

/// Collective.
[[nodiscard]] WellPosedness well_posedness(const Constants& constants, const Fields& fields);

}  // namespace polybed::tfm
