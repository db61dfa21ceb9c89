#include "tfm/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/numerics/ranks.hpp"

namespace polybed::tfm {

using core::Index;
using Kind = StateLayout::Entry::Kind;

Tolerances tolerances_of(const RightHandSide& equations, const StateLayout& layout, double rtol, double velocity_scale,
                         double pressure_scale) {
  Tolerances tolerances;
  tolerances.relative = rtol;
  std::vector<double>& atol = tolerances.absolute;
  atol.resize(layout.size());
  constexpr double not_tested = 1e9;  // m: sums of fluxes follow from the rest and need no error test
  for (const StateLayout::Entry& entry : layout.entries()) {
    const double value = entry.kind == Kind::fraction      ? fraction_tolerance(rtol)
                         : entry.kind == Kind::passed      ? not_tested
                         : entry.kind == Kind::pressure    ? pressure_scale * rtol
                         : entry.kind == Kind::temperature ? rtol * velocity_scale * velocity_scale
                                                           : rtol * velocity_scale;
    std::fill_n(atol.begin() + std::ptrdiff_t(entry.begin), entry.size, value);
  }
  if (equations.boundaries().closed() || equations.inlet().shuts())
    tolerances.at = RestingTolerances(equations.constants().grid, equations.boundaries(), layout, atol, velocity_scale,
                                      equations.constants().gravity);
  return tolerances;
}

RestingTolerances::RestingTolerances(const core::Grid& grid, const fluid::Boundaries& boundaries,
                                     const StateLayout& layout, std::vector<double> moving, double scale,
                                     double gravity)
    : grid_(grid),
      boundaries_(&boundaries),
      layout_(layout),
      moving_(std::move(moving)),
      scale_(scale),
      falling_time_(gravity > 0 ? scale / gravity : 0),
      solids_fraction_(core::make_field(grid)),
      entry_(core::make_field(grid)) {}

void RestingTolerances::find_solids(std::span<const double> y) {
  std::fill(solids_fraction_.begin(), solids_fraction_.end(), 0.0);
  for (const StateLayout::Entry& entry : layout_.entries()) {
    if (entry.kind != Kind::fraction) continue;
    layout_.unpack(entry, y, entry_);
    core::for_each_row(grid_, [&](Index begin, Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c) solids_fraction_[c] += entry_[c];
    });
  }
  boundaries_->fill_cells(solids_fraction_);
}

template <class Body>
void RestingTolerances::for_each_velocity(std::span<const double> values, bool surface, Body&& body) const {
  constexpr double some_solids = 0.01;
  for (const StateLayout::Entry& entry : layout_.entries()) {
    if (entry.kind != Kind::velocity && entry.kind != Kind::flux) continue;
    const double least = entry.kind == Kind::flux ? -1 : some_solids;
    const Index s = grid_.stride(entry.axis);
    std::size_t n = entry.begin;
    core::for_each_row(grid_, entry.box, [&](Index begin, Index end) {
      for (Index f = begin; f < end; ++f, ++n) {
        const auto [less, more] = std::minmax(solids_fraction_[std::size_t(f - s)], solids_fraction_[std::size_t(f)]);
        if ((surface ? more : less) > least) body(n, values[n]);
      }
    });
  }
}

void RestingTolerances::operator()(std::span<const double> y, std::span<const double> dydt, std::span<double> atol) {
  find_solids(y);
  double speed = 0, acceleration = 0;
  for_each_velocity(y, false, [&](std::size_t, double u) { speed = std::max(speed, std::abs(u)); });
  if (!dydt.empty())
    for_each_velocity(dydt, false, [&](std::size_t, double a) { acceleration = std::max(acceleration, std::abs(a)); });
  constexpr double least_share = 1e-7;
  const double fastest = core::greatest_of_ranks(grid_, std::max(speed, acceleration * falling_time_));
  const double share = std::clamp(fastest / scale_, least_share, 1.0);
  std::copy(moving_.begin(), moving_.end(), atol.begin());
  for_each_velocity(y, true, [&](std::size_t n, double) { atol[n] *= share; });
}

}  // namespace polybed::tfm
