#include "measures/invariants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/numerics/metric.hpp"
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

core::Json past_of(std::span<const WorstInvariant> worst) {
  core::Json past = core::Json::array();
  for (const WorstInvariant& w : worst)
    past.push_back({{"name", w.name}, {"value", w.value}, {"time_s", w.time}, {"place", w.place}});
  return past;
}

void recall(std::span<WorstInvariant> worst, const core::Json& past) {
  for (const core::Json& met : core::array_of(past))
    for (WorstInvariant& w : worst)
      if (w.name == core::text_of(core::member_of(met, "name")))
        w.keep(core::number_of(core::member_of(met, "value")), core::number_of(core::member_of(met, "time_s")),
               core::text_of(core::member_of(met, "place")));
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

namespace {

/// Volumes in the block, m3.
std::vector<double> volumes_here(const core::Grid& grid, const fluid::Interphase& solids) {
  std::vector<double> result;
  for (const core::Field& phi : solids.fraction) {
    double sum = 0, lost = 0;
    core::for_each_row(grid, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
        const double term = (grid.metric ? grid.metric->volume[c] : 1.0) * phi[c] - lost, next = sum + term;
        lost = (next - sum) - term;
        sum = next;
      }
    });
    result.push_back(sum * grid.cell_volume());
  }
  return result;
}

}  // namespace

std::vector<double> species_volumes(const core::Grid& grid, const fluid::Interphase& solids) {
  std::vector<double> result = volumes_here(grid, solids);
  core::add_over_ranks(grid, result);
  return result;
}

Watched::Watched(const core::Grid& grid, const fluid::Interphase& solids, const fluid::FluidState& fluid,
                 double packing_above, double velocity_scale)
    : volume(volumes_here(grid, solids)),
      packing_above(packing_above),
      divergence(fluid::divergence_error(grid, fluid.flux, velocity_scale)) {
  core::for_each_row(grid, [&](Index begin, Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      for (const core::Field& phi : solids.fraction) fraction_below = std::max(fraction_below, -phi[c]);
      most_solids = std::max(most_solids, 1 - fluid.voidage[c]);
    }
  });
}

void Watched::put_into(core::Reduction& all) {
  all.sum(volume);
  for (double* value : {&fraction_below, &most_solids, &packing_above, &divergence}) all.greatest(*value);
}

double ledger_error(double start, double in, double out, double now) {
  return start + in > 0 ? std::abs((now + out - in) - start) / (start + in) : 0;
}

InvariantValues Invariants::see(const Watched& column, std::span<const double> density, double force_balance,
                                double time, std::span<const fluid::Passed> passed, double fluid_error) {
  InvariantValues now{.fraction_below = column.fraction_below,
                      .most_solids = column.most_solids,
                      .packing_above = column.packing_above,
                      .divergence = column.divergence,
                      .fluid_error = fluid_error,
                      .force_balance = force_balance};
  for (std::size_t j = 0; j < density.size(); ++j) {
    const double error = ledger_error(initial_mass_[j], passed.empty() ? 0 : passed[j].in * density[j],
                                      passed.empty() ? 0 : passed[j].out * density[j], column.volume[j] * density[j]);
    now.mass_error = std::max(now.mass_error, error);
    worst_[mass].keep(error, time, "species " + species_[j]);
  }
  worst_[bounds].keep(now.fraction_below, time);
  worst_[packing].keep(now.packing_above, time);
  worst_[volume].keep(compressible_ ? now.fluid_error : now.divergence, time);
  return now;
}

}  // namespace polybed::measures
