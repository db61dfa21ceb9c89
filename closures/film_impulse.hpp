// Impulse of the film between two spheres over a change of their gap.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polybed::closures {

/// Integral of unresolved_film_resistance() over the gap from `after` to `before`, N s: the impulse that pushes two
/// spheres apart on approach, negative on separation. With c = 6 pi mu R*^2 and h at least the roughness r,
///   c (phi(before) - phi(after)),  phi = ln(h/r) - (h - r)/resolved,  h <= resolved;  (1 - r/resolved) (h - r)/r,  h <
///   r.
/// The force 1/h varies faster than steps of a moving wall can follow. \param roughness m, > 0; nothing if >= resolved
[[nodiscard]] inline double unresolved_film_impulse(double viscosity, double reduced_radius, double before,
                                                    double after, double resolved, double roughness) {
  if (roughness >= resolved) return 0;
  const auto phi = [&](double gap) {
    const double h = std::min(gap, resolved), beyond = h - roughness;
    return beyond < 0 ? (1 - roughness / resolved) * beyond / roughness : std::log(h / roughness) - beyond / resolved;
  };
  return 6 * std::numbers::pi * viscosity * reduced_radius * reduced_radius * (phi(before) - phi(after));
}

}  // namespace polybed::closures
