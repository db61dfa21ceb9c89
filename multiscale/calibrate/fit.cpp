#include "multiscale/calibrate/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "closures/kinetic_theory.hpp"
#include "closures/stress_reference.hpp"
#include "core/error.hpp"

namespace polybed::multiscale {

namespace {

void add_mean(fluid::TableQuantity& q, const std::vector<Estimate>& seeds, double per) {
  const Estimate mean = mean_of_seeds(seeds);
  q.value.push_back(mean.mean * per);
  q.error.push_back(mean.error * per);
  q.seeds.push_back(double(seeds.size()));
}

/// Visits every line of a table along phi.
void each_line(const fluid::SolidsTable& t,
               const std::function<void(std::size_t, std::size_t, std::size_t, std::size_t)>& see) {
  for (std::size_t s = 0; s < t.stokes.size(); ++s)
    for (std::size_t e = 0; e < t.restitution.size(); ++e)
      for (std::size_t m = 0; m < t.friction.size(); ++m)
        for (std::size_t x = 0; x < t.share.size(); ++x) see(s, e, m, x);
}

std::vector<double> line_of(const fluid::SolidsTable& t, const fluid::TableQuantity& q, std::size_t s, std::size_t e,
                            std::size_t m, std::size_t x) {
  std::vector<double> values;
  for (std::size_t p = 0; p < t.phi.size(); ++p) values.push_back(q.value[t.index(p, s, e, m, x)]);
  return values;
}

double left_out_of(const fluid::SolidsTable& t) {
  double worst = 0;
  each_line(t, [&](std::size_t s, std::size_t e, std::size_t m, std::size_t x) {
    const std::vector<double> ratio = line_of(t, t.pressure, s, e, m, x);
    for (std::size_t p = 1; t.phi.size() >= least_to_leave_one_out && p + 1 < t.phi.size(); ++p) {
      std::vector<double> phi = t.phi, rest = ratio;
      phi.erase(phi.begin() + std::ptrdiff_t(p));
      rest.erase(rest.begin() + std::ptrdiff_t(p));
      worst = std::max(worst, std::abs(closures::MonotoneCurve(phi, rest)(t.phi[p]).pressure / ratio[p] - 1));
    }
  });
  return worst;
}

double residual_of(const fluid::SolidsTable& t, const Plan& plan, const std::vector<BoxResult>& boxes) {
  double worst = 0;
  const std::size_t seeds = plan.seeds();
  for (std::size_t n = 0; n < plan.axes.points() * seeds; ++n) {
    const double inertia = 1 + t.inertia * boxes[n].point.stokes;
    const auto over = [&](const Estimate& box, double fit) {
      worst = std::max(worst, (std::abs(box.mean / inertia - fit) - 2 * box.error / inertia) / fit);
    };
    over(boxes[n].pressure_ratio, t.pressure.value[n / seeds]);
    over(boxes[n].viscosity_ratio, t.viscosity.value[n / seeds]);
  }
  return worst;
}

/// Shape of the pressure along phi: at fixed temperature, or at fixed shear rate.
double pressure_shape(const fluid::SolidsTable& t, const closures::MonotoneCurve& ratio, double e, double mu,
                      double phi) {
  if (t.regime == "wet")
    return closures::viscous_stress_form(phi, closures::jamming_fraction(mu)).value * ratio(phi).pressure;
  return closures::kinetic_pressure(phi, closures::radial_carnahan_starling(phi).value,
                                    t.reference_restitution(e, mu)) *
         ratio(phi).pressure;
}

/// Ten points for each distance of knots, from 0 to 0.02 below jamming.
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

double fitted_inertia(const fluid::SolidsTable& t, const std::vector<double>& pressure) {
  if (t.regime != "wet" || t.stokes.size() < 2) return 0;
  std::vector<double> lambda;
  for (std::size_t p = 0; p < t.phi.size(); ++p) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t s = 0; s < t.stokes.size(); ++s) {
      const double st = t.stokes[s], value = pressure[t.index(p, s, 0, 0, 0)];
      const double weight = 1 / (value * value);  // relative deviations count
      n += weight;
      x += weight * st;
      y += weight * value;
      xx += weight * st * st;
      xy += weight * st * value;
    }
    const double slope = (n * xy - x * y) / (n * xx - x * x), intercept = (y - slope * x) / n;
    lambda.push_back(intercept > 0 ? slope / intercept : 0);
  }
  std::sort(lambda.begin(), lambda.end());
  return std::max(lambda[lambda.size() / 2], 0.0);
}

