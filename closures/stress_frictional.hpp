// Frictional pressure of packed solids, after Johnson and Jackson (J. Fluid Mech. 176, 1987, 67-93).
#pragma once

#include <algorithm>

namespace polybed::closures {

/// Solids pressure and its slope with the solids fraction.
struct StressValue {
  double pressure;  ///< p_s, Pa
  double slope;     ///< dp_s/dphi, Pa
};

/// p_f = Fr (phi - phi_min)^2 / (phi_max - phi)^5 above phi_min, 0 below; beyond phi_max - 0.005 its tangent, so that
/// it is C1 everywhere, has no pole, and is defined for any phi.
struct FrictionalLaw {
  double strength = 0.05;     ///< Fr, Pa
  double onset = 0.5;         ///< phi_min
  double max_packing = 0.64;  ///< phi_max > onset + margin

  static constexpr double margin = 0.005;  ///< distance from phi_max at which the tangent begins

  /// p_f and dp_f/dphi at any finite solids fraction.
  [[nodiscard]] StressValue operator()(double solids_fraction) const { return at(solids_fraction, max_packing); }

  /// The same with another maximum packing, for example from a cell's composition.
  [[nodiscard]] StressValue at(double solids_fraction, double packing) const {
    const double joint = packing - margin;
    const double phi = std::clamp(solids_fraction, onset, joint);
    const double above = phi - onset, gap = packing - phi;
    const double gap2 = gap * gap, gap5 = gap2 * gap2 * gap;
    const double pressure = strength * above * above / gap5;
    const double slope = strength * above * (2 * gap + 5 * above) / (gap5 * gap);
    return {pressure + slope * std::max(solids_fraction - joint, 0.0), slope};
  }

  /// The solids fraction, above phi_min, with a given pressure, Pa, >= 0. To round-off, by bisection and Newton.
  [[nodiscard]] double solids_fraction_at(double pressure) const {
    if (pressure <= 0) return onset;
    const double joint = max_packing - margin;
    const StressValue tangent = (*this)(joint);
    if (pressure >= tangent.pressure) return joint + (pressure - tangent.pressure) / tangent.slope;
    double low = onset, high = joint;
    for (int n = 0; n < 60; ++n) {
      const double middle = 0.5 * (low + high);
      ((*this)(middle).pressure < pressure ? low : high) = middle;
    }
    double phi = 0.5 * (low + high);
    for (int n = 0; n < 3; ++n) {
      const StressValue here = (*this)(phi);
      if (here.slope > 0) phi -= (here.pressure - pressure) / here.slope;
    }
    return phi;
  }
};

/// The maximum packing at which solids of a given fraction have a given pressure: solves p_f(phi; phi_max) = p for
/// phi_max in closed form, phi_max = phi + [Fr (phi - phi_min)^2 / p]^(1/5).
/// \param solids_fraction  phi > onset
/// \param pressure  p, Pa, > 0
[[nodiscard]] double max_packing_for(double solids_fraction, double pressure, double strength, double onset);

}  // namespace polybed::closures
