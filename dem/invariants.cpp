#include "dem/invariants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/numerics/messages.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"

namespace polybed::dem {

using measures::WorstInvariant;

std::vector<std::int64_t> numbers_of(const Model& model) {
  std::vector<std::int64_t> number(model.materials().species().size(), 0);
  const Particles& particles = model.particles();
  for (std::size_t i = 0; i < particles.owned; ++i) ++number[std::size_t(particles.species[i])];
  core::add_over_ranks(model.ranks(), number);
  return number;
}

void write(const RunStart& start, core::Checkpoint& checkpoint) {
  checkpoint.numbers["initial_energy"] = start.energy;
  checkpoint.arrays["initial_number"].assign(start.number.begin(), start.number.end());
}

RunStart read_run_start(const core::Checkpoint& checkpoint, const Model& model) {
  RunStart start{0, numbers_of(model)};
  if (const Outflow* outflow = model.outflow())
    for (std::size_t j = 0; j < start.number.size(); ++j) start.number[j] += outflow->number[j];
  if (const Feeding* feeding = model.feeding())
    for (std::size_t j = 0; j < start.number.size(); ++j) start.number[j] -= feeding->number[j];
  std::vector<double> values(start.number.begin(), start.number.end());
  values.push_back(0);
  core::on_first(model.ranks(), [&] {
    values.back() = checkpoint.number("initial_energy");
    const auto kept = checkpoint.arrays.find("initial_number");  // checkpoints from older versions lack it
    if (kept == checkpoint.arrays.end()) return;
    constexpr double most = 1e15;  // a whole number in a double
    const bool counts = std::all_of(kept->second.begin(), kept->second.end(),
                                    [](double n) { return n >= 0 && n <= most && n == std::floor(n); });
    if (kept->second.size() != start.number.size() || !counts)
      core::refuse_checkpoint("initial_number is not a number of particles for each species");
    std::copy(kept->second.begin(), kept->second.end(), values.begin());
  });
  core::take_from_first(model.ranks(), values);
  start.energy = values.back();
  std::transform(values.begin(), values.end() - 1, start.number.begin(), [](double n) { return std::int64_t(n); });
  return start;
}

Invariants::Invariants(const Model& model, RunStart start, bool ledger)
    : model_(model), start_(std::move(start)), ledger_(ledger) {
  constexpr double ledger_limit = 1e-3;      // over the greatest energy so far: V5
  constexpr double fluid_mass_limit = 1e-4;  // over the initial mass or the inflow
  const char* report = "that is a fault of the program: report it with the case";
  const bool stated = model.limits().dt != model.limits().all.front().dt;
  if (ledger)
    worst_.push_back({.name = "energy",
                      .limit = ledger_limit,
                      .judged = true,
                      .remedy = fmt::format("take shorter steps: {}",
                                            stated ? "lower dem.fixed_step" : "raise dem.steps_per_contact")});
  worst_.push_back({.name = "particle count", .limit = 0, .judged = true, .remedy = report});
  const Coupling* coupling = model.coupling();
  if (coupling != nullptr && coupling->flow().compressible() != nullptr)
    worst_.push_back(
        {.name = "mass of the fluid", .limit = fluid_mass_limit, .judged = true, .remedy = "lower dem.fluid_every"});
}

/// Kinetic energy of particles after a fall over the duration of a contact, J. In the first few steps of a fall the
/// greatest energy is less, and the error of a step is a large share of it.
double energy_of_a_short_fall(const Model& model, const std::vector<std::int64_t>& number) {
  constexpr double steps = 20;
  const Vector g = model.gravity();
  const double time = steps * model.limits().dt, square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  double mass = 0;
  for (std::size_t j = 0; j < number.size(); ++j) mass += double(number[j]) * model.materials().species()[j].mass;
  return 0.5 * mass * square * time * time;
}

/// Difference of the ledger from the energy at the start, over the greatest energy so far: V5.
double Invariants::energy_miss(const Totals& now) {
  // In a viscous fluid, or at a start with overlaps, little energy is ever kinetic: it is work of the fluid, or in
  // springs. An attraction that has just begun counts with the work that it will do.
  greatest_energy_ = std::max({greatest_energy_, now.kinetic + now.rotational, now.dissipated, std::abs(now.elastic),
                               std::abs(now.work), now.pull});
  const double scale = std::max(greatest_energy_, energy_of_a_short_fall(model_, start_.number));
  return scale > 0 ? ledger_miss(now, start_.energy, scale) : 0;
}

core::Json Invariants::past() const {
  return {{"worst", measures::past_of(worst_)}, {"greatest_energy_J", greatest_energy_}};
}

void Invariants::recall(const core::Json& past) {
  measures::recall(worst_, core::member_of(past, "worst"));
  greatest_energy_ = core::number_of(core::member_of(past, "greatest_energy_J"));
}

void Invariants::see(const Totals& now, const std::vector<std::int64_t>& number, const FluidRecord* fluid) {
  std::size_t which = 0;
  if (ledger_) worst_[which++].keep(energy_miss(now), model_.time());
  for (std::size_t j = 0; j < number.size(); ++j) {
    const std::int64_t left = model_.outflow() != nullptr ? model_.outflow()->number[j] : 0;
    const std::int64_t come = model_.feeding() != nullptr ? model_.feeding()->number[j] : 0;
    worst_[which].keep(double(std::abs(number[j] + left - come - start_.number[j])), model_.time(),
                       "species " + model_.materials().species()[j].name);
  }
  if (++which < worst_.size()) worst_[which].keep(fluid->mass_error(), model_.time());
}

}  // namespace polybed::dem
