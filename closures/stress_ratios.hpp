// Measured stress of sheared particles over a closed form, as functions of the solids fraction and, for wet particles,
// of the shear's Stokes number.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "closures/stress_reference.hpp"
#include "closures/stress_table.hpp"

namespace polybed::closures {

/// Ratios at one Stokes number, or for all of them.
struct RatioCurves {
  double stokes = 0;  ///< 0 for dry particles
  MonotoneCurve pressure, viscosity, dissipation;
};

/// Value and slope in phi of each ratio.
struct RatioValues {
  StressValue pressure, viscosity, dissipation;
};

/// Ratios at any phi and Stokes number: each curve is cubic in phi, linear in ln(stokes) between two; outside the range
/// they are constant in either. C1 in phi.
class StressRatios {
 public:
  StressRatios() = default;
  /// \param curves  at least one; stokes increases, and is above 0 if there are several
  explicit StressRatios(std::vector<RatioCurves> curves) : curves_(std::move(curves)) {}

  [[nodiscard]] RatioValues operator()(double phi, double stokes) const {
    if (curves_.size() == 1 || stokes <= curves_.front().stokes) return at(curves_.front(), phi);
    if (stokes >= curves_.back().stokes) return at(curves_.back(), phi);
    std::size_t n = 1;
    while (curves_[n].stokes <= stokes) ++n;
    const double low = std::log(curves_[n - 1].stokes), high = std::log(curves_[n].stokes);
    const double share = (std::log(stokes) - low) / (high - low);
    const RatioValues a = at(curves_[n - 1], phi), b = at(curves_[n], phi);
    return {between(a.pressure, b.pressure, share), between(a.viscosity, b.viscosity, share),
            between(a.dissipation, b.dissipation, share)};
  }
  [[nodiscard]] double first() const { return curves_.front().pressure.first(); }
  [[nodiscard]] double last() const { return curves_.front().pressure.last(); }
  [[nodiscard]] const std::vector<RatioCurves>& curves() const { return curves_; }
  /// Whether a point is outside the measured range.
  [[nodiscard]] bool outside(double phi, double stokes) const {
    return phi < first() || phi > last() || (curves_.size() > 1 && stokes < curves_.front().stokes) ||
           (curves_.size() > 1 && stokes > curves_.back().stokes);
  }

 private:
  static RatioValues at(const RatioCurves& c, double phi) {
    return {c.pressure(phi), c.viscosity(phi), c.dissipation(phi)};
  }
  static StressValue between(const StressValue& a, const StressValue& b, double share) {
    return {a.pressure + share * (b.pressure - a.pressure), a.slope + share * (b.slope - a.slope)};
  }
  std::vector<RatioCurves> curves_;
};

/// Stress in sheared wet particles: p and dp/dphi, Pa, and mu_s, Pa s.
struct WetStress {
  double pressure, slope, viscosity;
};

/// p = mu_f gamma (1 + lambda St) V(phi) R_p(phi, St), mu_s = mu_f (1 + lambda St) V(phi) R_mu(phi, St), V the form of
/// Boyer et al., after Trulsson, Andreotti and Claudin (Phys. Rev. Lett. 109, 2012, 118305). phi >= 0, gamma >= 0.
[[nodiscard]] inline WetStress wet_stress(const StressRatios& ratios, double jammed, double lambda, double phi,
                                          double stokes, double viscosity, double shear_rate) {
  const RadialValue form = viscous_stress_form(phi, jammed);
  const RatioValues r = ratios(phi, stokes);
  const double unit = viscosity * (1 + lambda * stokes);
  return {unit * shear_rate * form.value * r.pressure.pressure,
          unit * shear_rate * (form.slope * r.pressure.pressure + form.value * r.pressure.slope),
          unit * form.value * r.viscosity.pressure};
}

}  // namespace polybed::closures
