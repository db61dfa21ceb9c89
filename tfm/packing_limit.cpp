#include "tfm/packing_limit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "closures/max_packing.hpp"
#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "tfm/mixture.hpp"

namespace polybed::tfm {

namespace {

/// phi minus the greatest value for a composition.
double above_greatest(const Constants& constants, double phi, std::span<const double> share,
                      const StressEffect* stress) {
  if (stress != nullptr) return phi - stress->packing_of(share);
  if (share.size() == 1 || phi <= closures::crystal_packing) return phi - closures::crystal_packing;
  std::array<double, most_species> crystal{};
  crystal.fill(closures::crystal_packing);
  return phi - closures::packing_yu_standish(share, constants.diameter, {crystal.data(), share.size()});
}

}  // namespace

double least_packing(const Constants& constants, const StressEffect* stress) {
  if (stress == nullptr) return closures::crystal_packing;
  double least = 1;
  std::array<double, most_species> share{};
  for (std::size_t j = 0; j < constants.species(); ++j) {
    share.fill(0);
    share[j] = 1;
    least = std::min(least, stress->packing_of({share.data(), constants.species()}));
  }
  return least;
}

CellSolids solids_of(const Constants& constants, const StateLayout& layout, std::span<const double> y, std::size_t cell,
                     const StressEffect* stress, double least_packing) {
  std::array<double, most_species> share{};
  const std::size_t n = constants.species();
  // The fractions come first in a state, species by species.
  const auto fraction = [&](std::size_t j) { return y[layout.entries()[j].begin + cell]; };
  double least = 0, sum = 0, seen = composition_floor;
  for (std::size_t j = 0; j < n; ++j) {
    least = std::min(least, fraction(j));
    sum += fraction(j);
    seen += std::max(fraction(j), 0.0);
  }
  if (sum <= least_packing) return {least, sum - least_packing};
  for (std::size_t j = 0; j < n; ++j)
    share[j] = (std::max(fraction(j), 0.0) + composition_floor * constants.bed_share[j]) / seen;
  return {least, above_greatest(constants, sum, {share.data(), n}, stress)};
}

double packing_above(const Constants& constants, const Fields& fields, const StressEffect* stress) {
  if (stress != nullptr) return stress->packing_above(fields);
  double most = 0;
  std::array<double, most_species> share{};
  core::for_each_row(constants.grid, [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      for (std::size_t j = 0; j < constants.species(); ++j) share[j] = fields.share[j][c];
      most = std::max(
          most, above_greatest(constants, fields.solids_fraction[c], {share.data(), constants.species()}, stress));
    }
  });
  return most;
}

void require_packing(const Constants& constants, const StateLayout& layout, std::span<const double> y, double t,
                     const StressEffect* stress) {
  const core::Grid& grid = constants.grid;
  const double least = least_packing(constants, stress);
  double most = 0;
  std::size_t where = 0;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    const double above = solids_of(constants, layout, y, cell, stress, least).above_packing;
    if (above > most) {
      most = above;
      where = cell;
    }
  }
  const double worst = core::greatest_of_ranks(grid, most);
  if (worst <= most_above_packing) return;
  const std::string place =
      core::said_by(grid, core::rank_of_greatest(grid, most), layout.describe(where, constants.name));
  throw core::ConservationError(
      fmt::format("t = {:.9g} s: solids at {} lie {:.3g} above the packing they can have, more than {:g}{}", t, place,
                  worst, most_above_packing,
                  stress == nullptr ? "; nothing limits the packing: effects.solids_stress = \"frictional\" does"
                  : constants.species() > 1
                      ? "; species that part push each other into what they leave: effects.species_exchange = "
                        "\"syamlal\" with tfm.exchange_pressure of 1 to 100 s/m2 holds those that touch"
                      : "; the solids pressure that holds them apart goes with tfm.frictional_pressure: raise it"));
}

}  // namespace polybed::tfm
