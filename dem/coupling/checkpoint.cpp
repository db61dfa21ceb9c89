// The fluid between particles, to the bit, as one column on however many ranks.
#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "dem/coupling/coupling.hpp"

namespace polybed::dem {

using core::Field;

/// A field of the whole column, on every rank.
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

/// What this rank's fluid has of a field of the whole column.
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

void Coupling::write(core::Checkpoint& checkpoint) const {
  for (std::size_t a = 0; a < std::size_t(flow_.grid().dimensions); ++a)
    checkpoint.arrays[fmt::format("fluid_velocity_{}", a)] = of_column(flow_.state().velocity[a]);
  checkpoint.arrays["fluid_pressure"] = of_column(flow_.state().pressure);
  checkpoint.arrays["fluid_at_ends"] = of_column(at_ends_);
  for (std::size_t j = 0; j < fraction_.size(); ++j)
    checkpoint.arrays[fmt::format("fluid_fraction_{}", j)] = of_column(fraction_[j]);
  checkpoint.integers["fluid_steps"] = std::int64_t(steps_);
}

void Coupling::read(const core::Checkpoint& checkpoint) {
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
