// Weighs a force on particles from the fluid's shear, whose law is certain up to a Reynolds number of the slip.
#pragma once

#include <algorithm>
#include <cmath>

#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/supremum.hpp"

namespace polybed::relevance {

/// The greatest force that a sheared particle can meet in a run: any slip up to the greatest at which the law is
/// certain, in the shear of a cell. It is an upper scale, too wide for the choice.
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
/// \param of_slip  on the scales of the choice  \param in_run  on the scales of a run
template <class Relevance, class InRun>
EffectRow weigh_sheared(EffectRow row, const Survey& survey, Relevance&& of_slip, InRun&& in_run) {
  Supremum greatest;
  for (const Situation& s : survey.situations) {
    // The lift's share falls with the slip: its greatest value lies inside the range, from a fifth of it.
    double value = 0;
    for (int n = 0; n < 33; ++n) {
      const double share = 0.2 + 0.8 * n / 32, found = of_slip(s, s.slip * share);
      value = std::max(value, found);
      // If the fastest particles exceed the law's range, slower ones in the same zone and shear are within it.
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

/// Ratio of a force to a weight, N.
[[nodiscard]] inline double share_of(const closures::Vec3& force, double weight) {
  return std::sqrt(closures::dot(force, force)) / weight;
}

}  // namespace polybed::relevance
