#include "tfm/tolerances.hpp"

#include <algorithm>

#include "tfm/resting_tolerances.hpp"

namespace polybed::tfm {

using Kind = StateLayout::Entry::Kind;

Tolerances tolerances_of(const RightHandSide& equations, const StateLayout& layout, double rtol, double velocity_scale,
                         double pressure_scale) {
  Tolerances tolerances;
  std::vector<double>& atol = tolerances.absolute;
  atol.resize(layout.size());
  constexpr double not_tested = 1e9;  // m: sums of fluxes follow from the rest and need no error test of their own
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

}  // namespace polybed::tfm
