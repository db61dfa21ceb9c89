#include "tfm/packing_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "tfm/mixture.hpp"

namespace polybed::tfm {

CellSolids solids_of(const Constants& constants, const StateLayout& layout, std::span<const double> y, std::size_t cell,
                     const StressEffect* stress) {
  constexpr std::size_t most_species = 15;  // as the case file allows
  std::array<double, most_species> share{};
  const std::size_t n = constants.species();
  // The fractions stand first in a state, species by species.
  const auto fraction = [&](std::size_t j) { return y[layout.entries()[j].begin + cell]; };
  double least = 0, sum = 0, seen = composition_floor;
  for (std::size_t j = 0; j < n; ++j) {
    least = std::min(least, fraction(j));
    sum += fraction(j);
    seen += std::max(fraction(j), 0.0);
  }
  if (stress == nullptr) return {least, 0};
  for (std::size_t j = 0; j < n; ++j)
    share[j] = (std::max(fraction(j), 0.0) + composition_floor * constants.bed_share[j]) / seen;
  return {least, sum - stress->packing_of({share.data(), n})};
}

void require_packing(const Constants& constants, const StateLayout& layout, std::span<const double> y, double t,
                     const StressEffect& stress) {
  const core::Grid& grid = constants.grid;
  double most = 0;
  std::size_t where = 0;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const double above = solids_of(constants, layout, y, cell, &stress).above_packing;
    if (above > most) {
      most = above;
      where = cell;
    }
  }
  const double worst = core::greatest_of_ranks(grid, most);
  if (worst <= most_above_packing) return;
  const std::string place =
      core::said_by(grid, core::rank_of_greatest(grid, most), layout.describe(where, constants.name));
  throw core::ConservationError(fmt::format(
      "t = {:.9g} s: solids at {} lie {:.3g} above the packing they can have, more than {:g}{}", t, place, worst,
      most_above_packing,
      constants.species() > 1 ? "; species that part push each other into what they leave: effects.species_exchange = "
                                "\"syamlal\" with tfm.exchange_pressure of 1 to 100 s/m2 holds those that touch"
                              : ""));
}

}  // namespace polybed::tfm
