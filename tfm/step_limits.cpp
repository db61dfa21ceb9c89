#include "tfm/step_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "core/vectors.hpp"
#include "tfm/fast_drag.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// Keeps the fastest rate of a process in any cell, 1/s.
struct FastestRate {
  double rate = 0;
  Index cell = 0;
  void see(double r, Index c) {
    if (r > rate) {
      rate = r;
      cell = c;
    }
  }
  [[nodiscard]] TimeScale scale(std::string process) const {
    return {std::move(process), rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity(), cell};
  }
};

constexpr Index most_together = 128;  ///< cells of a row processed together
using Rates = std::array<double, std::size_t(most_together)>;

/// Raises the rates of a row of cells, 1/s, to the rates at which a phase crosses them.
template <class Metric>
void raise_to_crossing(const Metric& metric, const core::Grid& grid, const core::FaceField& velocity, Index begin,
                       Index cells, Rates& rates) {
  Rates own;
  std::fill_n(own.begin(), cells, 0.0);
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const double *u = velocity[a].data(), spacing = grid.spacing[a];
    const Index s = grid.stride(axis);
    for (Index n = 0; n < cells; ++n) {
      const Index c = begin + n, next = c + s;
      own[std::size_t(n)] += metric.per_volume(c) *
                             std::max(metric.open(a, c) * std::abs(u[c]), metric.open(a, next) * std::abs(u[next])) /
                             spacing;
    }
  }
  for (std::size_t n = 0; n < std::size_t(cells); ++n) rates[n] = std::max(rates[n], own[n]);
}

/// Calls body(begin, cells, rates) for all cells, a part of a row at a time, with the rate of the fastest phase in
/// each.
template <class Body>
void for_each_part_of_rows(const core::Grid& grid, const Fields& fields, Body&& body) {
  Rates rates;
  core::with_metric(grid, [&]<class Metric>(const Metric& metric) {
    core::for_each_row(grid, [&](Index begin, Index end) {
      for (; begin < end; begin += most_together) {
        const Index cells = std::min(end - begin, most_together);
        std::fill_n(rates.begin(), cells, 0.0);
        core::in_vectors<raise_to_crossing<Metric>>(metric, grid, fields.fluid.velocity, begin, cells, rates);
        for (const core::FaceField& velocity : fields.solids.velocity)
          core::in_vectors<raise_to_crossing<Metric>>(metric, grid, velocity, begin, cells, rates);
        body(begin, cells, rates);
      }
    });
  });
}

/// The greatest open face of a cell over its open volume: 1 for whole cells, more for cells cut by a round wall.
double narrowness(const core::Grid& grid, Index c) {
  double most = 0;
  core::with_metric(grid, [&](const auto& metric) {
    for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a)
      most = std::max({most, metric.open(a, c), metric.open(a, c + grid.stride(int(a)))});
    most *= metric.per_volume(c);
  });
  return most;
}

}  // namespace

std::vector<TimeScale> time_scales(const Constants& constants, const Fields& fields, double kinematic_viscosity,
                                   bool split) {
  const core::Grid& grid = constants.grid;
  const double h = grid.smallest_spacing();
  FastestRate convection, acoustics, damping, drag, viscous, viscosity, temperature;
  for_each_part_of_rows(grid, fields, [&](Index begin, Index cells, const Rates& crossing) {
    for (Index n = 0; n < cells; ++n) {
      const Index c = begin + n;
      const auto at = std::size_t(c);
      const double narrow = narrowness(grid, c);
      if (!(narrow > 0)) continue;
      double on_fluid = 0, on_solids = 0, solids_density = 0;
      SlowDrag slow(fields.fluid.voidage[at], constants.fluid.density);
      convection.see(crossing[std::size_t(n)], c);
      for (std::size_t j = 0; j < constants.species(); ++j) {
        const double b = fields.solids.exchange[j][at], phi = std::max(fields.solids.fraction[j][at], 0.0);
        on_fluid += phi * b / (std::max(fields.fluid.voidage[at], fluid::voidage_floor) * constants.fluid.density);
        solids_density += fields.share[j][at] * constants.density[j];
        on_solids = std::max(on_solids, b / constants.density[j]);
        slow.add(phi, b, constants.density[j]);
        if (fields.stress.viscous())
          viscous.see(4 * grid.dimensions * narrow * fields.stress.viscosity[at] / (constants.density[j] * h * h), c);
      }
      viscosity.see(4 * grid.dimensions * narrow * kinematic_viscosity / (h * h), c);
      drag.see(split ? slow.rate() : on_solids + on_fluid, c);
      for (const core::Field& decay : fields.granular.decay) temperature.see(decay[at], c);
      if (!fields.stress.present()) continue;
      acoustics.see(std::sqrt(narrow * std::max(fields.stress.slope[at], 0.0) / solids_density) / h, c);
      damping.see(2 * grid.dimensions * narrow * fields.stress.damping[at] / (solids_density * h * h), c);
    }
  });
  std::vector<TimeScale> scales{convection.scale("convection"), drag.scale("drag")};
  if (fields.stress.present()) {
    scales.push_back(acoustics.scale("acoustics"));
    scales.push_back(damping.scale("bulk viscosity"));
  }
  if (!fields.granular.decay.empty()) scales.push_back(temperature.scale("granular temperature"));
  if (fields.stress.viscous()) scales.push_back(viscous.scale("solids viscosity"));
  if (kinematic_viscosity > 0) scales.push_back(viscosity.scale("viscosity"));
  return scales;
}

double longest_split_step(const Constants& constants, const Fields& fields) {
  constexpr double share = 1.0;
  double fastest = 0;
  for_each_part_of_rows(constants.grid, fields, [&](Index, Index cells, const Rates& crossing) {
    fastest = std::max(fastest, *std::max_element(crossing.begin(), crossing.begin() + cells));
  });
  fastest = core::greatest_of_ranks(constants.grid, fastest);
  return fastest > 0 ? share / fastest : std::numeric_limits<double>::max();
}

TimeScale nearest_of(const std::vector<TimeScale>& scales) {
  TimeScale nearest{"nothing", std::numeric_limits<double>::infinity(), 0};
  for (const TimeScale& scale : scales)
    if (scale.seconds < nearest.seconds) nearest = scale;
  return nearest;
}

std::string place_of(const TimeScale& scale, const core::Grid& grid) {
  const Index row = grid.extent(0), layer = grid.extent(0) * grid.extent(1);
  const std::array<Index, 3> padded{scale.cell % row, scale.cell % layer / row, scale.cell / layer};
  std::string place = scale.process + " at (";
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    place += fmt::format("{}{}", axis == 0 ? "" : ", ", padded[a] - grid.ghosts(axis) + grid.before[a]);
  }
  return place + ")";
}

}  // namespace polybed::tfm
