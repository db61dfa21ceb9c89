// The model's state in a checkpoint: the whole column, whoever computes it.
#include <algorithm>
#include <array>
#include <utility>

#include "core/blocks.hpp"
#include "core/error.hpp"
#include "core/ranks.hpp"
#include "tfm/model.hpp"

namespace polybed::tfm {

StateLayout Model::layout_on(const core::Grid& grid) const {
  return {grid, int(constants().species()), layout_.with_pressure(), transports_temperature(),
          constants().openings.passages()};
}

core::Checkpoint Model::checkpoint() const {
  core::Checkpoint c;
  const core::Grid& grid = constants().grid;
  const StateLayout column = layout_of_column();
  std::vector<double>& state = c.arrays["state"];
  state.resize(core::is_first(grid.ranks.get()) ? column.size() : 0);
  for (std::size_t n = 0; n < layout_.entries().size(); ++n) {
    core::Field field = core::make_field(grid);
    layout_.unpack(layout_.entries()[n], y_, field);
    const core::Field whole = core::gather(grid, field, layout_.entries()[n].axis);
    if (!state.empty()) column.pack(column.entries()[n], whole, state);
  }
  c.arrays["pressure"] = core::gather(grid, fields().fluid.pressure, -1);
  c.numbers["time_s"] = time_;
  c.numbers["step_s"] = step_;
  c.texts["integrator"] = integrator_name_;
  if (const auto account = fluid_account(time_)) {
    c.numbers["fluid_start_kg"] = account->start;
    c.numbers["fluid_in_kg"] = account->in;
    c.numbers["fluid_out_kg"] = account->out;
  }
  const Work done = work();
  c.integers["steps"] = std::int64_t(done.steps);
  c.integers["rejected_steps"] = std::int64_t(done.rejected_steps);
  c.integers["right_hand_sides"] = std::int64_t(done.right_hand_sides);
  c.integers["pressure_solves"] = std::int64_t(done.pressure_solves);
  c.integers["pressure_iterations"] = std::int64_t(done.pressure_iterations);
  c.integers["newton_iterations"] = std::int64_t(done.newton_iterations);
  c.integers["krylov_iterations"] = std::int64_t(done.krylov_iterations);
  c.integers["first_order_cells"] = std::int64_t(done.first_order_cells);
  if (fallback_ && !fallback_->steps_left().empty()) {
    core::Field left = core::make_field(grid);
    layout_.unpack(layout_.entries().front(), fallback_->steps_left(), left);
    c.arrays["first_order_steps_left"] = core::gather(grid, left, -1);
  }
  return c;
}

/// A run has flags only while a cell is out of bounds, so a checkpoint without them has none.
void Model::restore_fallback(const core::Checkpoint& checkpoint) {
  if (!fallback_) return;
  const core::Grid& grid = constants().grid;
  const core::Ranks* ranks = grid.ranks.get();
  const bool first = core::is_first(ranks);
  const auto flags = checkpoint.arrays.find("first_order_steps_left");
  const auto count = checkpoint.integers.find("first_order_cells");
  std::array<double, 2> known{};
  if (first)
    known = {flags == checkpoint.arrays.end() ? 0.0 : 1.0,
             count == checkpoint.integers.end() ? 0.0 : double(count->second)};
  core::take_from_first(ranks, known);
  std::vector<double> left;
  if (known[0] > 0) {
    core::Field block = core::make_field(grid);
    core::scatter(grid, first ? flags->second : core::Field(), -1, block);
    left.resize(grid.cell_count());
    layout_.pack(layout_.entries().front(), block, left);
  }
  fallback_->restore(layout_, std::move(left), std::uint64_t(known[1]));
  use_fallback();
}

void Model::keep_last_state() { y_.assign(integrator_->state().begin(), integrator_->state().end()); }

void Model::start_from(const core::Checkpoint& checkpoint) {
  resume(checkpoint);
  time_ = step_ = 0;
  before_ = {};
  for (const StateLayout::Entry& entry : layout_.entries())
    if (entry.kind == StateLayout::Entry::Kind::passed)
      std::fill_n(y_.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
  if (compressible()) open_account();
  restore_fallback({});
  begin_integration();
}

void Model::check_fits(const core::Checkpoint& checkpoint) const {
  const auto state = checkpoint.arrays.find("state"), pressure = checkpoint.arrays.find("pressure");
  const auto kind = checkpoint.texts.find("integrator");
  if (state == checkpoint.arrays.end() || state->second.size() != column_size_ || pressure == checkpoint.arrays.end() ||
      pressure->second.size() != core::whole_column(constants().grid).padded_size() || kind == checkpoint.texts.end() ||
      kind->second != integrator_name_)
    throw core::FileError("the checkpoint belongs to another case: its unknowns or its integrator differ");
}

void Model::resume(const core::Checkpoint& checkpoint) {
  const core::Grid& grid = constants().grid;
  const core::Ranks* ranks = grid.ranks.get();
  const bool first = core::is_first(ranks);
  core::on_first(ranks, [&] { check_fits(checkpoint); });
  const StateLayout column = layout_of_column();
  core::Field whole = first ? core::make_field(core::whole_column(grid)) : core::Field(),
              block = core::make_field(grid);
  for (std::size_t n = 0; n < column.entries().size(); ++n) {
    const StateLayout::Entry& entry = column.entries()[n];
    if (first) column.unpack(entry, checkpoint.arrays.at("state"), whole);
    core::scatter(grid, whole, entry.axis, block);
    layout_.pack(layout_.entries()[n], block, y_);
  }
  if (first) whole = checkpoint.arrays.at("pressure");
  core::scatter(grid, whole, -1, equations_.fields().fluid.pressure);
  std::array<double, 2> clock{};
  if (first) clock = {checkpoint.numbers.at("time_s"), checkpoint.numbers.at("step_s")};
  core::take_from_first(ranks, clock);
  time_ = clock[0];
  step_ = clock[1];
  take_up_counts(checkpoint);
  if (compressible()) take_up_account(checkpoint);
  restore_fallback(checkpoint);
  begin_integration();
}

/// Counts go on where they were; they are exact in a double up to 9e15.
void Model::take_up_counts(const core::Checkpoint& checkpoint) {
  const core::Ranks* ranks = constants().grid.ranks.get();
  const auto take = [&](std::uint64_t& count, const char* name) {
    double value = core::is_first(ranks) ? double(checkpoint.integers.at(name)) : 0;
    core::take_from_first(ranks, std::span(&value, 1));
    count = std::uint64_t(value);
  };
  take(before_.steps, "steps");
  take(before_.rejected_steps, "rejected_steps");
  take(before_.right_hand_sides, "right_hand_sides");
  take(before_.pressure_solves, "pressure_solves");
  take(before_.pressure_iterations, "pressure_iterations");
  take(before_.newton_iterations, "newton_iterations");
  take(before_.krylov_iterations, "krylov_iterations");
}

}  // namespace polybed::tfm
