// K4: one particle settles; both integrators of the program must buy error with work at the rate of their order.
#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "core/numerics/integrator.hpp"
#include "multiscale/cost/fit.hpp"
#include "multiscale/cost/selftest.hpp"

namespace polybed::multiscale {

namespace {

constexpr double acceleration = 6, terminal = 0.15, relaxation = terminal / acceleration;  // a bead of 1 mm in water

/// dv/dt = g' (1 - (v/u_t)^2), drag in proportion to v^2; from rest v = u_t tanh(g' t/u_t).
double rate_of(double v) { return acceleration * (1 - v * v / (terminal * terminal)); }

class Settling : public core::OdeProblem {
 public:
  core::Rate rates(double, std::span<const double> v, std::span<double> rate) override {
    rate[0] = rate_of(v[0]);
    return core::Rate::ok;
  }
};

class ImplicitSettling : public core::DaeProblem {
 public:
  core::Rate residual(double, std::span<const double> v, std::span<const double> dvdt, std::span<double> r) override {
    r[0] = dvdt[0] - rate_of(v[0]);
    return core::Rate::ok;
  }
  core::Rate setup(double, std::span<const double> v, std::span<const double>, std::span<const double>,
                   double cj) override {
    slope_ = cj + 2 * acceleration * v[0] / (terminal * terminal);
    return core::Rate::ok;
  }
  core::Rate precondition(double, std::span<const double> r, std::span<double> z, double, double) override {
    z[0] = r[0] / slope_;
    return core::Rate::ok;
  }

 private:
  double slope_ = 1;
};

struct WorkPrecision {
  std::vector<double> work, error;
  void add(core::Integrator& integrator) {
    constexpr double until = relaxation;
    integrator.restart(0, std::vector<double>{0}, std::vector<double>{acceleration}, 0);
    const auto before = integrator.statistics().steps;
    for (double t = 0; t < until;) t = integrator.step(until).time;
    work.push_back(double(integrator.statistics().steps - before));
    error.push_back(std::abs(integrator.state()[0] / (terminal * std::tanh(until / relaxation)) - 1));
  }
  [[nodiscard]] double slope() const {
    const auto law = fit_power_law(work, error);
    return law ? -law->exponent : 0;
  }
};

}  // namespace

Oracle settling_oracle() {
  WorkPrecision steps, tolerances;
  for (const int n : {8, 16, 32, 64}) {
    Settling problem;
    const auto integrator = core::make_explicit(problem, {.atol = {1e-12}, .fixed_step = relaxation / n});
    steps.add(*integrator);
  }
  for (const double rtol : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    ImplicitSettling problem;
    const auto integrator =
        core::make_implicit(problem, {.rtol = rtol, .atol = {rtol * terminal}, .id = {1}, .linear_tolerance = 1e-3});
    tolerances.add(*integrator);
  }
  constexpr double explicit_order = 3, implicit_order = 2, within = 0.2;  // cost.md, K4
  const bool good =
      std::abs(steps.slope() - explicit_order) <= within && std::abs(tolerances.slope() - implicit_order) <= within;
  return {"K4",
          fmt::format("error falls with steps to the power {:.2f}, explicit, and {:.2f}, implicit by its tolerance",
                      steps.slope(), tolerances.slope()),
          "3 and 2 within 0.2", good};
}

}  // namespace polybed::multiscale
