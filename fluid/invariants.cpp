#include "fluid/invariants.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/ranks.hpp"
#include "fluid/pressure.hpp"

namespace polybed::fluid {

using core::Index;

namespace {
enum Which : std::size_t { mass, bounds, packing, volume };
}

Invariants::Invariants(std::vector<double> initial_mass, double rtol, bool compressible)
    : initial_mass_(std::move(initial_mass)),
      compressible_(compressible),
      worst_{{"mass", 0, 1e-12, 0},
             {"solids fraction below 0", 0, rtol, 0},
             {"solids fraction above packing", 0, 1e-3, 0},
             {"divergence of the volume flux", 0, 1e-2, 0}} {
  if (compressible) worst_[volume] = {"mass of the fluid", 0, rtol, 0};
}

void Invariants::keep(std::size_t which, double value, double time) {
  if (!(value > worst_[which].value)) return;
  worst_[which].value = value;
  worst_[which].time = time;
}

const WorstInvariant& Invariants::nearest() const {
  return *std::max_element(worst_.begin(), worst_.end(),
                           [](const auto& a, const auto& b) { return a.share() < b.share(); });
}

std::vector<double> species_volumes(const core::Grid& grid, const Interphase& solids) {
  std::vector<double> result;
  for (const core::Field& phi : solids.fraction) {
    double sum = 0, lost = 0;
    core::for_each_row(grid, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        const double term = phi[c] - lost, next = sum + term;
        lost = (next - sum) - term;
        sum = next;
      }
    });
    result.push_back(sum * grid.cell_volume());
  }
  core::add_over_ranks(grid, result);
  return result;
}

InvariantValues Invariants::see(const core::Grid& grid, const Interphase& solids, const FluidState& fluid,
                                double packing_above, double velocity_scale, double force_balance, double time,
                                double fluid_error) {
  InvariantValues now;
  const std::vector<double> volume_now = species_volumes(grid, solids);
  for (std::size_t j = 0; j < solids.species(); ++j)
    if (initial_mass_[j] > 0)
      now.mass_error = std::max(now.mass_error, std::abs(volume_now[j] * solids.density[j] / initial_mass_[j] - 1));
  double least = 0, most = 0;
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      for (const core::Field& phi : solids.fraction) least = std::min(least, phi[c]);
      most = std::max(most, 1 - fluid.voidage[c]);
    }
  });
  now.fraction_below = -core::least_of_ranks(grid, least);
  now.most_solids = core::greatest_of_ranks(grid, most);
  now.packing_above = packing_above;
  now.divergence = divergence_error(grid, fluid.flux, velocity_scale);
  now.force_balance = force_balance;
  keep(mass, now.mass_error, time);
  keep(bounds, now.fraction_below, time);
  keep(packing, now.packing_above, time);
  now.fluid_error = fluid_error;
  keep(volume, compressible_ ? now.fluid_error : now.divergence, time);
  return now;
}

}  // namespace polybed::fluid
