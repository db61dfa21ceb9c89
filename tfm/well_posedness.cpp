#include "tfm/well_posedness.hpp"

#include <algorithm>
#include <cmath>

#include "closures/well_posedness.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// The solids in one cell as one.
struct Mixture {
  double fraction = 0, density = 0, slip = 0;
};

Mixture mixture_in(const Constants& constants, const Fields& fields, Index c) {
  Mixture mixture;
  double mass = 0;
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double phi = std::max(fields.solids.fraction[j][std::size_t(c)], 0.0);
    mixture.fraction += phi;
    mass += phi * constants.density[j];
  }
  if (!(mass > 0)) return {};
  mixture.density = mass / mixture.fraction;
  double squares = 0;
  for (int axis = 0; axis < constants.grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = constants.grid.stride(axis);
    const auto mean = [&](const core::FaceField& u) { return 0.5 * (u[a][std::size_t(c)] + u[a][std::size_t(c + s)]); };
    double slip = mean(fields.fluid.velocity);
    for (std::size_t j = 0; j < constants.species(); ++j)
      slip -= std::max(fields.solids.fraction[j][std::size_t(c)], 0.0) * constants.density[j] / mass *
              mean(fields.solids.velocity[j]);
    squares += slip * slip;
  }
  mixture.slip = std::sqrt(squares);
  return mixture;
}

/// The smallest value in this rank's block, its cells of bed, and those of them below 1.
struct Block {
  WellPosedness nearest;
  double cells = 0, below = 0;
};

Block look_at_block(const Constants& constants, const Fields& fields) {
  const core::Grid& grid = constants.grid;
  Block block;
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const Index c = grid.index(i, j, k);
        const Mixture here = mixture_in(constants, fields, c);
        if (here.fraction < bed_begins || here.fraction >= 1) continue;
        ++block.cells;
        const double critical =
            closures::critical_slope(here.fraction, here.density, constants.fluid.density, here.slip);
        const double slope = fields.stress.present() ? std::max(fields.stress.slope[std::size_t(c)], 0.0) : 0.0;
        if (!(critical > 0)) continue;
        if (slope < critical) ++block.below;
        const WellPosedness found{
            slope / critical, critical, {grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)}};
        if (found.lacks_more_than(block.nearest)) block.nearest = found;
      }
  return block;
}

}  // namespace

namespace {
constexpr std::size_t counts = 2, per_rank = 5;
}

WellPosednessOfBlocks::WellPosednessOfBlocks(const Constants& constants, const Fields& fields) {
  if (constants.form_b) return;
  const Block block = look_at_block(constants, fields);
  const core::Ranks* ranks = constants.grid.ranks.get();
  const auto rank = std::size_t(ranks != nullptr ? ranks->rank() : 0);
  numbers_.assign(counts + per_rank * std::size_t(ranks != nullptr ? ranks->count() : 1), 0.0);
  numbers_[0] = block.cells;
  numbers_[1] = block.below;
  const WellPosedness& here = block.nearest;
  const std::array own{here.least, here.critical_slope, here.place[0], here.place[1], here.place[2]};
  std::copy(own.begin(), own.end(), &numbers_[counts + per_rank * rank]);
}

WellPosedness WellPosednessOfBlocks::column() const {
  WellPosedness nearest;
  for (std::size_t n = counts; n < numbers_.size(); n += per_rank) {
    const double* own = &numbers_[n];
    const WellPosedness found{own[0], own[1], {own[2], own[3], own[4]}};
    if (found.lacks_more_than(nearest)) nearest = found;
  }
  if (!numbers_.empty() && numbers_[0] > 0) nearest.share_below = numbers_[1] / numbers_[0];
  return nearest;
}

WellPosedness well_posedness(const Constants& constants, const Fields& fields) {
  WellPosednessOfBlocks blocks(constants, fields);
  core::Reduction all;
  blocks.put_into(all);
  all.over(constants.grid.ranks.get());
  return blocks.column();
}

}  // namespace polybed::tfm
