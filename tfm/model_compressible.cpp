// What the model does for a compressible fluid: its pressure at the start, and the account of its mass.
#include <fmt/format.h>

#include <array>

#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "tfm/model.hpp"

namespace polybed::tfm {

using core::Index;

namespace {

/// Shifts the pressure of a closed column, which is known but for a constant, to 0 in the mean of its top layer.
void start_from_the_top(const core::Grid& grid, core::Field& pressure) {
  core::Box top = core::owned_cells(grid);
  top.lo[1] = grid.ends(1, 1) ? top.hi[1] - 1 : top.hi[1];
  double sum = 0;
  core::for_each_row(grid, top, [&](Index begin, Index end) {
    for (Index c = begin; c < end; ++c) sum += pressure[std::size_t(c)];
  });
  const double mean = core::sum_of_ranks(grid, sum) / (double(grid.column_cells(0)) * grid.column_cells(2));
  for (double& p : pressure) p -= mean;
}

[[noreturn]] void no_rates() {
  throw core::NumericsError(
      "the state at the start has no rates: check the bed's solids fraction and fluid.outlet_pressure");
}

}  // namespace

/// A compressible fluid begins with the pressure that an incompressible one would have, so that sound is heard only
/// where something happens.
void Model::start_compressible() {
  equations_.begin(time_);
  ExplicitProblem projected(equations_, layout_, 1e-8, timers_);
  if (projected.rates(time_, y_, dydt_) != core::Rate::ok) no_rates();
  core::Field& pressure = equations_.fields().fluid.pressure;
  if (boundaries().closed()) start_from_the_top(constants().grid, pressure);
  for (const StateLayout::Entry& entry : layout_.entries())
    if (entry.kind == StateLayout::Entry::Kind::pressure) layout_.pack(entry, pressure, y_);
  open_account();
}

/// Nothing has flowed yet, and what is there is there.
void Model::open_account() {
  if (!equations_.evaluate(time_, layout_, y_)) no_rates();
  ledger_.begin(time_, {fluid::fluid_mass(constants().grid, fields().fluid), 0, 0}, {});
}

/// Rates of all unknowns, the pressure among them; the unknowns take the inlet's flux, which may have jumped.
void Model::begin_compressible() {
  if (CompressibleProblem(equations_, layout_).rates(time_, y_, dydt_) != core::Rate::ok) no_rates();
  layout_.pack(fields().solids, fields().fluid, y_);
  // What is left of (5) over a small kappa is a rate of the pressure that means nothing beyond the first instant. The
  // first implicit step is of order 1 and uses rates as its first guess alone, for which 0 is the better one.
  if (implicit_)
    for (const StateLayout::Entry& entry : layout_.entries())
      if (entry.kind == StateLayout::Entry::Kind::pressure)
        std::fill_n(dydt_.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
  ledger_.begin(time_, ledger_.at(time_),
                fluid::mass_flow(constants().grid, boundaries(), fields().fluid, fields().fluid.compression.flux[1]));
}

void Model::count_fluid(std::span<const double> y) {
  const auto flow = equations_.mass_flow(time_, layout_, y);
  if (!flow)
    throw core::NumericsError(fmt::format("t = {:.9g} s: a pressure at which the fluid has no density", time_));
  ledger_.advance(time_, *flow);
}

void Model::restore_account(const core::Checkpoint& checkpoint) {
  std::array<double, 3> kg{};
  const auto kept = [&](const char* name) {  // 0 from an incompressible fluid, from which a run may begin
    const auto number = checkpoint.numbers.find(name);
    return number == checkpoint.numbers.end() ? 0.0 : number->second;
  };
  if (core::is_first(constants().grid.ranks.get()))
    kg = {kept("fluid_start_kg"), kept("fluid_in_kg"), kept("fluid_out_kg")};
  core::take_from_first(constants().grid.ranks.get(), kg);
  ledger_.begin(time_, {kg[0], kg[1], kg[2]}, {});
}

std::optional<fluid::MassAccount> Model::fluid_account(double t) const {
  if (!compressible()) return std::nullopt;
  return ledger_.at(t);
}

}  // namespace polybed::tfm
