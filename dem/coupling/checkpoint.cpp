// Reads and writes the fluid between particles, to the bit, as one column for any number of ranks.
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "dem/coupling/coupling.hpp"
#include "dem/kept_sums.hpp"
#include "dem/parallel/gathered.hpp"

namespace polybed::dem {

using core::Field;

/// A field for the whole column, on every rank.
Field Coupling::of_column(const Field& own) const {
  if (!exchange_) return own;
  GridExchange all = *exchange_;
  all.choose_all();
  Field column = core::make_field(core::whole_column(flow_.grid()));
  const std::pair<const Field*, Field*> fields{&own, &column};
  all.fetch(std::span(&fields, 1));
  return column;
}

Coupling::Column Coupling::column() const {
  Column all{core::whole_column(flow_.grid()), {}, {}, of_column(flow_.state().pressure), {}, {}};
  for (const Field& phi : fraction_) all.fraction.push_back(of_column(phi));
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a)
    all.velocity[a] = of_column(flow_.state().velocity[a]);
  if (const fluid::Compressible* compressible = flow_.compressible()) {
    all.total_pressure = of_column(compressible->total_pressure(flow_.state()));
    all.density = of_column(flow_.state().compression.density);
  }
  return all;
}

/// Copies this rank's part of a field for the whole column.
void Coupling::take_own(const Field& column, Field& own) const {
  if (!exchange_) {
    own = column;
    return;
  }
  const core::Grid &block = flow_.grid(), whole = core::whole_column(block);
  core::Box box = core::owned_cells(block);
  for (int axis = 0; axis < block.dimensions; ++axis)
    if (block.after[std::size_t(axis)] == 0) ++box.hi[std::size_t(axis)];
  for (int k = 0; k < box.hi[2]; ++k)
    for (int j = 0; j < box.hi[1]; ++j)
      for (int i = 0; i < box.hi[0]; ++i)
        own[std::size_t(block.index(i, j, k))] =
            column[std::size_t(whole.index(i + block.before[0], j + block.before[1], k + block.before[2]))];
}

namespace {

constexpr std::size_t load_width = 11;

void write_loads(core::Checkpoint& checkpoint, const std::vector<KeptLoad>& loads) {
  std::vector<double>& out = checkpoint.arrays["fluid_loads"];
  for (const auto& [id, f] : loads) {
    out.insert(out.end(), f.velocity.begin(), f.velocity.end());
    out.insert(out.end(), f.force.begin(), f.force.end());
    out.insert(out.end(), f.impulse.begin(), f.impulse.end());
    out.push_back(f.drag);
    out.push_back(f.added);
  }
}

FluidLoad read_load(const double* in) {
  return {{in[0], in[1], in[2]}, in[9], {in[3], in[4], in[5]}, {in[6], in[7], in[8]}, in[10]};
}

}  // namespace

void Coupling::write(core::Checkpoint& checkpoint, const Particles& particles, const core::Ranks* ranks) const {
  write_loads(checkpoint, gathered_loads(keep(particles, motion_.load), ranks_));
  if (sides_.present()) {
    KeptRows rows = keep(particles, sides_.rows());
    checkpoint.arrays["fluid_sides"] = gathered_rows(std::move(rows.numbers), rows.width, 1, ranks_);
  }
  write_fields(checkpoint);
  for (std::size_t a = 0; a < 3 && frame_; ++a) {
    checkpoint.numbers[fmt::format("fluid_momentum_{}", a)] = frame_->momentum[a];
    checkpoint.numbers[fmt::format("fluid_momentum_now_{}", a)] = frame_->now[a];
    checkpoint.numbers[fmt::format("fluid_frame_{}", a)] = frame_->velocity[a];
  }
  write_sum(checkpoint, ranks, "fluid_work", motion_.work());
}

void Coupling::require(const core::Checkpoint& checkpoint) const {
  require_sum(checkpoint, "fluid_work");
  (void)checkpoint.integer("fluid_steps");
  (void)checkpoint.array("fluid_loads");
}

void Coupling::read(const Restored& from) {
  const bool with_fluid =
      core::on_any_rank(from.ranks, core::is_first(from.ranks) && from.checkpoint.arrays.contains("fluid_loads"));
  motion_.load.assign(from.particles.owned, FluidLoad{});
  sides_.rows().clear(from.particles.owned);
  drive(from.particles);
  if (with_fluid) {
    read_loads(from);
    read_fields(from.checkpoint);
    motion_.set_work(sum_on_first(from.ranks, from.checkpoint, "fluid_work"));
    if (frame_ && from.same_run) read_frame(from);
  }
  if (from.same_run && sides_.present()) read_sides(from);
}

