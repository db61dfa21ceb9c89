#include "measures/invariants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/ranks.hpp"
#include "fluid/pressure.hpp"

namespace polybed::measures {

using core::Index;

namespace {
enum Which : std::size_t { mass, bounds, packing, volume };
}

void WorstInvariant::keep(double now, double at, const std::string& where) {
  if (!(now > value)) return;  // the history reports NaN
  value = now;
  time = at;
  place = where;
}

double WorstInvariant::share() const {
  if (limit > 0) return value / limit;
  return value > 0 ? std::numeric_limits<double>::infinity() : 0;
}

std::string WorstInvariant::text() const {
  const std::string what = place.empty() ? name : fmt::format("{} ({})", name, place);
  return fmt::format("t = {:.6g} s: a conservation law is broken: {} is off by {:.3g}, the limit is {:g}; {}", time,
                     what, value, limit, remedy);
}

const WorstInvariant* broken_law(std::span<const WorstInvariant> worst) {
  const WorstInvariant* broken = nullptr;
  for (const WorstInvariant& law : worst)
    if (law.broken() && (broken == nullptr || law.share() > broken->share())) broken = &law;
  return broken;
}

Invariants::Invariants(std::vector<double> initial_mass, std::vector<std::string> species, double rtol,
                       bool compressible)
    : initial_mass_(std::move(initial_mass)),
      species_(std::move(species)),
      compressible_(compressible),
      worst_{{.name = "mass",
              .limit = 1e-12,
              .judged = true,
              .remedy = "that is a fault of the program: report it with the case"},
             {.name = "solids fraction below 0", .limit = rtol},
             {.name = "solids fraction above packing",
              .limit = 1e-3,
              .judged = true,
              .remedy = "lower tfm.rtol, or give tfm.exchange_pressure where species differ"},
             {.name = "divergence of the volume flux", .limit = 1e-2}} {
  if (compressible)
    worst_[volume] = {.name = "mass of the fluid", .limit = rtol, .judged = true, .remedy = "lower tfm.rtol"};
}

const WorstInvariant& Invariants::nearest() const {
  return *std::max_element(worst_.begin(), worst_.end(),
                           [](const auto& a, const auto& b) { return a.share() < b.share(); });
}

std::vector<double> species_volumes(const core::Grid& grid, const fluid::Interphase& solids) {
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

double ledger_error(double start, double in, double out, double now) {
  return start + in > 0 ? std::abs((now + out - in) - start) / (start + in) : 0;
}

InvariantValues Invariants::see(const core::Grid& grid, const fluid::Interphase& solids, const fluid::FluidState& fluid,
                                double packing_above, double velocity_scale, double force_balance, double time,
                                std::span<const fluid::Passed> passed, double fluid_error) {
  InvariantValues now;
  const std::vector<double> volume_now = species_volumes(grid, solids);
  for (std::size_t j = 0; j < solids.species(); ++j) {
    const double error =
        ledger_error(initial_mass_[j], passed.empty() ? 0 : passed[j].in * solids.density[j],
                     passed.empty() ? 0 : passed[j].out * solids.density[j], volume_now[j] * solids.density[j]);
    now.mass_error = std::max(now.mass_error, error);
    worst_[mass].keep(error, time, "species " + species_[j]);
  }
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
  now.divergence = fluid::divergence_error(grid, fluid.flux, velocity_scale);
  now.force_balance = force_balance;
  worst_[bounds].keep(now.fraction_below, time);
  worst_[packing].keep(now.packing_above, time);
  now.fluid_error = fluid_error;
  worst_[volume].keep(compressible_ ? now.fluid_error : now.divergence, time);
  return now;
}

}  // namespace polybed::measures
