#include "tfm/parts/compressible_fluid.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "tfm/compressible_problem.hpp"
#include "tfm/explicit_problem.hpp"

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

}  // namespace

/// It begins with the pressure that an incompressible fluid would have, so that sound is heard only where something
/// happens.
void CompressibleFluid::start(double time, std::span<double> y) {
  equations_.begin(time);
  std::vector<double> rates(y.size());
  if (ExplicitProblem(equations_, layout_, 1e-8, timers_).rates(time, y, rates) != core::Rate::ok)
    refuse_compressible_start();
  core::Field& pressure = equations_.fields().fluid.pressure;
  if (equations_.boundaries().closed()) start_from_the_top(equations_.constants().grid, pressure);
  for (const StateLayout::Entry& entry : layout_.entries())
    if (entry.kind == StateLayout::Entry::Kind::pressure) layout_.pack(entry, pressure, y);
  begin_from_other(time, y);
}

/// Nothing has flowed yet, and what is there is there.
void CompressibleFluid::begin_from_other(double time, std::span<const double> y) {
  if (!equations_.evaluate(time, layout_, y)) refuse_compressible_start();
  ledger_.begin(time, {fluid::fluid_mass(equations_.constants().grid, equations_.fields().fluid), 0, 0}, {});
}

void CompressibleFluid::begin(double time) {
  const fluid::FluidState& fluid = equations_.fields().fluid;
  ledger_.begin(
      time, ledger_.at(time),
      fluid::mass_flow(equations_.constants().grid, equations_.boundaries(), fluid, fluid.compression.flux[1]));
}

void CompressibleFluid::accept(double time, std::span<const double> y) {
  const auto flow = equations_.mass_flow(time, layout_, y);
  if (!flow) throw core::NumericsError(fmt::format("t = {:.9g} s: a pressure at which the fluid has no density", time));
  ledger_.advance(time, *flow);
}

void CompressibleFluid::write(core::Checkpoint& checkpoint, double time) const {
  const fluid::MassAccount now = account(time);
  checkpoint.numbers["fluid_start_kg"] = now.start;
  checkpoint.numbers["fluid_in_kg"] = now.in;
  checkpoint.numbers["fluid_out_kg"] = now.out;
}

void CompressibleFluid::read(const core::Checkpoint& checkpoint, double time) {
  const core::Ranks* ranks = equations_.constants().grid.ranks.get();
  std::array<double, 3> kg{};
  const auto kept = [&](const char* name) {  // 0 from an incompressible fluid, from which a run may begin
    const auto number = checkpoint.numbers.find(name);
    return number == checkpoint.numbers.end() ? 0.0 : number->second;
  };
  if (core::is_first(ranks)) kg = {kept("fluid_start_kg"), kept("fluid_in_kg"), kept("fluid_out_kg")};
  core::take_from_first(ranks, kg);
  ledger_.begin(time, {kg[0], kg[1], kg[2]}, {});
}

}  // namespace polybed::tfm
