// The model's state in a checkpoint: each rank writes its block of the column, for any number of readers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "core/numerics/metric.hpp"
#include "core/numerics/ranks.hpp"
#include "tfm/model.hpp"
#include "tfm/parts.hpp"

namespace polybed::tfm {

namespace {

/// Counts of a closed integrator; first-order cells are counted by the fallback, which continues.
constexpr std::array<std::pair<const char*, std::uint64_t Work::*>, 7> counts{
    {{"steps", &Work::steps},
     {"rejected_steps", &Work::rejected_steps},
     {"right_hand_sides", &Work::right_hand_sides},
     {"pressure_solves", &Work::pressure_solves},
     {"pressure_iterations", &Work::pressure_iterations},
     {"newton_iterations", &Work::newton_iterations},
     {"krylov_iterations", &Work::krylov_iterations}}};

}  // namespace

StateLayout Model::layout_on(const core::Grid& grid) const {
  return {grid, int(constants().species()), layout_.with_pressure(), transports_temperature(),
          constants().openings.passages()};
}

namespace {

/// Place of a block's entry of the state in the column's.
core::Slab slab_of(const core::Grid& grid, const StateLayout::Entry& entry, const StateLayout::Entry& column) {
  core::Slab slab;
  for (std::size_t axis = std::size_t(grid.dimensions); axis-- > 0;) {
    slab.shape.push_back(std::size_t(column.box.hi[axis] - column.box.lo[axis]));
    slab.count.push_back(std::size_t(entry.box.hi[axis] - entry.box.lo[axis]));
    const bool any = slab.count.back() > 0;
    slab.start.push_back(any ? std::size_t(grid.before[axis] + entry.box.lo[axis] - column.box.lo[axis]) : 0);
  }
  return slab;
}

/// Range of an unknown: far beyond the result of any step, and far below values that make the next one fail.
std::pair<double, double> range_of(StateLayout::Entry::Kind kind) {
  using Kind = StateLayout::Entry::Kind;
  constexpr double undershoot = 0.1, fastest = 1e5, highest = 1e13;  // for a fraction; m/s; Pa
  if (kind == Kind::fraction) return {-undershoot, 1 + undershoot};
  if (kind == Kind::temperature) return {-undershoot, fastest * fastest};
  if (kind == Kind::pressure) return {-highest, highest};
  if (kind == Kind::passed) return {-highest, highest};
  return {-fastest, fastest};
}

}  // namespace

core::CheckpointParts Model::checkpoint_parts() const {
  core::CheckpointParts parts;
  const StateLayout column = layout_of_column();
  for (std::size_t n = 0; n < layout_.entries().size(); ++n) {
    const StateLayout::Entry& entry = layout_.entries()[n];
    parts["state"].push_back(
        {layout_.name_of(entry, constants().name), slab_of(constants().grid, entry, column.entries()[n])});
  }
  const core::Slab cells = parts["state"].front().slab;  // fractions come first
  parts["pressure"] = {{"cells", cells}};
  parts["first_order_steps_left"] = {{"cells", cells}};
  return parts;
}

core::Checkpoint Model::checkpoint() const {
  core::Checkpoint c;
  c.arrays["state"] = y_;
  c.arrays["pressure"].resize(constants().grid.cell_count());
  layout_.pack(layout_.entries().front(), fields().fluid.pressure, c.arrays["pressure"]);
  // A guess for the next solve; the last one may have failed.
  for (double& p : c.arrays["pressure"])
    if (!std::isfinite(p)) p = 0;
  for (const auto& part : parts_) part->write(c, time_);
  for (auto& [name, parts] : checkpoint_parts())
    if (c.arrays.contains(name)) c.parts[name] = std::move(parts);
  core::put_layers(constants().grid, c);
  c.numbers["time_s"] = time_;
  c.numbers["step_s"] = step_;
  c.texts["integrator"] = core::name_of(integrator_.kind);
  const Work done = work();
  for (const auto& [name, count] : counts) c.integers[name] = std::int64_t(done.*count);
  c.integers["first_order_cells"] = std::int64_t(done.first_order_cells);
  return c;
}

void Model::keep_last_state() {
  if (time_ == last_step_.time) y_.assign(integrator().state().begin(), integrator().state().end());
}

namespace {

/// Clears cells and faces that a round wall closes, as the state can come from another column.
void clear_closed(const core::Grid& grid, const StateLayout& layout, std::span<double> y) {
  using Kind = StateLayout::Entry::Kind;
  if (!grid.metric) return;
  for (const StateLayout::Entry& entry : layout.entries()) {
    if (entry.kind == Kind::passed || entry.kind == Kind::pressure) continue;
    const bool on_faces = entry.kind == Kind::velocity || entry.kind == Kind::flux;
    const core::Field& open = on_faces ? grid.metric->open[std::size_t(entry.axis)] : grid.metric->volume;
    core::Field values = core::make_field(grid);
    layout.unpack(entry, y, values);
    for (std::size_t c = 0; c < values.size(); ++c)
      if (!(open[c] > 0)) values[c] = 0;
    layout.pack(entry, values, y);
  }
}

/// The flux of a state through the ends and sides where it is given; 0 elsewhere.
core::FaceField flux_at_ends(const core::Grid& grid, const fluid::Boundaries& boundaries, const StateLayout& layout,
                             std::span<const double> y) {
  core::FaceField flux = core::make_face_field(grid), at_ends = flux;
  for (const StateLayout::Entry& entry : layout.entries())
    if (entry.kind == StateLayout::Entry::Kind::flux) layout.unpack(entry, y, flux[std::size_t(entry.axis)]);
  const auto take = [&](core::ColumnFace at) {
    const auto a = std::size_t(axis_of(at));
    fluid::for_each_boundary_row(grid, axis_of(at), side_of(at), [&](core::Index begin, core::Index end) {
      std::copy(flux[a].begin() + begin, flux[a].begin() + end, at_ends[a].begin() + begin);
    });
  };
  take(core::ColumnFace::bottom);
  if (!boundaries.has_outlet()) take(core::ColumnFace::top);
  for (const core::ColumnFace at : boundaries.crossed()) take(at);
  return at_ends;
}

}  // namespace

void Model::start_from(const core::Checkpoint& checkpoint) {
  resume(checkpoint);
  clear_closed(constants().grid, layout_, y_);
  if (!effects().compressible)  // the inflow can differ now; a compressible fluid responds by sound
    project_jump(equations_, layout_, velocity_scale_, 0, flux_at_ends(constants().grid, boundaries(), layout_, y_),
                 y_);
  time_ = step_ = 0;
  before_ = {};
  for (const StateLayout::Entry& entry : layout_.entries())
    if (entry.kind == StateLayout::Entry::Kind::passed)
      std::fill_n(y_.begin() + std::ptrdiff_t(entry.begin), entry.size, 0.0);
  for (const auto& part : parts_) part->begin_from_other(time_, y_);
  begin_integration();
}

void Model::check_fits(const core::Checkpoint& checkpoint) const {
  const auto state = checkpoint.arrays.find("state"), pressure = checkpoint.arrays.find("pressure");
  const auto kind = checkpoint.texts.find("integrator");
  const bool first = core::is_first(constants().grid.ranks.get());  // texts are on the first rank
  if (state == checkpoint.arrays.end() || state->second.size() != y_.size() || pressure == checkpoint.arrays.end() ||
      pressure->second.size() != constants().grid.cell_count() ||
      (first && (kind == checkpoint.texts.end() || kind->second != core::name_of(integrator_.kind))))
    throw core::FileError("the checkpoint belongs to another case: its unknowns or its integrator differ");
  if (first) core::require_layers(constants().grid, checkpoint);
  core::require_numbers(checkpoint);
  for (const StateLayout::Entry& entry : layout_.entries()) {
    const auto [least, most] = range_of(entry.kind);
    const auto begin = state->second.begin() + std::ptrdiff_t(entry.begin), end = begin + std::ptrdiff_t(entry.size);
    const auto odd = std::find_if(begin, end, [&](double v) { return !(v >= least && v <= most); });
    if (odd != end)
      core::refuse_checkpoint(fmt::format("{} is {:g}", StateLayout::name_of(entry, constants().name), *odd));
  }
}

void Model::resume(const core::Checkpoint& checkpoint) {
  const core::Ranks* ranks = constants().grid.ranks.get();
  core::on_all(ranks, [&] { check_fits(checkpoint); });
  y_ = checkpoint.arrays.at("state");
  layout_.unpack(layout_.entries().front(), checkpoint.arrays.at("pressure"), equations_.fields().fluid.pressure);
  std::array<double, 2> clock{};
  core::on_first(ranks, [&] { clock = {checkpoint.time("time_s"), checkpoint.time("step_s")}; });
  core::take_from_first(ranks, clock);
  time_ = clock[0];
  step_ = clock[1];
  restore_counts(checkpoint);
  for (const auto& part : parts_) part->read(checkpoint, time_);
  begin_integration();
}

/// Continues the counts; they are exact in a double up to 9e15.
void Model::restore_counts(const core::Checkpoint& checkpoint) {
  const core::Ranks* ranks = constants().grid.ranks.get();
  std::array<double, counts.size()> values{};
  core::on_first(ranks, [&] {
    for (std::size_t n = 0; n < counts.size(); ++n) values[n] = double(checkpoint.count(counts[n].first));
  });
  core::take_from_first(ranks, values);
  for (std::size_t n = 0; n < counts.size(); ++n) before_.*(counts[n].second) = std::uint64_t(values[n]);
}

}  // namespace polybed::tfm
