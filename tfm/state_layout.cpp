#include "tfm/state_layout.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polybed::tfm {

using core::Box;
using core::Field;
using core::Index;
using Kind = StateLayout::Entry::Kind;

StateLayout::StateLayout(const core::Grid& grid, int species, bool with_pressure, bool with_temperature,
                         const std::vector<fluid::Openings::Passage>& passages)
    : grid_(grid), with_pressure_(with_pressure) {
  for (int j = 0; j < species; ++j) add(Kind::fraction, j, -1, core::owned_cells(grid));
  for (int j = 0; j < species; ++j)
    for (int axis = 0; axis < grid.dimensions; ++axis) add(Kind::velocity, j, axis, core::owned_faces(grid, axis));
  for (int axis = 0; axis < grid.dimensions; ++axis) add(Kind::flux, -1, axis, core::owned_faces(grid, axis));
  for (int j = 0; j < species && with_temperature; ++j) add(Kind::temperature, j, -1, core::owned_cells(grid));
  for (const auto& passage : passages) {
    const int axis = axis_of(passage.at), side = side_of(passage.at);
    const auto a = std::size_t(axis);
    Box row = core::owned_faces(grid, axis);
    row.lo[a] = side == 0 ? 0 : grid.cells[a];
    row.hi[a] = row.lo[a] + (grid.ends(axis, side) ? 1 : 0);
    add(Kind::passed, int(passage.species), axis, row);
  }
  if (with_pressure) add(Kind::pressure, -1, -1, core::owned_cells(grid));
}

void StateLayout::add(Kind kind, int species, int axis, const Box& box) {
  std::size_t count = 1;
  for (std::size_t d = 0; d < 3; ++d) count *= std::size_t(box.hi[d] - box.lo[d]);
  entries_.push_back({kind, species, axis, size_, count, box});
  size_ += count;
}

void StateLayout::unpack(const Entry& entry, std::span<const double> y, Field& field) const {
  const double* from = y.data() + entry.begin;
  core::for_each_row(grid_, entry.box, [&](Index begin, Index end) {
    std::copy(from, from + (end - begin), field.begin() + begin);
    from += end - begin;
  });
}

void StateLayout::pack(const Entry& entry, const Field& field, std::span<double> y) const {
  double* to = y.data() + entry.begin;
  core::for_each_row(grid_, entry.box,
                     [&](Index begin, Index end) { to = std::copy(field.begin() + begin, field.begin() + end, to); });
}

void StateLayout::unpack(std::span<const double> y, fluid::Interphase& solids, fluid::FluidState& fluid) const {
  for (const Entry& entry : entries_) unpack(entry, y, field_of(entry, solids, fluid));
}

void StateLayout::pack(const fluid::Interphase& solids, const fluid::FluidState& fluid, std::span<double> y) const {
  for (const Entry& entry : entries_) pack(entry, field_of(entry, solids, fluid), y);
}

std::string StateLayout::name_of(const Entry& entry, const std::vector<std::string>& species) {
  static constexpr const char* axis_name[] = {"x", "y", "z"};
  const auto of_species = [&](const char* symbol) {
    return fmt::format("{}_{}", symbol, species.at(std::size_t(entry.species)));
  };
  switch (entry.kind) {
    case Kind::fraction:
      return of_species("phi");
    case Kind::velocity:
      return fmt::format("{}.{}", of_species("u"), axis_name[entry.axis]);
    case Kind::flux:
      return fmt::format("flux.{}", axis_name[entry.axis]);
    case Kind::temperature:
      return of_species("theta");
    case Kind::passed:
      return fmt::format("{}.{}", of_species("passed"),
                         core::name_of(core::face_of(entry.axis, entry.box.lo[std::size_t(entry.axis)] == 0 ? 0 : 1)));
    case Kind::pressure:
      break;
  }
  return "pressure";
}

std::string StateLayout::describe(std::size_t index, const std::vector<std::string>& species) const {
  for (const Entry& entry : entries_) {
    if (index >= entry.begin + entry.size) continue;
    const auto nx = std::size_t(entry.box.hi[0] - entry.box.lo[0]);
    const auto ny = std::size_t(entry.box.hi[1] - entry.box.lo[1]);
    const std::size_t local = index - entry.begin;
    const std::string name = name_of(entry, species);
    const auto before = [&](std::size_t axis) { return std::size_t(grid_.before[axis]); };
    const std::size_t i = before(0) + local % nx, j = before(1) + local / nx % ny, k = before(2) + local / nx / ny;
    return grid_.dimensions == 2 ? fmt::format("{} ({}, {})", name, i, j)
                                 : fmt::format("{} ({}, {}, {})", name, i, j, k);
  }
  return "?";
}

}  // namespace polybed::tfm
