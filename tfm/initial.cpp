#include "tfm/initial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/case/layers.hpp"
#include "core/error.hpp"
#include "core/numerics/metric.hpp"
#include "core/numerics/random.hpp"

namespace polybed::tfm {

using core::Index;

double solids_height(const core::Bed& bed) { return bed.static_height * bed.solids_fraction; }

namespace {

[[noreturn]] void refuse(const core::Scene& scene, const char* key, const std::string& why) {
  throw core::StartError(std::vector{scene.places.problem({key}, why)});
}

/// \param top  of the bed at the start, m
void require_room(double top, const core::Scene& scene, const core::Grid& grid) {
  const double height = grid.column_height();
  if (top > height * (1 + 1e-12))
    refuse(scene, "column.size",
           fmt::format("the bed at its start is {:.4g} m high, the column {:.4g} m: enlarge column.size", top, height));
}

/// Open volume of each layer over the area of the bottom, m.
std::vector<double> layers_of(const core::Grid& grid) {
  std::vector<double> layers;
  for (int y = 0; y < grid.column_cells(1); ++y)
    layers.push_back(core::open_cells_of_layer(grid, y) / core::open_faces_below(grid, 0) * grid.spacing[1]);
  return layers;
}

/// Checks that the layers, between walls inside, contain all the solids.
/// \param solids  over the bottom, m
void require_room_between_walls(double solids, const std::vector<double>& column, const core::Scene& scene,
                                const core::Grid& grid) {
  if (!grid.metric || !grid.metric->walls) return;
  const std::vector<double> layers = layers_of(grid);
  const double placed = std::inner_product(layers.begin(), layers.end(), column.begin(), 0.0);
  if (placed < solids * (1 - 1e-9))
    refuse(scene, "column.size", "the bed at its start does not fit beside [[wall]]: enlarge column.size");
}

/// Solids fraction of cells in a column that is filled evenly from the bottom; the topmost cell gets the remainder.
std::vector<double> even_column(double solids, double fraction, const std::vector<double>& layers) {
  std::vector<double> column;
  for (const double layer : layers) {
    column.push_back(std::clamp(solids / layer, 0.0, fraction));
    solids -= column.back() * layer;
  }
  return column;
}

/// The solids fraction whose pressure balances the cell above and the weight between the two centres.
double settled_fraction(const StressEffect& stress, double above, double weight_per_fraction, double pressure_above) {
  double phi = above;
  for (int n = 0; n < 200; ++n) {
    const double next = stress.solids_fraction_at(pressure_above + 0.5 * (phi + above) * weight_per_fraction);
    if (std::abs(next - phi) < 1e-16) break;
    phi = next;
  }
  return phi;
}

/// Equilibrium of `cells` cells under a topmost one of fraction `top`, face by face, from the bottom up.
/// \param weight  of solids on an area, Pa/m
std::vector<double> equilibrium_below(const StressEffect& stress, double top, int cells, double weight,
                                      const core::Grid& grid) {
  const auto below = [&](int y) { return weight * (0.5 * (grid.height(y - 1) + grid.height(y))); };
  std::vector<double> column{top};
  double pressure = stress.pressure_on_top(top, 0.5 * top * below(cells + 1));
  for (int k = 0; k < cells; ++k) {
    const double between = below(cells - k);
    const double phi = settled_fraction(stress, column.back(), between, pressure);
    pressure += 0.5 * (phi + column.back()) * between;
    column.push_back(phi);
  }
  std::reverse(column.begin(), column.end());
  return column;
}

/// A bed at rest with a given volume of solids: the number of cells and the loose topmost one are chosen to match the
/// volume exactly.
std::vector<double> settled_column(double solids, const StressEffect& stress, double weight, const core::Grid& grid) {
  const std::vector<double> layers = layers_of(grid);
  const auto amount = [&](const std::vector<double>& c) {
    return std::inner_product(c.begin(), c.begin() + std::ptrdiff_t(std::min(c.size(), layers.size())), layers.begin(),
                              0.0);
  };
  int cells = 0;
  while (cells < grid.column_cells(1) && amount(equilibrium_below(stress, 0.0, cells + 1, weight, grid)) <= solids)
    ++cells;
  double low = 0, high = stress.max_packing();
  for (int n = 0; n < 200; ++n) {
    const double top = 0.5 * (low + high);
    (amount(equilibrium_below(stress, top, cells, weight, grid)) < solids ? low : high) = top;
  }
  std::vector<double> column = equilibrium_below(stress, 0.5 * (low + high), cells, weight, grid);
  if (column.size() < std::size_t(grid.column_cells(1))) column.resize(std::size_t(grid.column_cells(1)), 0.0);
  return column;
}

/// Changes a layer of the block's cells by a random share per cell, with mean 0 over the layer of the column; the same
/// on any number of ranks.
void perturb_layer(const core::Grid& grid, int y, double share, std::uint64_t seed, fluid::Interphase& solids) {
  if (y < grid.before[1] || y >= grid.before[1] + grid.cells[1]) return;
  constexpr std::uint64_t fractions_at_start = 101;  // its own sequence
  const int nx = grid.column_cells(0), nz = grid.column_cells(2);
  const auto random = [&](int x, int z) {
    return 2 * core::uniform(
                   seed, fractions_at_start,
                   (std::uint64_t(y) * std::uint64_t(nz) + std::uint64_t(z)) * std::uint64_t(nx) + std::uint64_t(x)) -
           1;
  };
  const core::CrossSection* section = grid.metric ? &grid.metric->layer(y) : nullptr;
  const auto open = [&](int x, int z) { return section ? section->volume[section->at(x, z)] : 1.0; };
  const double cells = section ? std::accumulate(section->volume.begin(), section->volume.end(), 0.0) : double(nx) * nz;
  double mean = 0;
  for (int z = 0; z < nz; ++z)
    for (int x = 0; x < nx; ++x) mean += open(x, z) * random(x, z) / cells;
  for (int z = 0; z < grid.cells[2]; ++z)
    for (int x = 0; x < grid.cells[0]; ++x) {
      const double factor = 1 + share * (random(grid.before[0] + x, grid.before[2] + z) - mean);
      for (core::Field& phi : solids.fraction) phi[std::size_t(grid.index(x, y - grid.before[1], z))] *= factor;
    }
}

/// Share of each of the block's cells along an axis between two places, both in cells of the column.
std::vector<double> shares_between(const core::Grid& grid, std::size_t axis, double from, double to) {
  std::vector<double> share;
  for (int n = 0; n < grid.cells[axis]; ++n) {
    const double low = n + grid.before[axis];
    share.push_back(std::clamp(to - low, 0.0, 1.0) - std::clamp(from - low, 0.0, 1.0));
  }
  return share;
}

/// Share of each of the block's layers, by volume, between two heights.
std::vector<double> shares_of_layers(const core::Grid& grid, const core::Column& column, const core::Extent& extent) {
  const double h = grid.spacing[1];
  std::vector<double> share;
  for (int y = grid.before[1]; grid.layers && y < grid.before[1] + grid.cells[1]; ++y) {
    const auto below = [&](double height) { return std::clamp(height, grid.low(1, y), grid.low(1, y + 1)); };
    share.push_back((below(extent.high) - below(extent.low)) / grid.height(y));
  }
  if (grid.layers) return share;
  if (!column.is_tapered()) return shares_between(grid, 1, extent.low / h, extent.high / h);
  for (int y = grid.before[1]; y < grid.before[1] + grid.cells[1]; ++y) {
    const auto below = [&](double height) { return column.even_height(std::clamp(height, y * h, (y + 1) * h)); };
    share.push_back((below(extent.high) - below(extent.low)) / (below((y + 1) * h) - below(y * h)));
  }
  return share;
}

/// Adds a part of the bed to the cells. Cells cut by its faces get their share by volume, so that the mass is exact.
void add_bed_part(const core::Grid& grid, const core::Column& column, const core::BedPart& part,
                  const core::Extent& extent, fluid::Interphase& solids) {
  const double height = column.even_height(extent.high) - column.even_height(extent.low);
  const auto along = [&](std::size_t axis, double from, double to) { return shares_between(grid, axis, from, to); };
  const auto across = [&](std::size_t axis, std::size_t d) {
    return along(axis, part.from[d] * grid.column_cells(int(axis)), part.to[d] * grid.column_cells(int(axis)));
  };
  const std::vector<double> x = across(0, 0), z = across(2, 1), y = shares_of_layers(grid, column, extent);
  for (int k = 0; k < grid.cells[2]; ++k)
    for (int j = 0; j < grid.cells[1]; ++j)
      for (int i = 0; i < grid.cells[0]; ++i) {
        const double share = x[std::size_t(i)] * y[std::size_t(j)] * z[std::size_t(k)];
        if (!(share > 0)) continue;
        for (std::size_t s = 0; s < part.solids.size(); ++s)
          solids.fraction[s][std::size_t(grid.index(i, j, k))] += share * (part.solids[s] / height);
      }
}

/// A bed with several parts, each of uniform composition.
void fill_parts(const core::Scene& scene, const core::Grid& grid, fluid::Interphase& solids) {
  const std::vector<core::BedPart> parts = core::start_parts(scene);
  const std::vector<core::Extent> extents = core::stacked(parts, scene.column);
  require_room(core::top_of(extents), scene, grid);
  for (core::Field& phi : solids.fraction) std::fill(phi.begin(), phi.end(), 0.0);
  for (std::size_t n = 0; n < parts.size(); ++n)
    if (parts[n].all_solids() > 0) add_bed_part(grid, scene.column, parts[n], extents[n], solids);
}

/// Fills one layer of the block's cells; does nothing if the block lacks it.
void fill_layer(const core::Grid& grid, int y, double value, core::Field& field) {
  if (y < 0 || y >= grid.cells[1]) return;
  core::for_each_row(grid, core::Box{{0, y, 0}, {grid.cells[0], y + 1, grid.cells[2]}},
                     [&](Index begin, Index end) { std::fill(field.begin() + begin, field.begin() + end, value); });
}

void fill_whole_cells(const core::Scene& scene, const Constants& constants, const StressEffect* stress,
                      fluid::Interphase& solids) {
  const core::Bed& bed = scene.bed;
  const core::Grid& grid = constants.grid;
  if (bed.start.kind == core::StartKind::layered) return fill_parts(scene, grid, solids);
  const double total = scene.column.even_height(bed.static_height) * bed.solids_fraction;
  require_room(scene.column.filled_height(total / bed.start_solids_fraction), scene, grid);
  std::vector<double> column;
  if (bed.start.kind == core::StartKind::settled) {
    if (stress == nullptr)
      refuse(scene, "bed.start",
             "bed.start = \"settled\" needs a solids_stress in [effects]: nothing else holds a bed up");
    double excess = 0;
    for (std::size_t j = 0; j < constants.species(); ++j)
      excess += bed.volume_share[j] * (constants.density[j] - constants.fluid.density);
    if (excess <= 0) refuse(scene, "bed.start", "bed.start = \"settled\" needs solids heavier than the fluid");
    column = settled_column(total, *stress, excess * constants.gravity, grid);
  } else {
    column = even_column(total, bed.start_solids_fraction, layers_of(grid));
  }
  require_room_between_walls(total, column, scene, grid);
  const bool uneven = bed.start.kind == core::StartKind::mixed && bed.perturbation > 0 &&
                      grid.column_cells(0) * grid.column_cells(2) > 1;
  for (int y = 0; y < grid.column_cells(1); ++y) {
    for (std::size_t j = 0; j < constants.species(); ++j)
      fill_layer(grid, y - grid.before[1], bed.volume_share[j] * column[std::size_t(y)], solids.fraction[j]);
    if (uneven) perturb_layer(grid, y, bed.perturbation, bed.seed, solids);
  }
}

}  // namespace

void fill_bed(const core::Scene& scene, const Constants& constants, const StressEffect* stress,
              fluid::Interphase& solids) {
  fill_whole_cells(scene, constants, stress, solids);
  const core::Metric* metric = constants.grid.metric.get();
  for (core::Field& phi : solids.fraction)
    for (std::size_t c = 0; metric != nullptr && c < phi.size(); ++c)
      if (!(metric->volume[c] > 0)) phi[c] = 0;
}

}  // namespace polybed::tfm
