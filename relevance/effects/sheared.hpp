// Weighs a force on particles that the fluid's shear makes, and which is certain up to a Reynolds number of the slip.
#pragma once

#include <algorithm>
#include <cmath>

#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance {

/// The greatest that a run may reach of a sheared particle: every slip up to the greatest, where the law is certain,
/// under the shear of a cell. It is a scale, too wide to choose by.
template <class Relevance>
double greatest_of_run(const Situation& s, const Survey& survey, Relevance&& of_slip) {
  if (!(survey.cell > 0)) return 0;
  Situation met = s;
  met.slip = std::max(s.slip, survey.greatest_packed_slip);
  met.shear = std::max(s.shear, closures::shear_rate_of_cell(met.slip, survey.clump_acceleration, survey.cell));
  const double certain = std::min(1.0, greatest_certain_reynolds / met.particle_reynolds());
  double value = 0;
  for (int n = 1; n <= 33; ++n) value = std::max(value, of_slip(met, met.slip * certain * n / 33));
  return value;
}

/// A force as a share of the reference.
/// \param of_slip  by the scales of the choice  \param in_run  by those of a run
template <class Relevance, class InRun>
EffectRow weigh_sheared(EffectRow row, const Survey& survey, Relevance&& of_slip, InRun&& in_run) {
  Supremum greatest;
  for (const Situation& s : survey.situations) {
    // The share of the lift falls with the slip: its greatest lies within the range, from a fifth of it.
    double value = 0;
    for (int n = 0; n < 33; ++n) {
      const double share = 0.2 + 0.8 * n / 32, found = of_slip(s, s.slip * share);
      value = std::max(value, found);
      // Where the fastest are beyond the law's range, slower ones of the same zone are within it, under its shear.
      if (share * s.particle_reynolds() <= greatest_certain_reynolds)
        row.up_to = std::max(row.up_to.value_or(0), found);
    }
    row.up_to = std::max(row.up_to.value_or(0), greatest_of_run(s, survey, in_run));
    if (s.particle_reynolds() > greatest_certain_reynolds)
      greatest.add_uncertain(s, {0, value});
    else
      greatest.add(s, value);
  }
  greatest.fill(row);
  return row;
}

/// Share of a weight, N, that a force has.
[[nodiscard]] inline double share_of(const closures::Vec3& force, double weight) {
  return std::sqrt(closures::dot(force, force)) / weight;
}

}  // namespace polybed::relevance
