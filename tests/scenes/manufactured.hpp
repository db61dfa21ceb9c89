// A smooth steady solution that fills a joined box, and the sources that make it one: T(1.27), T(1.28), T(1.16) applied
// to it exactly, by numbers that carry their first and second derivatives.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "closures/drag.hpp"
#include "closures/species_exchange_syamlal.hpp"
#include "closures/stress_frictional.hpp"
#include "tfm/fields.hpp"

namespace polybed::scenes {

/// A value with its gradient and its second derivatives.
struct Jet {
  double v = 0;
  std::array<double, 3> d{};
  std::array<std::array<double, 3>, 3> dd{};
};

/// f(a, b) from the derivatives of f: the chain rule to second order.
inline Jet chain(const Jet& a, const Jet& b, double f, double fa, double fb, double faa, double fab, double fbb) {
  Jet r{f, {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    r.d[i] = fa * a.d[i] + fb * b.d[i];
    for (std::size_t j = 0; j < 3; ++j)
      r.dd[i][j] = fa * a.dd[i][j] + fb * b.dd[i][j] + faa * a.d[i] * a.d[j] + fbb * b.d[i] * b.d[j] +
                   fab * (a.d[i] * b.d[j] + a.d[j] * b.d[i]);
  }
  return r;
}
inline Jet operator+(const Jet& a, const Jet& b) { return chain(a, b, a.v + b.v, 1, 1, 0, 0, 0); }
inline Jet operator-(const Jet& a, const Jet& b) { return chain(a, b, a.v - b.v, 1, -1, 0, 0, 0); }
inline Jet operator*(const Jet& a, const Jet& b) { return chain(a, b, a.v * b.v, b.v, a.v, 0, 1, 0); }
inline Jet operator/(const Jet& a, const Jet& b) {
  const double q = a.v / b.v, r = 1 / b.v;
  return chain(a, b, q, r, -q * r, 0, -r * r, 2 * q * r * r);
}
inline Jet constant(double value) { return {value, {}, {}}; }

/// sin(k.x + shift), k = 2 pi n/L.
inline Jet wave(const std::array<double, 3>& x, const std::array<int, 3>& n, double shift, double length) {
  std::array<double, 3> k{};
  double phase = shift;
  for (std::size_t i = 0; i < 3; ++i) phase += (k[i] = 2 * std::numbers::pi * n[i] / length) * x[i];
  Jet r{std::sin(phase), {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    r.d[i] = std::cos(phase) * k[i];
    for (std::size_t j = 0; j < 3; ++j) r.dd[i][j] = -std::sin(phase) * k[i] * k[j];
  }
  return r;
}

using Vector = std::array<Jet, 3>;

/// The solution at a point: two species, J free of divergence.
struct Exact {
  std::array<Jet, 2> phi;
  std::array<Vector, 2> u;
  Vector flux;
  Jet pressure;
};

/// What must be added to the rates so that the solution is steady.
struct Sources {
  std::array<double, 2> phi{};
  std::array<std::array<double, 3>, 2> u{};
  std::array<double, 3> flux{};
};

/// What the solution's physics needs besides the constants.
struct Laws {
  closures::DragLaw drag;
  closures::FrictionalLaw stress;
  closures::SpeciesPair pair;
};

/// Every field has its own phase, so that no two extrema meet; slips between the phases stay away from 0.
inline Exact exact(const std::array<double, 3>& x, int dimensions, double length) {
  const int z = dimensions == 3 ? 1 : 0;
  const auto w = [&](double base, double amplitude, const std::array<int, 3>& n, double shift) {
    Jet r = wave(x, {n[0], n[1], n[2] * z}, shift, length);
    return constant(base) + constant(amplitude) * r;
  };
  Exact e;
  e.phi = {w(0.18, 0.03, {1, 1, 0}, 1.0) + w(0, 0.02, {1, -1, 1}, 0.3), w(0.14, 0.03, {0, 1, 1}, 2.0)};
  e.u[0] = {w(0.03, 0.02, {1, 1, 1}, 0.4), w(0.02, 0.02, {1, 0, -1}, 1.1), w(0.02, 0.01, {1, 1, 1}, 2.1)};
  e.u[1] = {w(-0.02, 0.02, {0, 1, 1}, 0.2), w(-0.03, 0.02, {1, -1, 0}, 0.9), w(-0.01, 0.01, {1, 0, 1}, 0.5)};
  // A shear in each direction and the eddies sin(kx + 0.5) cos(ky): each free of divergence.
  e.flux = {w(0.08, 0.01, {1, 1, 0}, 0.5) + w(0, 0.01, {1, -1, 0}, 0.5) + w(0, 0.02, {0, 1, 1}, 0.7),
            w(0.12, -0.01, {1, 1, 0}, 0.5) + w(0, 0.01, {1, -1, 0}, 0.5) + w(0, 0.02, {1, 0, 1}, 1.7),
            w(0.06, 0.02, {1, 1, 0}, 2.7)};
  e.pressure = w(0, 200 * length, {1, 1, 1}, 0.8);
  return e;
}

inline double dot_gradient(const Vector& u, const Jet& q, int dimensions) {
  double sum = 0;
  for (std::size_t i = 0; i < std::size_t(dimensions); ++i) sum += u[i].v * q.d[i];
  return sum;
}

/// div(eps tau/mu) along a, tau/mu = grad u + grad u^T - 2/3 div u I.
inline double viscous(const Jet& eps, const Vector& u, std::size_t a, int dimensions) {
  double force = 0, div = 0, grad_div = 0;
  for (std::size_t b = 0; b < std::size_t(dimensions); ++b) {
    force += eps.d[b] * (u[a].d[b] + u[b].d[a]) + eps.v * (u[a].dd[b][b] + u[b].dd[a][b]);
    div += u[b].d[b];
    grad_div += u[b].dd[a][b];
  }
  return force - 2.0 / 3 * (eps.d[a] * div + eps.v * grad_div);
}

/// b_j, T(1.49), of the mixture at a point, closures seeing what the model lets them see.
inline std::array<double, 2> exchange(const Exact& e, double eps, const Vector& u_f, const tfm::Constants& constants,
                                      const closures::DragLaw& law) {
  const std::size_t dimensions = std::size_t(constants.grid.dimensions);
  std::array<double, 2> share{}, slip{}, f{}, derivative{};
  const double phi = 1 - eps;
  for (std::size_t j = 0; j < 2; ++j) {
    share[j] = (e.phi[j].v + 1e-4 * constants.bed_share[j]) / (phi + 1e-4);
    for (std::size_t a = 0; a < dimensions; ++a) slip[j] += std::pow(u_f[a].v - e.u[j][a].v, 2);
    slip[j] = eps * std::sqrt(slip[j]);
  }
  const double mu = constants.fluid.viscosity;
  closures::drag_of_mixture(law, eps, share, constants.diameter, slip, constants.fluid.density, mu, f, derivative);
  for (std::size_t j = 0; j < 2; ++j) f[j] *= 18 * mu * eps / std::pow(constants.diameter[j], 2);
  return f;
}

inline Sources sources(const Exact& e, const tfm::Constants& constants, const Laws& laws) {
  const int n = constants.grid.dimensions;
  const double rho_f = constants.fluid.density, mu = constants.fluid.viscosity;
  const Jet phi = e.phi[0] + e.phi[1], eps = constant(1) - phi;
  Vector u_f;
  for (std::size_t a = 0; a < 3; ++a) u_f[a] = (e.flux[a] - e.phi[0] * e.u[0][a] - e.phi[1] * e.u[1][a]) / eps;
  const std::array<double, 2> b = exchange(e, eps.v, u_f, constants, laws.drag);
  double surface = 0, speed = 0;
  for (std::size_t j = 0; j < 2; ++j) surface += e.phi[j].v / constants.diameter[j];
  for (std::size_t a = 0; a < std::size_t(n); ++a) speed += std::pow(e.u[0][a].v - e.u[1][a].v, 2);
  const double k = closures::species_exchange(laws.pair, closures::radial_distribution(laws.pair, eps.v, surface),
                                              std::sqrt(speed), 0.0);
  Sources s;
  for (std::size_t j = 0; j < 2; ++j)
    for (std::size_t a = 0; a < std::size_t(n); ++a)
      s.phi[j] += e.phi[j].v * e.u[j][a].d[a] + e.phi[j].d[a] * e.u[j][a].v;
  for (std::size_t a = 0; a < std::size_t(n); ++a) {
    double rate = -eps.v * dot_gradient(u_f, u_f[a], n) + mu / rho_f * viscous(eps, u_f, a, n);
    double mobility = eps.v / rho_f;
    for (std::size_t j = 0; j < 2; ++j) {
      const double rho = constants.density[j], slip = u_f[a].v - e.u[j][a].v;
      double acceleration = -dot_gradient(e.u[j], e.u[j][a], n) + b[j] / rho * slip;
      acceleration -= laws.stress(phi.v).slope * phi.d[a] / (phi.v * rho);
      acceleration += k * e.phi[1 - j].v / rho * (e.u[1 - j][a].v - e.u[j][a].v);
      if (a == 1) acceleration -= (1 - rho_f / rho) * constants.gravity;
      s.u[j][a] = -(acceleration - e.pressure.d[a] / rho);
      rate += e.phi[j].v * acceleration - e.phi[j].v * b[j] * slip / rho_f + slip * s.phi[j];
      mobility += e.phi[j].v / rho;
    }
    s.flux[a] = -(rate - mobility * e.pressure.d[a]);
  }
  return s;
}

}  // namespace polybed::scenes
