#include "tfm/evenness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::tfm {

using core::Index;

double lateral_difference(const core::Grid& grid, const Fields& fields) {
  const double* phi = fields.solids_fraction.data();
  double most = 0;
  for (int axis = 0; axis < grid.dimensions; axis += 2) {
    const Index s = grid.stride(axis);
    core::for_each_row(grid, core::interior_faces(grid, axis), [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f)
        if (!grid.metric || grid.metric->open[std::size_t(axis)][std::size_t(f)] > 0)
          most = std::max(most, std::abs(phi[f] - phi[f - s]));
    });
  }
  return core::greatest_of_ranks(grid, most);
}

std::vector<std::string> warning_of_an_even_bed(const core::Grid& grid, const Fields& fields) {
  constexpr double even = 1e-4;
  if (grid.column_cells(0) * grid.column_cells(2) == 1 || grid.periodic[1]) return {};  // a box can be meant to be even
  const double difference = lateral_difference(grid, fields);
  if (difference > even) return {};
  return {fmt::format(
      "laterally uniform: solids fractions differ by {:.1g} at most from side to side; one cell across gives "
      "the same bed sooner, or see bed.perturbation",
      difference)};
}

std::optional<EvennessWatch> EvennessWatch::of(const core::Grid& grid, double velocity) {
  if (grid.column_cells(0) * grid.column_cells(2) == 1 || !(velocity > 0)) return std::nullopt;
  return EvennessWatch(velocity);
}

std::vector<std::string> EvennessWatch::look(double time, double bed_height, const core::Grid& grid,
                                             const Fields& fields) {
  constexpr double crossings = 10;
  if (looked_ || time * velocity_ < crossings * bed_height) return {};
  looked_ = true;
  return warning_of_an_even_bed(grid, fields);
}

}  // namespace polybed::tfm
