#include "multiscale/cost/selftest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "closures/sphere.hpp"
#include "core/numerics/random.hpp"
#include "core/output/particles.hpp"
#include "core/print.hpp"
#include "measures/bed.hpp"
#include "measures/particle_profile.hpp"
#include "measures/time_mean.hpp"
#include "multiscale/cost/fit.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/refinement.hpp"
#include "multiscale/cost/timing.hpp"

namespace polybed::multiscale {

namespace {

bool near(double a, double b, double by) { return std::abs(a - b) <= by; }

Oracle k1() {
  const Refined r = refine({0.961780, 0.968540, 0.970500, 2, 2});
  const bool good = r.order && r.fine_index && r.coarse_index && r.asymptotic && near(*r.order, 1.786170, 5e-7) &&
                    near(r.limit, 0.9713003, 5e-8) && near(100 * *r.fine_index, 0.103083, 5e-7) &&
                    near(100 * *r.coarse_index, 0.356249, 5e-7) && near(*r.asymptotic, 0.997980, 5e-7);
  return {"K1",
          fmt::format("p {:.6f}, limit {:.7f}, GCI {:.6f} % and {:.6f} %, ratio {:.6f}", r.order.value_or(0), r.limit,
                      100 * r.fine_index.value_or(0), 100 * r.coarse_index.value_or(0), r.asymptotic.value_or(0)),
          "p 1.786170, limit 0.9713003, GCI 0.103083 % and 0.356249 %, ratio 0.997980", good};
}

Oracle k2() {
  constexpr int series = 2000, rows = 2000;
  constexpr double rho = 0.9;
  int held = 0;
  std::vector<double> x(rows);
  for (int n = 0; n < series; ++n) {
    for (int k = 0; k < rows; ++k) {
      const double noise = core::normal(7, std::uint64_t(n), std::uint64_t(k));
      x[std::size_t(k)] = k == 0 ? noise : rho * x[std::size_t(k - 1)] + std::sqrt(1 - rho * rho) * noise;
    }
    const auto mean = measures::time_mean(x);
    held += mean && mean->error && std::abs(mean->mean) < *mean->error ? 1 : 0;
  }
  const double share = 100.0 * held / series;
  return {"K2", fmt::format("covers in {:.1f} %", share), "93 to 97 %", share >= 93 && share <= 97};
}

Oracle k3() {
  std::vector<double> h{0.4, 0.2, 0.1}, error, cost;
  for (const double x : h) {
    error.push_back(0.8 * x * x);
    cost.push_back(5 * std::pow(x, -3));
  }
  const auto e = fit_power_law(h, error), c = fit_power_law(h, cost);
  ErrorModel model;
  model.space = *e;
  model.spin_up = 1;
  model.rate = c->factor;
  model.space_exponent = -c->exponent;
  const double found = cheapest(model, 0.01).spacing, wanted = std::sqrt(0.01 / 0.8);
  return {"K3", fmt::format("h {:.5f}", found), fmt::format("{:.5f} within 5 %", wanted),
          near(found, wanted, 0.05 * wanted)};
}

Oracle k5() {
  const std::vector<double> errors{0.05, 0.02, 0.004};
  const bool loose = carries(0.01, errors, 0.01), tight = carries(1e-5, errors, 0.01);
  return {"K5",
          fmt::format("disagreement 1 %: {}, 0.001 %: {}", loose ? "taken" : "refused", tight ? "taken" : "refused"),
          "refused, taken", !loose && tight};
}

Oracle k6() {
  std::vector<double> noisy, calm;
  for (std::uint64_t n = 0; n < 5; ++n) {
    const double spread = 2.0 * double(n) / 4 - 1;
    noisy.push_back(1 + 0.3 * spread);
    calm.push_back(1 + 0.02 * spread);
  }
  const auto told = too_noisy(timing_of(noisy), 1, 2), not_told = too_noisy(timing_of(calm), 1, 2);
  return {"K6", told.value_or("nothing"), "machine busy, and nothing for 2 %", told && !not_told};
}

using State = std::array<double, 3>;

/// First component of a system in time, by the classical method of Runge and Kutta.
std::vector<double> course(const std::function<State(const State&)>& rate, double push) {
  constexpr double dt = 0.01;
  const auto moved = [](State y, const State& k, double by) {
    for (std::size_t i = 0; i < 3; ++i) y[i] += by * k[i];
    return y;
  };
  State y{1 + push, 1, 1};
  std::vector<double> found;
  for (int n = 0; n < 5000; ++n) {
    const State a = rate(y), b = rate(moved(y, a, dt / 2)), c = rate(moved(y, b, dt / 2)), d = rate(moved(y, c, dt));
    for (std::size_t i = 0; i < 3; ++i) y[i] += dt / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
    found.push_back(y[0]);
  }
  return found;
}

Oracle k7() {
  const auto lorenz = [](const State& y) {
    return State{10 * (y[1] - y[0]), y[0] * (28 - y[2]) - y[1], y[0] * y[1] - 8.0 / 3 * y[2]};
  };
  const auto damped = [](const State& y) { return State{y[1], -y[0] - 0.2 * y[1], 0}; };
  const bool first = is_chaotic(course(lorenz, 0), course(lorenz, 1e-10));
  const bool second = is_chaotic(course(damped, 0), course(damped, 1e-10));
  const auto word = [](bool chaotic) { return chaotic ? "chaotic" : "steady"; };
  return {"K7", fmt::format("Lorenz {}, damped {}", word(first), word(second)), "chaotic, steady", first && !second};
}

Oracle k12() {
  const Refined r = refine({1.0, 1.2, 1.1, 2, 2});
  return {"K12", r.fine_index ? "an index" : r.note, "no index", !r.fine_index && !r.coarse_index};
}

measures::Profile layered(double slab) {
  measures::Profile p{slab, {{}, {}}, {}};
  for (std::size_t k = 0; k < std::size_t(std::lround(0.2 / slab)); ++k) {
    const double z = p.centre(k);
    p.fraction[0].push_back(z < 0.06 ? 0.6 : 0);
    p.fraction[1].push_back(z > 0.06 && z < 0.16 ? 0.3 : 0);
  }
  return p;
}

Oracle k13() {
  constexpr double slab = 2e-3;
  const double found = measures::bed_height(layered(slab)).value_or(0);
  return {"K13", fmt::format("bed_height {:.4f} m", found), "0.16 m within half a slab, not 0.06 m",
          near(found, 0.16, slab / 2)};
}

/// Particles of both layers on a lattice, counted into slabs by their exact parts, against the layers as cells.
Oracle k14() {
  constexpr double slab = 2e-3, radius = 2e-4, side = 0.02;
  std::vector<std::int64_t> ids;
  std::vector<double> radii;
  std::vector<std::int32_t> species;
  std::vector<std::array<double, 3>> places, velocities;
  const auto fill = [&](double from, double to, double phi, std::int32_t kind) {
    const double volume = side * side * (to - from) * phi, each = closures::sphere_volume(radius);
    const auto count = std::size_t(std::lround(volume / each));
    for (std::size_t n = 0; n < count; ++n) {
      ids.push_back(std::int64_t(ids.size()));
      radii.push_back(radius);
      species.push_back(kind);
      places.push_back({0, from + (double(n) + 0.5) / double(count) * (to - from), 0});
      velocities.push_back({0, 0, 0});
    }
  };
  fill(0, 0.06, 0.6, 0);
  fill(0.06, 0.16, 0.3, 1);
  const core::ParticleSnapshot particles{ids, species, radii, places, velocities, velocities};
  const measures::Profile cells = layered(slab),
                          counted = measures::particle_profile(particles, 2, {side * side, 0.2, 100}).solids;
  const auto apart = [](std::optional<double> a, std::optional<double> b) { return a && b ? std::abs(*a - *b) : 1.0; };
  const double height = apart(measures::bed_height(cells), measures::bed_height(counted));
  const double centre = apart(measures::centre(cells, 1), measures::centre(counted, 1));
  const double interface = apart(measures::interface_height(cells), measures::interface_height(counted));
  const double mixing = apart(measures::mixing(cells), measures::mixing(counted));
  const double order = measures::composition_distance(cells, counted).value_or(1);
  const bool good = height < slab && centre < slab && interface < slab && mixing < 0.02 && order < 0.02;
  return {"K14",
          fmt::format("height {:.1e}, centre {:.1e}, interface {:.1e} m, mixing {:.1e}, composition {:.1e}", height,
                      centre, interface, mixing, order),
          "lengths within a slab, 2e-3 m, shares within a slice of 50", good};
}

}  // namespace

std::vector<Oracle> pure_oracles() {
  return {k1(), k2(), k3(), settling_oracle(), k5(), k6(), k7(), k12(), k13(), k14()};
}

bool print_selftest() {
  bool all = true;
  for (const Oracle& o : pure_oracles()) {
    core::print("{:4} {:6} {}\n            wanted: {}\n", o.id, o.passed ? "passes" : "FAILS", o.found, o.wanted);
    all = all && o.passed;
  }
  return all;
}

}  // namespace polybed::multiscale
