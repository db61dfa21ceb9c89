#include "tfm/step_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "tfm/fast_drag.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// Keeps the fastest rate, 1/s, that a process reaches in any cell.
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

double courant_rate(const core::Grid& grid, const core::FaceField& velocity, Index c) {
  double rate = 0;
  core::with_metric(grid, [&](const auto& metric) {
    for (int axis = 0; axis < grid.dimensions; ++axis) {
      const auto a = std::size_t(axis);
      const double* u = velocity[a].data();
      const Index next = c + grid.stride(axis);
      rate += metric.per_volume(c) *
              std::max(metric.open(a, c) * std::abs(u[c]), metric.open(a, next) * std::abs(u[next])) / grid.spacing[a];
    }
  });
  return rate;
}

/// The greatest open face of a cell over its open volume: 1 of whole cells, more of what a round wall leaves of one.
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
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      const auto at = std::size_t(c);
      const double narrow = narrowness(grid, c);
      if (!(narrow > 0)) continue;
      double on_fluid = 0, on_solids = 0, solids_density = 0;
      SlowDrag slow(fields.fluid.voidage[at], constants.fluid.density);
      convection.see(courant_rate(grid, fields.fluid.velocity, c), c);
      for (std::size_t j = 0; j < constants.species(); ++j) {
        const double b = fields.solids.exchange[j][at], phi = std::max(fields.solids.fraction[j][at], 0.0);
        convection.see(courant_rate(grid, fields.solids.velocity[j], c), c);
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
  core::for_each_row(constants.grid, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) {
      fastest = std::max(fastest, courant_rate(constants.grid, fields.fluid.velocity, c));
      for (const core::FaceField& velocity : fields.solids.velocity)
        fastest = std::max(fastest, courant_rate(constants.grid, velocity, c));
    }
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
