#include "tfm/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "fluid/pressure.hpp"
#include "tfm/compressible_problem.hpp"
#include "tfm/explicit_problem.hpp"
#include "tfm/pressure_coupling.hpp"

namespace polybed::tfm {

namespace {

using core::Index;

/// Shifts the pressure of a closed column, which is defined up to a constant, to 0 in the mean over its top layer.
void start_from_the_top(const core::Grid& grid, core::Field& pressure) {
  core::Box top = core::owned_cells(grid);
  top.lo[1] = grid.ends(1, 1) ? top.hi[1] - 1 : top.hi[1];
  std::vector<double> layer;
  core::with_metric(grid, [&](const auto& metric) {
    core::for_each_row(grid, top, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) layer.push_back(metric.volume(c) * pressure[std::size_t(c)]);
    });
  });
  const double mean = core::sum_of_ranks(grid, layer) / core::open_cells_of_layer(grid, grid.column_cells(1) - 1);
  for (double& p : pressure) p -= mean;
}

/// The inlet's velocity on the faces where it is given, as a field that is 0 elsewhere.
core::FaceField inlet_velocity(const RightHandSide& equations, double t) {
  core::FaceField flux = core::make_face_field(equations.constants().grid);
  equations.inlet().set_velocity(t, flux);
  return flux;
}

}  // namespace

void FollowBed::prepare(std::span<const double> y) {
  constexpr double trace = 1e-12;  // of the fraction: such traces stay where they are
  constexpr int margin = 8;
  const core::Grid& grid = equations_.constants().grid;
  const auto holds_solids = [&](int row) {
    const auto nx = std::size_t(grid.cells[0]);
    for (const StateLayout::Entry& entry : layout_.entries())
      for (int k = 0; k < grid.cells[2] && entry.kind == StateLayout::Entry::Kind::fraction; ++k) {
        const auto cells =
            y.subspan(entry.begin + (std::size_t(k) * std::size_t(grid.cells[1]) + std::size_t(row)) * nx, nx);
        if (std::any_of(cells.begin(), cells.end(), [](double phi) { return std::abs(phi) > trace; })) return true;
      }
    return false;
  };
  int rows = grid.cells[1];
  while (rows > 0 && !holds_solids(rows - 1)) --rows;
  const int held = int(core::greatest_of_ranks(grid, rows > 0 ? grid.before[1] + rows : 0)) + margin;
  equations_.hold_solids_above(held < grid.column_cells(1) ? held : std::numeric_limits<int>::max());
}

/// Starts with the pressure of an incompressible fluid, so that sound occurs only where something happens.
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

/// Starts the account: no flow yet, and the present mass.
void CompressibleFluid::begin_from_other(double time, std::span<const double> y) {
  if (!equations_.evaluate(time, layout_, y)) refuse_compressible_start();
  ledger_.begin(time, {fluid::fluid_mass(equations_.constants().grid, equations_.fields().fluid), 0, 0}, {});
}

void CompressibleFluid::begin(double time) {
  const fluid::FluidState& fluid = equations_.fields().fluid;
  ledger_.begin(time, ledger_.at(time),
                fluid::mass_flow(equations_.constants().grid, equations_.boundaries(), fluid, fluid.compression.flux));
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
  const auto kept = [&](const char* name) {  // 0 for an incompressible fluid, from which a run can start
    const auto number = checkpoint.numbers.find(name);
    return number == checkpoint.numbers.end() ? 0.0 : number->second;
  };
  if (core::is_first(ranks)) kg = {kept("fluid_start_kg"), kept("fluid_in_kg"), kept("fluid_out_kg")};
  core::take_from_first(ranks, kg);
  ledger_.begin(time, {kg[0], kg[1], kg[2]}, {});
}

void project_jump(RightHandSide& equations, const StateLayout& layout, double velocity_scale, double time,
                  const core::FaceField& before, std::span<double> y) {
  const Constants& constants = equations.constants();
  if (equations.boundaries().closed()) return;
  core::FaceField jump = inlet_velocity(equations, std::nextafter(time, INFINITY));
  double most = 0;
  for (std::size_t a = 0; a < jump.size(); ++a)
    for (std::size_t f = 0; f < jump[a].size(); ++f) most = std::max(most, std::abs(jump[a][f] -= before[a][f]));
  if (core::greatest_of_ranks(constants.grid, most) <= 1e-9 * velocity_scale) return;
  if (!equations.evaluate(time, layout, y)) return;
  Fields& fields = equations.fields();
  const core::Field pressure = fields.fluid.pressure;
  for (core::FaceField& a : fields.solids.acceleration)
    for (core::Field& rate : a) std::fill(rate.begin(), rate.end(), 0.0);
  fields.flux_rate.free = jump;
  fluid::Pressure impulse(constants.grid, 1e-10);
  std::fill(fields.fluid.pressure.begin(), fields.fluid.pressure.end(), 0.0);
  impulse.solve(fields.flux_rate, fields.fluid.flux, 0.0, fields.fluid.pressure);
  subtract_pressure_gradient(constants, equations.boundaries(), fields);
  for (std::size_t j = 0; j < constants.species(); ++j)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t f = 0; f < fields.solids.velocity[j][a].size(); ++f)
        fields.solids.velocity[j][a][f] += fields.solids.acceleration[j][a][f];
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t f = 0; f < fields.fluid.flux[a].size(); ++f)
      fields.fluid.flux[a][f] += fields.flux_rate.free[a][f];
  fields.fluid.pressure = pressure;
  layout.pack(fields.solids, fields.fluid, y);
}

void InletJump::restart(double time, std::span<double> y) {
  project_jump(equations_, layout_, velocity_scale_, time, inlet_velocity(equations_, std::nextafter(time, -INFINITY)),
               y);
}

void FirstOrder::use() {
  equations_.take_first_order_on(fallback_.steps_left().empty() ? nullptr : &fallback_.faces());
}

void FirstOrder::end_step(std::span<const double> y) {
  fallback_.see(layout_, y, equations_.effects().solids_stress.get());
  use();
}

void FirstOrder::begin_from_other(double, std::span<const double>) {
  fallback_.restore(layout_, {}, 0);
  use();
}

void FirstOrder::write(core::Checkpoint& checkpoint, double) const {
  if (!fallback_.steps_left().empty()) checkpoint.arrays["first_order_steps_left"] = fallback_.steps_left();
}

/// A run has flags only while a cell is out of bounds, so a checkpoint can lack them.
void FirstOrder::read(const core::Checkpoint& checkpoint, double) {
  const auto flags = checkpoint.arrays.find("first_order_steps_left");
  const bool known = checkpoint.integers.contains("first_order_cells");
  double count = known ? double(checkpoint.count("first_order_cells")) : 0.0;
  core::take_from_first(equations_.constants().grid.ranks.get(), std::span(&count, 1));
  fallback_.restore(layout_, flags == checkpoint.arrays.end() ? std::vector<double>() : flags->second,
                    std::uint64_t(count));
  use();
}

}  // namespace polybed::tfm
