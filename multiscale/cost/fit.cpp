#include "multiscale/cost/fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace polybed::multiscale {

namespace {

/// The value of a power law's variable that makes an error; 0 for a law that is absent.
double inverse(const PowerLaw& law, double error) {
  return law.factor > 0 ? std::pow(error / law.factor, 1 / law.exponent) : 0;
}

/// Settings and cost with these shares of the squared error for time, space and fluctuation.
Optimum settings_at(const ErrorModel& model, double target, const std::array<double, 3>& share) {
  Optimum found;
  found.tolerance = inverse(model.time, target * std::sqrt(share[0]));
  found.spacing = inverse(model.space, target * std::sqrt(share[1]));
  found.window = model.fluctuation > 0 ? std::pow(model.fluctuation / target, 2) / share[2] : 0;
  const double tau = model.time.factor > 0 ? std::pow(found.tolerance, -model.time_exponent) : 1;
  const double h = model.space.factor > 0 ? std::pow(found.spacing, -model.space_exponent) : 1;
  found.cost = (model.spin_up + found.window) * model.rate * tau * h;
  return found;
}

}  // namespace

double PowerLaw::at(double x) const { return factor * std::pow(x, exponent); }

std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y) {
  std::vector<std::pair<double, double>> points;
  for (std::size_t n = 0; n < std::min(x.size(), y.size()); ++n)
    if (x[n] > 0 && y[n] > 0) points.emplace_back(std::log(x[n]), std::log(y[n]));
  if (points.size() < 2) return std::nullopt;
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) {
    mean_x += a / double(points.size());
    mean_y += b / double(points.size());
  }
  for (const auto& [a, b] : points) {
    xx += (a - mean_x) * (a - mean_x);
    xy += (a - mean_x) * (b - mean_y);
  }
  if (!(xx > 0)) return std::nullopt;
  PowerLaw law{0, xy / xx, 0};
  double squares = 0;
  for (const auto& [a, b] : points) squares += std::pow(b - mean_y - law.exponent * (a - mean_x), 2);
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  law.scatter = std::sqrt(squares / double(points.size()));
  return law;
}

std::vector<std::size_t> pareto_front(std::span<const Priced> points) {
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].cost != points[b].cost ? points[a].cost < points[b].cost : points[a].error < points[b].error;
  });
  for (const std::size_t n : order)
    if (front.empty() || points[n].error < points[front.back()].error) front.push_back(n);
  return front;
}

Optimum cheapest(const ErrorModel& model, double target) {
  const std::array<double, 3> present{model.time.factor > 0 ? 1.0 : 0.0, model.space.factor > 0 ? 1.0 : 0.0,
                                      model.fluctuation > 0 ? 1.0 : 0.0};
  const auto shares = [&](double a, double b) {
    std::array<double, 3> share{a * present[0], b * (1 - a) * present[1], (1 - a) * (1 - b) * present[2]};
    const double sum = share[0] + share[1] + share[2];
    for (double& s : share) s /= sum > 0 ? sum : 1;
    return share;
  };
  std::optional<Optimum> best;
  constexpr int parts = 40, rounds = 4;
  double a0 = 0.5, b0 = 0.5, half = 0.5;
  for (int round = 0; round < rounds; ++round, half *= 0.15) {
    double a_best = a0, b_best = b0;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; j <= parts; ++j) {
        const double a = std::clamp(a0 + half * (2.0 * i / parts - 1), 1e-6, 1 - 1e-6),
                     b = std::clamp(b0 + half * (2.0 * j / parts - 1), 1e-6, 1 - 1e-6);
        const Optimum here = settings_at(model, target, shares(a, b));
        if (best && here.cost >= best->cost) continue;
        best = here;
        a_best = a;
        b_best = b;
      }
    a0 = a_best;
    b0 = b_best;
  }
  return *best;
}

}  // namespace polybed::multiscale
