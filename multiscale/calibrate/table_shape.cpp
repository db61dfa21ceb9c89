#include "multiscale/calibrate/table_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "closures/kinetic_theory.hpp"
#include "closures/stress_reference.hpp"

namespace polybed::multiscale {

namespace {

/// Calls see(stokes, restitution, friction, share), all indices, for every line of a table along phi.
void each_line(const tfm::SolidsTable& t,
               const std::function<void(std::size_t, std::size_t, std::size_t, std::size_t)>& see) {
  for (std::size_t s = 0; s < t.stokes.size(); ++s)
    for (std::size_t e = 0; e < t.restitution.size(); ++e)
      for (std::size_t m = 0; m < t.friction.size(); ++m)
        for (std::size_t x = 0; x < t.share.size(); ++x) see(s, e, m, x);
}

std::vector<double> line_of(const tfm::SolidsTable& t, const std::vector<double>& all, std::size_t s, std::size_t e,
                            std::size_t m, std::size_t x) {
  std::vector<double> values;
  for (std::size_t p = 0; p < t.phi.size(); ++p) values.push_back(all[t.index(p, s, e, m, x)]);
  return values;
}

/// Shape of the pressure along phi: at fixed temperature, or at fixed shear rate.
double pressure_shape(const tfm::SolidsTable& t, const closures::MonotoneCurve& ratio, double e, double mu,
                      double phi) {
  if (t.regime == core::BoxRegime::wet)
    return closures::viscous_stress_form(phi, closures::jamming_fraction(mu)).value * ratio(phi).pressure;
  return closures::kinetic_pressure(phi, closures::radial_carnahan_starling(phi).value,
                                    t.reference_restitution(e, mu)) *
         ratio(phi).pressure;
}

/// Ten points per interval of knots, from 0 to 0.02 below jamming.
std::vector<double> fine_grid(const std::vector<double>& knots, double jammed) {
  std::vector<double> all{0};
  all.insert(all.end(), knots.begin(), knots.end());
  if (knots.back() < jammed - 0.02) all.push_back(jammed - 0.02);
  std::vector<double> fine{0};
  for (std::size_t n = 1; n < all.size(); ++n)
    for (int k = 1; k <= 10; ++k) fine.push_back(all[n - 1] + 0.1 * k * (all[n] - all[n - 1]));
  return fine;
}

}  // namespace

std::vector<std::string> falls_of(const tfm::SolidsTable& t) {
  std::vector<std::string> falls;
  each_line(t, [&](std::size_t s, std::size_t e, std::size_t m, std::size_t x) {
    const closures::MonotoneCurve ratio(t.phi, line_of(t, t.pressure.value, s, e, m, x));
    double last = -1;
    for (const double phi : fine_grid(t.phi, closures::jamming_fraction(t.friction[m]))) {
      const double here = pressure_shape(t, ratio, t.restitution[e], t.friction[m], phi);
      if (!(here > last)) {
        falls.push_back(fmt::format("at phi = {:.4g}, stokes = {:g}, e = {:g}, mu_p = {:g}, x2 = {:g}", phi,
                                    t.stokes[s], t.restitution[e], t.friction[m], t.share[x]));
        return;
      }
      last = here;
    }
  });
  return falls;
}

double falls_in_shear_up_to(const tfm::SolidsTable& t) {
  if (t.regime != core::BoxRegime::dry) return 0;
  double up_to = 0;
  constexpr auto gd = closures::KineticModel::garzo_dufty;
  each_line(t, [&](std::size_t s, std::size_t e, std::size_t m, std::size_t x) {
    const closures::MonotoneCurve p(t.phi, line_of(t, t.pressure.value, s, e, m, x)),
        mu(t.phi, line_of(t, t.viscosity.value, s, e, m, x)), loss(t.phi, line_of(t, t.dissipation.value, s, e, m, x));
    double last = -1;
    for (double phi = t.phi.front(); phi <= t.phi.back(); phi += 0.005) {
      const double rest = t.reference_restitution(t.restitution[e], t.friction[m]),
                   g0 = closures::radial_carnahan_starling(phi).value;
      const double theta = closures::kinetic_viscosity(gd, phi, g0, rest) * mu(phi).pressure /
                           (closures::kinetic_dissipation(gd, phi, g0, rest) * loss(phi).pressure);
      const double here = closures::kinetic_pressure(phi, g0, rest) * p(phi).pressure * theta;
      if (!(here > last)) up_to = std::max(up_to, phi);
      last = here;
    }
  });
  return up_to;
}

std::vector<double> structure_coefficients(const tfm::SolidsTable& t) {
  std::vector<double> a;
  if (t.regime != core::BoxRegime::dry) return a;
  for (std::size_t p = 0; p < t.phi.size(); ++p)
    for (std::size_t e = 0; e < t.restitution.size(); ++e)
      for (std::size_t m = 0; m < t.friction.size(); ++m)
        for (std::size_t x = 0; x < t.share.size(); ++x) {
          const std::size_t n = t.index(p, 0, e, m, x);
          const double chi = closures::radial_carnahan_starling(t.phi[p]).value;
          const double rest = t.reference_restitution(t.restitution[e], t.friction[m]);
          const double pressure = closures::kinetic_pressure(t.phi[p], chi, rest) * t.pressure.value[n];
          const double effective = (pressure / t.phi[p] - 1) / (2 * (1 + rest) * t.phi[p]);
          a.push_back((effective / chi - 1) / t.shear_number[n]);
        }
  return a;
}

}  // namespace polybed::multiscale