void Coupling::read_frame(const Restored& from) {
  std::array<double, 9> numbers{};
  core::on_first(from.ranks, [&] {
    for (std::size_t a = 0; a < 3; ++a) {
      numbers[a] = from.checkpoint.number(fmt::format("fluid_momentum_{}", a));
      numbers[3 + a] = from.checkpoint.number(fmt::format("fluid_momentum_now_{}", a));
      numbers[6 + a] = from.checkpoint.number(fmt::format("fluid_frame_{}", a));
    }
  });
  core::take_from_first(from.ranks, numbers);
  for (std::size_t a = 0; a < 3; ++a) {
    frame_->momentum[a] = numbers[a];
    frame_->now[a] = numbers[3 + a];
    frame_->velocity[a] = numbers[6 + a];
  }
}

void Coupling::read_loads(const Restored& from) {
  std::vector<double> loads(from.all.size() * load_width);
  core::on_first(from.ranks, [&] {
    if (from.checkpoint.array("fluid_loads").size() != loads.size())
      core::refuse_checkpoint("fluid_loads is not of these particles");
    loads = from.checkpoint.array("fluid_loads");
  });
  core::take_from_first(from.ranks, loads);
  std::unordered_map<std::int64_t, std::size_t> row;
  for (std::size_t n = 0; n < from.all.size(); ++n) row[from.all[n].id] = n;
  for (std::size_t i = 0; i < from.particles.owned; ++i)
    motion_.load[i] = read_load(loads.data() + row.at(from.particles.id[i]) * load_width);
}

/// Restores the side forces' data of the particles; forces without data in the checkpoint start with none.
void Coupling::read_sides(const Restored& from) {
  SideRows& rows = sides_.rows();
  const bool any =
      core::on_any_rank(from.ranks, core::is_first(from.ranks) && from.checkpoint.arrays.contains("fluid_sides"));
  if (!any && rows.width == SideRows::force_size) return;
  KeptRows kept{rows.width + 1, std::vector<double>(from.all.size() * (rows.width + 1))};
  core::on_first(from.ranks, [&] {
    const auto found = from.checkpoint.arrays.find("fluid_sides");
    if (found == from.checkpoint.arrays.end() || found->second.size() != kept.numbers.size())
      throw core::FileError("the checkpoint lacks what a force on particles keeps of them: it is of other [effects]");
    kept.numbers = found->second;
  });
  core::take_from_first(from.ranks, kept.numbers);
  recall(kept, from.particles, rows);
}

void Coupling::write_fields(core::Checkpoint& checkpoint) const {
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a)
    checkpoint.arrays[fmt::format("fluid_velocity_{}", a)] = of_column(flow_.state().velocity[a]);
  checkpoint.arrays["fluid_pressure"] = of_column(flow_.state().pressure);
  checkpoint.arrays["fluid_at_ends"] = of_column(at_ends_);
  for (std::size_t j = 0; j < fraction_.size(); ++j)
    checkpoint.arrays[fmt::format("fluid_fraction_{}", j)] = of_column(fraction_[j]);
  checkpoint.integers["fluid_steps"] = std::int64_t(steps_);
  core::put_layers(flow_.grid(), checkpoint);
}

void Coupling::read_fields(const core::Checkpoint& checkpoint) {
  core::on_first(ranks_.get(), [&] { core::require_layers(flow_.grid(), checkpoint); });
  Field column = core::make_field(core::whole_column(flow_.grid()));
  const auto take = [&](const std::string& name, double least, double most, Field& own) {
    core::on_first(ranks_.get(), [&] {
      const auto found = checkpoint.arrays.find(name);
      if (found == checkpoint.arrays.end() || found->second.size() != column.size())
        throw core::FileError("the checkpoint is of a case without a fluid, or on another grid");
      column = found->second;
      const auto odd = std::find_if(column.begin(), column.end(), [&](double v) { return v < least || v > most; });
      if (odd != column.end()) core::refuse_checkpoint(fmt::format("{} is {:g}", name, *odd));
    });
    core::take_from_first(ranks_.get(), column);
    take_own(column, own);
  };
  constexpr double fastest = 1e5, highest = 1e13;  // m/s; Pa and N/m3
  constexpr double rounding = 1e-9, densest = 10;  // averages over cells smaller than a particle exceed 1
  fluid::FluidState& fluid = flow_.state();
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a)
    take(fmt::format("fluid_velocity_{}", a), -fastest, fastest, fluid.velocity[a]);
  take("fluid_pressure", -highest, highest, fluid.pressure);
  take("fluid_at_ends", -highest, highest, at_ends_);
  for (std::size_t j = 0; j < fraction_.size(); ++j)
    take(fmt::format("fluid_fraction_{}", j), -rounding, densest, fraction_[j]);
  flow_.set_gradient();
  flow_.forget();
  take_fields();
  const auto count = [&](const char* name) {
    return checkpoint.integers.contains(name) ? std::uint64_t(checkpoint.count(name)) : 0;
  };
  steps_ = count("fluid_steps");
}

}  // namespace polybed::dem
