#include "tfm/initial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/numerics/random.hpp"

namespace polybed::tfm {

using core::Index;

double solids_height(const core::Bed& bed) { return bed.static_height * bed.solids_fraction; }

namespace {

/// Solids fraction of the cells of a column filled evenly from the bottom; the topmost cell takes the rest.
std::vector<double> even_column(double solids, double fraction, const core::Grid& grid) {
  std::vector<double> column(std::size_t(grid.column_cells(1)), 0.0);
  for (double& phi : column) {
    phi = std::clamp(solids / grid.spacing[1], 0.0, fraction);
    solids -= phi * grid.spacing[1];
  }
  return column;
}

/// The solids fraction whose pressure balances that of the cell above and the weight between the two centres.
double settled_fraction(const StressEffect& stress, double above, double weight_per_fraction, double pressure_above) {
  double phi = above;
  for (int n = 0; n < 200; ++n) {
    const double next = stress.solids_fraction_at(pressure_above + 0.5 * (phi + above) * weight_per_fraction);
    if (std::abs(next - phi) < 1e-16) break;
    phi = next;
  }
  return phi;
}

/// Column of `cells` cells under a topmost one of fraction `top`, in equilibrium face by face, from the bottom up.
std::vector<double> equilibrium_below(const StressEffect& stress, double top, int cells, double weight) {
  std::vector<double> column{top};
  double pressure = stress.pressure_on_top(top, 0.5 * top * weight);
  for (int k = 0; k < cells; ++k) {
    const double phi = settled_fraction(stress, column.back(), weight, pressure);
    pressure += 0.5 * (phi + column.back()) * weight;
    column.push_back(phi);
  }
  std::reverse(column.begin(), column.end());
  return column;
}

/// A bed at rest of a given volume of solids: the number of cells and the loose topmost one are chosen so
/// that it comes out exactly.
std::vector<double> settled_column(double solids, const StressEffect& stress, double weight, const core::Grid& grid) {
  const auto amount = [&](const std::vector<double>& c) {
    return std::accumulate(c.begin(), c.end(), 0.0) * grid.spacing[1];
  };
  int cells = 0;
  while (cells < grid.column_cells(1) && amount(equilibrium_below(stress, 0.0, cells + 1, weight)) <= solids) ++cells;
  double low = 0, high = stress.max_packing();
  for (int n = 0; n < 200; ++n) {
    const double top = 0.5 * (low + high);
    (amount(equilibrium_below(stress, top, cells, weight)) < solids ? low : high) = top;
  }
  std::vector<double> column = equilibrium_below(stress, 0.5 * (low + high), cells, weight);
  if (column.size() < std::size_t(grid.column_cells(1))) column.resize(std::size_t(grid.column_cells(1)), 0.0);
  return column;
}

/// Changes a layer of the block's cells by a share, at random from cell to cell, of the mean 0 over the layer of the
/// column; the same on any number of ranks.
void perturb_layer(const core::Grid& grid, int y, double share, std::uint64_t seed, fluid::Interphase& solids) {
  if (y < grid.before[1] || y >= grid.before[1] + grid.cells[1]) return;
  constexpr std::uint64_t fractions_at_start = 101;  // a sequence of its own
  const int nx = grid.column_cells(0), nz = grid.column_cells(2);
  const auto random = [&](int x, int z) {
    return 2 * core::uniform(
                   seed, fractions_at_start,
                   (std::uint64_t(y) * std::uint64_t(nz) + std::uint64_t(z)) * std::uint64_t(nx) + std::uint64_t(x)) -
           1;
  };
  double mean = 0;
  for (int z = 0; z < nz; ++z)
    for (int x = 0; x < nx; ++x) mean += random(x, z) / (double(nx) * nz);
  for (int z = 0; z < grid.cells[2]; ++z)
    for (int x = 0; x < grid.cells[0]; ++x) {
      const double factor = 1 + share * (random(grid.before[0] + x, grid.before[2] + z) - mean);
      for (core::Field& phi : solids.fraction) phi[std::size_t(grid.index(x, y - grid.before[1], z))] *= factor;
    }
}

/// Volume of each species per area, m, in a layered bed between two such volumes of all solids under it.
std::vector<double> layered_volume(const core::Bed& bed, std::size_t species, double total, double from, double to) {
  std::vector<double> volume(species, 0.0);
  double end = 0;
  for (const std::vector<std::size_t>& layer : core::layers_of(bed, species)) {
    double share = 0;
    for (const std::size_t j : layer) share += bed.volume_share[j];
    const double begin = end;
    end += share * total;
    const double overlap = std::max(0.0, std::min(to, end) - std::max(from, begin));
    for (const std::size_t j : layer)
      if (share > 0) volume[j] = overlap * (bed.volume_share[j] / share);
  }
  return volume;
}

/// One layer of the block's cells; nothing if the block has none of it.
void fill_layer(const core::Grid& grid, int y, double value, core::Field& field) {
  if (y < 0 || y >= grid.cells[1]) return;
  core::for_each_row(grid, core::Box{{0, y, 0}, {grid.cells[0], y + 1, grid.cells[2]}},
                     [&](Index begin, Index end) { std::fill(field.begin() + begin, field.begin() + end, value); });
}

}  // namespace

void fill_bed(const core::Bed& bed, const Constants& constants, const StressEffect* stress, fluid::Interphase& solids) {
  const core::Grid& grid = constants.grid;
  const double total = solids_height(bed), height = grid.spacing[1] * grid.column_cells(1);
  if (total > bed.start_solids_fraction * height * (1 + 1e-12))
    throw core::StartError(
        fmt::format("the bed at its start is {:.4g} m high, the column {:.4g} m: enlarge column.size",
                    total / bed.start_solids_fraction, height));
  std::vector<double> column;
  if (bed.start.kind == core::StartKind::settled) {
    if (stress == nullptr)
      throw core::StartError("bed.start = \"settled\" needs a solids_stress in [effects]: nothing else holds a bed up");
    double excess = 0;
    for (std::size_t j = 0; j < constants.species(); ++j)
      excess += bed.volume_share[j] * (constants.density[j] - constants.fluid.density);
    if (excess <= 0) throw core::StartError("bed.start = \"settled\" needs solids heavier than the fluid");
    column = settled_column(total, *stress, excess * constants.gravity * grid.spacing[1], grid);
  } else {
    column = even_column(total, bed.start_solids_fraction, grid);
  }
  const bool uneven = bed.start.kind == core::StartKind::mixed && bed.perturbation > 0 &&
                      grid.column_cells(0) * grid.column_cells(2) > 1;
  const bool is_layered = bed.start.kind == core::StartKind::layered;
  double below = 0;  // solids volume per area under the cell, m
  for (int y = 0; y < grid.column_cells(1); ++y) {
    const double here = column[std::size_t(y)] * grid.spacing[1];
    const std::vector<double> layered =
        is_layered ? layered_volume(bed, constants.species(), total, below, below + here) : std::vector<double>();
    for (std::size_t j = 0; j < constants.species(); ++j) {
      const double phi = is_layered ? layered[j] / grid.spacing[1] : bed.volume_share[j] * column[std::size_t(y)];
      fill_layer(grid, y - grid.before[1], phi, solids.fraction[j]);
    }
    if (uneven) perturb_layer(grid, y, bed.perturbation, bed.seed, solids);
    below += here;
  }
}

}  // namespace polybed::tfm
