// Power laws for error and cost, the front of what nothing beats, and the cheapest settings for a target.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace polybed::multiscale {

/// y = factor x^exponent.
struct PowerLaw {
  double factor = 0, exponent = 0;
  double scatter = 0;  ///< root mean square of the logarithm's residuals
  [[nodiscard]] double at(double x) const;
};

/// Least squares of ln y over ln x. Empty for fewer than two different x; pairs that are not above 0 are left out.
[[nodiscard]] std::optional<PowerLaw> fit_power_law(std::span<const double> x, std::span<const double> y);

struct Priced {
  double error = 0, cost = 0;
};

/// Which of the points no other one beats in both, by rising cost. Of equal points the first.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const Priced> points);

/// E^2 = (C_t tau^q)^2 + (C_h h^p)^2 + (A/sqrt(T))^2 at the cost (T_spin + T) R tau^-a h^-b (cost.md, section 6).
/// A law with the factor 0 is absent, its variable without influence.
struct ErrorModel {
  PowerLaw time;              ///< C_t, q
  PowerLaw space;             ///< C_h, p
  double fluctuation = 0;     ///< A; 0: nothing fluctuates
  double spin_up = 0;         ///< T_spin, s
  double rate = 0;            ///< R, s per simulated s at tau = h = 1
  double time_exponent = 0;   ///< a
  double space_exponent = 0;  ///< b
};

struct Optimum {
  double tolerance = 0, spacing = 0, window = 0;  ///< tau, h, T; 0 where absent
  double cost = 0;
};

/// The cheapest tau, h and T with E = target: by the shares of the squared error that each may have, found to 1e-3.
[[nodiscard]] Optimum cheapest(const ErrorModel& model, double target);

}  // namespace polybed::multiscale
