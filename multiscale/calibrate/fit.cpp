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

std::vector<double> line_of(const fluid::SolidsTable& t, const std::vector<double>& all, std::size_t s, std::size_t e,
                            std::size_t m, std::size_t x) {
  std::vector<double> values;
  for (std::size_t p = 0; p < t.phi.size(); ++p) values.push_back(all[t.index(p, s, e, m, x)]);
  return values;
}

/// Removes a knot.
std::vector<double> without(std::vector<double> values, std::size_t p) {
  values.erase(values.begin() + std::ptrdiff_t(p));
  return values;
}

/// What a curve through all knots but one misses there, over the value: in all, and beyond two standard errors.
struct Missed {
  double in_all, beyond;
};
Missed missed_at(const std::vector<double>& phi, const std::vector<double>& value, const std::vector<double>& error,
                 std::size_t p) {
  const std::vector<double> knots = without(phi, p), others = without(value, p), errors = without(error, p);
  const double read = closures::MonotoneCurve(knots, others)(phi[p]).pressure;
  double variance = error[p] * error[p];
  for (std::size_t k = 0; k < others.size(); ++k) {
    std::vector<double> moved = others;
    moved[k] += errors[k];
    variance += std::pow(closures::MonotoneCurve(knots, moved)(phi[p]).pressure - read, 2);
  }
  const double off = std::abs(read - value[p]);
  return {off / value[p], (off - 2 * std::sqrt(variance)) / value[p]};
}

void leave_each_out(fluid::SolidsTable& t) {
  if (t.phi.size() < least_to_leave_one_out) return;
  each_line(t, [&](std::size_t s, std::size_t e, std::size_t m, std::size_t x) {
    for (const fluid::TableQuantity* q : {&t.pressure, &t.viscosity})
      for (std::size_t p = 1; p + 1 < t.phi.size(); ++p) {
        const Missed missed = missed_at(t.phi, line_of(t, q->value, s, e, m, x), line_of(t, q->error, s, e, m, x), p);
        t.left_out = std::max(t.left_out, missed.in_all);
        t.residual = std::max(t.residual, missed.beyond);
      }
  });
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

/// Least over the points of the greatest drift that their pushed boxes had. \param first  of the boxes of each point; as many
/// pushed ones lie behind all of them
double common_drift(const std::vector<BoxResult>& boxes, const std::vector<std::size_t>& first) {
  double least = 1e300;
  for (std::size_t n = 0; n + 1 < first.size(); ++n) {
    double greatest = 0;
    for (std::size_t k = first[n]; k < first[n + 1]; ++k)
      greatest = std::max(greatest, std::abs(boxes[first.back() + k].slip));
    least = std::min(least, greatest);
  }
  return least;
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
  std::vector<std::size_t> first{0};  // of the boxes of each point
  for (const int seeds : plan.seeds) first.push_back(first.back() + std::size_t(seeds));
  const auto at = [&](std::size_t point, Estimate BoxResult::*what, std::size_t from = 0) {
    std::vector<Estimate> all;
    for (std::size_t n = first[point]; n < first[point + 1]; ++n) all.push_back(boxes[from + n].*what);
    return all;
  };
  std::vector<double> plain;
  for (std::size_t n = 0; n < t.size(); ++n) {
    const double seeds = double(plan.seeds[n]);
    double sum = 0, shear = 0;
    for (const Estimate& e : at(n, &BoxResult::pressure_ratio)) sum += e.mean / seeds;
    for (std::size_t k = first[n]; k < first[n + 1]; ++k) shear += boxes[k].shear_number() / seeds;
    plain.push_back(sum);
    t.shear_number.push_back(shear);
  }
  t.inertia = fitted_inertia(t, plain);
  for (std::size_t n = 0; n < t.size(); ++n) {
    const double per = 1 / (1 + t.inertia * boxes[first[n]].point.stokes);
    add_mean(t.pressure, at(n, &BoxResult::pressure_ratio), per);
    add_mean(t.viscosity, at(n, &BoxResult::viscosity_ratio), per);
    add_mean(t.dissipation, at(n, &BoxResult::dissipation_ratio), per);
    add_mean(t.temperature, at(n, &BoxResult::temperature_ratio), 1);
    if (plan.pushed()) add_mean(t.exchange, at(n, &BoxResult::exchange_ratio, first.back()), 1);
  }
  if (plan.pushed()) t.exchange_drift = common_drift(boxes, first);
  leave_each_out(t);
  return t;
}

std::vector<double> relative_errors(const fluid::SolidsTable& t) {
  std::vector<double> errors;
  for (std::size_t n = 0; n < t.size(); ++n)
    errors.push_back(
        std::max(t.pressure.error[n] / t.pressure.value[n], t.viscosity.error[n] / std::abs(t.viscosity.value[n])));
  return errors;
}

double greatest_error(const fluid::SolidsTable& t) {
  const std::vector<double> errors = relative_errors(t);
  return *std::max_element(errors.begin(), errors.end());
}

bool add_seeds(Plan& plan, const fluid::SolidsTable& table) {
  if (plan.least_seeds() < seeds_of_a_trusted_table) return false;
  const std::vector<double> errors = relative_errors(table);
  bool added = false;
  for (std::size_t n = 0; n < errors.size(); ++n)
    if (errors[n] > greatest_residual && plan.seeds[n] < most_seeds) {
      ++plan.seeds[n];
      added = true;
    }
  if (added) set_boxes(plan);
  return added;
}

std::vector<std::string> falls_of(const fluid::SolidsTable& t) {
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

double falls_in_shear_up_to(const fluid::SolidsTable& t) {
  if (t.regime != "dry") return 0;
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

void require_usable(const fluid::SolidsTable& t) {
  if (const std::vector<std::string> falls = falls_of(t); !falls.empty())
    throw core::NumericsError("the pressure of the table falls with the solids fraction, which no bed can follow: " +
                              fmt::format("{}", fmt::join(falls, "; ")));
  if (!(t.residual <= greatest_residual))
    throw core::NumericsError(fmt::format(
        "the curve through the other solids fractions misses one by {:.1f} % more than two standard errors of both, "
        "{:.0f} % are allowed: the grid is too coarse for what it shows; add to calibrate.solids_fraction",
        100 * t.residual, 100 * greatest_residual));
  for (std::size_t p = 0, n = 0; p < t.phi.size() && !t.exchange.value.empty(); ++p)
    for (std::size_t s = 0; s < t.size() / t.phi.size(); ++s, ++n)
      if (!(t.exchange.value[n] > 0))
        throw core::NumericsError(
            fmt::format("at phi = {:g} beta_12 is {:.3g} of its form, +- {:.2g}: boxes too short to tell the drift of "
                        "species that are pushed apart; raise calibrate.particles or calibrate.strain",
                        t.phi[p], t.exchange.value[n], t.exchange.error[n]));
  const std::vector<double> errors = relative_errors(t);
  for (std::size_t p = 0, n = 0; p < t.phi.size(); ++p)
    for (std::size_t s = 0; s < t.size() / t.phi.size(); ++s, ++n)
      if (t.pressure.seeds[n] > 1 && !(errors[n] <= greatest_residual))
        throw core::NumericsError(fmt::format(
            "at phi = {:g} the seeds scatter: p or mu has a standard error of {:.1f} %, {:.0f} % are allowed; raise "
            "calibrate.seeds or calibrate.particles",
            t.phi[p], 100 * errors[n], 100 * greatest_residual));
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