fluid::SolidsTable fitted(const Plan& plan, const std::vector<BoxResult>& boxes) {
  fluid::SolidsTable t;
  t.regime = plan.regime.name;
  t.reference = t.regime == "wet" ? "viscous" : fluid::effective_reference;
  t.phi = plan.axes.phi;
  t.stokes = plan.axes.stokes;
  t.restitution = plan.axes.restitution;
  t.friction = plan.axes.friction;
  t.share = plan.axes.share;
  const std::size_t seeds = plan.seeds();
  const auto at = [&](std::size_t point, Estimate BoxResult::*what) {
    std::vector<Estimate> all;
    for (std::size_t n = 0; n < seeds; ++n) all.push_back(boxes[point * seeds + n].*what);
    return all;
  };
  std::vector<double> plain;
  for (std::size_t n = 0; n < t.size(); ++n) {
    double sum = 0, shear = 0;
    for (const Estimate& e : at(n, &BoxResult::pressure_ratio)) sum += e.mean / double(seeds);
    for (std::size_t k = 0; k < seeds; ++k) shear += boxes[n * seeds + k].shear_number() / double(seeds);
    plain.push_back(sum);
    t.shear_number.push_back(shear);
  }
  t.inertia = fitted_inertia(t, plain);
  for (std::size_t n = 0; n < t.size(); ++n) {
    const double per = 1 / (1 + t.inertia * boxes[n * seeds].point.stokes);
    add_mean(t.pressure, at(n, &BoxResult::pressure_ratio), per);
    add_mean(t.viscosity, at(n, &BoxResult::viscosity_ratio), per);
    add_mean(t.dissipation, at(n, &BoxResult::dissipation_ratio), per);
    add_mean(t.temperature, at(n, &BoxResult::temperature_ratio), 1);
  }
  if (plan.pushed())
    for (std::size_t n = 0; n < t.size(); ++n) add_mean(t.exchange, at(t.size() + n, &BoxResult::exchange_ratio), 1);
  t.residual = residual_of(t, plan, boxes);
  t.left_out = left_out_of(t);
  return t;
}

std::vector<std::string> falls_of(const fluid::SolidsTable& t) {
  std::vector<std::string> falls;
  each_line(t, [&](std::size_t s, std::size_t e, std::size_t m, std::size_t x) {
    const closures::MonotoneCurve ratio(t.phi, line_of(t, t.pressure, s, e, m, x));
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

double falls_in_shear_up_to(const fluid::SolidsTable& t) {
  if (t.regime != "dry") return 0;
  double up_to = 0;
  constexpr auto gd = closures::KineticModel::garzo_dufty;
  each_line(t, [&](std::size_t s, std::size_t e, std::size_t m, std::size_t x) {
    const closures::MonotoneCurve p(t.phi, line_of(t, t.pressure, s, e, m, x)),
        mu(t.phi, line_of(t, t.viscosity, s, e, m, x)), loss(t.phi, line_of(t, t.dissipation, s, e, m, x));
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

void require_usable(const fluid::SolidsTable& t) {
  if (const std::vector<std::string> falls = falls_of(t); !falls.empty())
    throw core::NumericsError("the pressure of the table falls with the solids fraction, which no bed can follow: " +
                              fmt::format("{}", fmt::join(falls, "; ")));
  if (!(t.residual <= greatest_residual))
    throw core::NumericsError(fmt::format(
        "the fit leaves {:.1f} % beyond two standard errors, at most {:.0f} % are allowed: the seeds disagree; raise "
        "calibrate.strain, calibrate.particles or calibrate.seeds",
        100 * t.residual, 100 * greatest_residual));
}

std::vector<double> structure_coefficients(const fluid::SolidsTable& t) {
  std::vector<double> a;
  if (t.regime != "dry") return a;
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
