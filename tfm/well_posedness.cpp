#include "tfm/well_posedness.hpp"

#include <algorithm>
#include <cmath>

#include "closures/well_posedness.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// The solids of one cell taken as one.
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

/// The smallest of this rank's block, the cells of bed in it, and those of them below 1.
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

WellPosedness well_posedness(const Constants& constants, const Fields& fields) {
  if (constants.form_b) return {};
  const core::Grid& grid = constants.grid;
  const Block block = look_at_block(constants, fields);
  WellPosedness nearest = block.nearest;
  const double least = core::least_of_ranks(grid, nearest.least);
  const int rank = core::rank_of_greatest(grid, nearest.least == least ? nearest.critical_slope : -1.0);
  const bool mine = !grid.ranks || grid.ranks->rank() == rank;
  nearest.least = least;
  nearest.critical_slope = core::greatest_of_ranks(grid, mine ? nearest.critical_slope : 0.0);
  for (double& x : nearest.place) x = core::greatest_of_ranks(grid, mine ? x : 0.0);
  const double cells = core::sum_of_ranks(grid, block.cells), below = core::sum_of_ranks(grid, block.below);
  nearest.share_below = cells > 0 ? below / cells : 0;
  return nearest;
}

}  // namespace polybed::tfm
