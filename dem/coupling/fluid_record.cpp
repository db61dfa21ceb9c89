#include "dem/coupling/fluid_record.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace polybed::dem {

FluidRecord::FluidRecord(const Coupling& coupling, const core::Ranks* ranks, const FluidTotals& before)
    : coupling_(coupling), ranks_(ranks), totals_(before), seen_(coupling.steps()), begin_(coupling.forces().use()) {
  std::array<double, 4> kg{before.mass, before.account.start, before.account.in, before.account.out};
  core::take_from_first(ranks_, kg);
  totals_.mass = kg[0];
  totals_.account = {kg[1], kg[2], kg[3]};
  if (core::on_any_rank(ranks_, before.steps > 0)) return;
  look();
  totals_.account = {totals_.mass, 0, 0};
}

/// Records the present content of the fields.
void FluidRecord::look() {
  const fluid::Flow& flow = coupling_.flow();
  totals_.pressure_drop = coupling_.pressure_drop();
  if (flow.compressible() != nullptr) totals_.mass = fluid::fluid_mass(flow.grid(), flow.state());
}

void FluidRecord::see() {
  if (coupling_.steps() == seen_) return;
  seen_ = coupling_.steps();
  const fluid::FlowStep& step = coupling_.last_step();
  ++totals_.steps;
  totals_.iterations += std::uint64_t(step.iterations);
  totals_.worst_residual = std::max(totals_.worst_residual, step.residual);
  totals_.greatest_courant = std::max(totals_.greatest_courant, step.courant);
  totals_.account.in += step.mass_in;
  totals_.account.out += step.mass_out;
  look();
}

FluidTotals FluidRecord::totals() const {
  FluidTotals all = totals_;
  const LawUse here = coupling_.forces().use();
  std::array<std::int64_t, 3> sums{std::int64_t(here.evaluations - begin_.evaluations),
                                   std::int64_t(here.guarded - begin_.guarded),
                                   std::int64_t(here.clamped_voidage - begin_.clamped_voidage)};
  core::add_over_ranks(ranks_, sums);
  all.law.evaluations += std::uint64_t(sums[0]);
  all.law.guarded += std::uint64_t(sums[1]);
  all.law.clamped_voidage += std::uint64_t(sums[2]);
  std::array<EnergySum, 2> squares{coupling_.changes().change, coupling_.changes().force};
  add_over_ranks(ranks_, squares);
  all.changes.change.add(squares[0]);
  all.changes.force.add(squares[1]);
  return all;
}

void write(const FluidTotals& t, core::Checkpoint& checkpoint) {
  checkpoint.integers["fluid_record_steps"] = std::int64_t(t.steps);
  checkpoint.integers["fluid_record_iterations"] = std::int64_t(t.iterations);
  checkpoint.integers["fluid_record_evaluations"] = std::int64_t(t.law.evaluations);
  checkpoint.integers["fluid_record_guarded"] = std::int64_t(t.law.guarded);
  checkpoint.integers["fluid_record_clamped"] = std::int64_t(t.law.clamped_voidage);
  checkpoint.numbers["fluid_record_residual"] = t.worst_residual;
  checkpoint.numbers["fluid_record_courant"] = t.greatest_courant;
  const auto put = [&](const std::string& key, const EnergySum& sum) {
    checkpoint.integers[key] = sum.whole();
    checkpoint.integers[key + "_part"] = sum.part();
  };
  put("fluid_record_change", t.changes.change);
  put("fluid_record_force", t.changes.force);
  checkpoint.numbers["fluid_record_pressure_drop"] = t.pressure_drop;
  checkpoint.numbers["fluid_record_mass"] = t.mass;
  checkpoint.numbers["fluid_record_start"] = t.account.start;
  checkpoint.numbers["fluid_record_in"] = t.account.in;
  checkpoint.numbers["fluid_record_out"] = t.account.out;
}

FluidTotals read_fluid_totals(const core::Checkpoint& checkpoint) {
  const auto count = [&](const char* key) {
    const auto found = checkpoint.integers.find(key);
    return found == checkpoint.integers.end() ? 0 : std::uint64_t(checkpoint.count(key));
  };
  const auto number = [&](const char* key, double otherwise = 0) {
    const auto found = checkpoint.numbers.find(key);
    return found == checkpoint.numbers.end() ? otherwise : found->second;
  };
  FluidTotals t;
  t.steps = count("fluid_record_steps");
  t.iterations = count("fluid_record_iterations");
  t.law = {count("fluid_record_evaluations"), count("fluid_record_guarded"), count("fluid_record_clamped")};
  t.worst_residual = number("fluid_record_residual");
  t.greatest_courant = number("fluid_record_courant");
  const auto sum = [&](const std::string& key) {
    return EnergySum(std::int64_t(count(key.c_str())), std::int64_t(count((key + "_part").c_str())));
  };
  t.changes = {sum("fluid_record_change"), sum("fluid_record_force")};
  t.pressure_drop = number("fluid_record_pressure_drop");
  t.mass = number("fluid_record_mass");
  t.account = {number("fluid_record_start", t.mass), number("fluid_record_in"), number("fluid_record_out")};
  return t;
}

}  // namespace polybed::dem
