// Measures of the fluid between particles.
#include <algorithm>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "dem/coupling/coupling.hpp"

namespace polybed::dem {

using core::Field;
using core::Index;

/// Weight that the particles' halves of cells at the bottom, and at a top without an outlet, take from the fluid: no
/// fluid moves on those faces, so its pressure cannot show it.
void Coupling::weigh() {
  const core::Grid& grid = flow_.grid();
  const double dt = interval();
  const auto rows = [&](int side) {
    fluid::for_each_boundary_row(grid, 1, side, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        at_ends_[c] = phase_.impulse[1][c] / dt - (1 - phase_.voidage_on[1][c]) * flow_.gradient()[1][c];
    });
  };
  rows(0);
  if (!flow_.boundaries().has_outlet()) rows(1);
}

double Coupling::most_solids() const {
  double most = 0;
  core::for_each_row(flow_.grid(), [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      double all = 0;
      for (const Field& phi : fraction_) all += phi[c];
      most = std::max(most, all);
    }
  });
  return most;
}

double Coupling::fluid_flux() const {
  const core::Grid& grid = flow_.grid();
  const Field& u = flow_.state().velocity[1];
  const auto s = std::size_t(grid.stride(1));
  std::vector<double> flux;
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      double eps = 1;
      for (const Field& phi : fraction_) eps -= phi[c];
      flux.push_back(eps * 0.5 * (u[c] + u[c + s]));
    }
  });
  return core::sum_of_ranks(grid, flux) / double(grid.column_cell_count());
}

double Coupling::pressure_drop() const {
  const core::Grid& grid = flow_.grid();
  if (grid.periodic[1]) return -flow_.mean_gradient() * grid.column_height();
  const Field& p = flow_.state().pressure;
  const double at_top = flow_.boundaries().has_outlet() ? 0.5 : 1;  // p = 0 half a cell above an outlet
  double sum = 0;
  core::with_metric(grid, [&](const auto& metric) {
    const auto add_row = [&](int j, double share) {
      const double whole = core::open_cells_of_layer(grid, grid.before[1] + j);
      core::for_each_row(grid, {0, j, 0}, {grid.cells[0], j + 1, grid.cells[2]}, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) sum += share / whole * metric.volume(c) * p[std::size_t(c)];
      });
    };
    for (const int side : {0, 1}) {
      const double h = grid.size_at_end(1, side);
      const double whole = core::open_faces_below(grid, side * grid.column_cells(1));
      fluid::for_each_boundary_row(grid, 1, side, [&](Index begin, Index end) {
        for (Index c = begin; c < end; ++c) sum += h / whole * metric.open(1, c) * at_ends_[std::size_t(c)];
      });
    }
    if (grid.ends(1, 0)) add_row(0, 1);
    if (grid.ends(1, 1)) add_row(grid.cells[1] - 1, -at_top);
  });
  return core::sum_of_ranks(grid, sum);
}

}  // namespace polybed::dem
