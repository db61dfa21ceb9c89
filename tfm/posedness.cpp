#include "tfm/posedness.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "closures/well_posedness.hpp"
#include "core/ranks.hpp"
#include "fluid/fluid_state.hpp"

namespace polybed::tfm {

namespace {

/// G/G_crit of a cell with solids.
double ratio_in(const Constants& constants, const Fields& fields, std::size_t c) {
  const double phi = fields.solids_fraction[c], eps = 1 - phi;
  double density = 0, slip = 0;
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double share = std::max(fields.solids.fraction[j][c], 0.0) / phi;
    density += share * constants.density[j];
    slip += share * fields.slip_superficial[j][c] / std::max(eps, fluid::voidage_floor);
  }
  double fluid_density = constants.fluid.density;
  if (!fields.fluid.compression.density.empty()) {
    slip *= fluid_density / fields.fluid.compression.density[c];
    fluid_density = fields.fluid.compression.density[c];
  }
  const double critical = closures::critical_slope(phi, density, fluid_density, slip);
  if (!(critical > 0)) return std::numeric_limits<double>::infinity();
  return (fields.stress.present() ? fields.stress.slope[c] : 0.0) / critical;
}

}  // namespace

PosednessMargin posedness_margin(const Constants& constants, const Fields& fields) {
  const core::Grid& grid = constants.grid;
  PosednessMargin margin;
  std::array<double, 2> count{};  // cells with solids, cells below 1
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const auto c = std::size_t(grid.index(i, j, k));
        if (!(fields.solids_fraction[c] > posedness_fraction)) continue;
        const double ratio = ratio_in(constants, fields, c);
        ++count[0];
        if (ratio < 1) ++count[1];
        if (!(ratio < margin.least)) continue;
        margin.least = ratio;
        margin.cell = {i + grid.before[0], j + grid.before[1], k + grid.before[2]};
      }
  core::add_over_ranks(grid, count);
  margin.share = count[0] > 0 ? count[1] / count[0] : 0;
  const double here = margin.least;
  margin.least = core::least_of_ranks(grid, here);
  const int rank = core::rank_of_greatest(grid, -here);
  std::array<double, 3> cell{};
  if (!grid.ranks || grid.ranks->rank() == rank)
    for (std::size_t a = 0; a < 3; ++a) cell[a] = margin.cell[a];
  core::add_over_ranks(grid, cell);
  for (std::size_t a = 0; a < 3; ++a) margin.cell[a] = int(cell[a]);
  return margin;
}

std::string sentence_of(const PosednessMargin& margin, const core::Grid& grid) {
  const std::string place = grid.dimensions == 2
                                ? fmt::format("({}, {})", margin.cell[0], margin.cell[1])
                                : fmt::format("({}, {}, {})", margin.cell[0], margin.cell[1], margin.cell[2]);
  if (margin.least == std::numeric_limits<double>::infinity()) return "well-posed: nothing slips";
  return fmt::format(
      "{}: least slope of the solids pressure {:.3g} of the critical one, in cell {}; below it in {:.3g} % "
      "of the cells with solids",
      margin.share > 0 ? "ill-posed" : "well-posed", margin.least, place, 100 * margin.share);
}

}  // namespace polybed::tfm
