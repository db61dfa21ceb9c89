// What errors are weighed by in a step: a relative tolerance and absolute ones, which may follow the state.
#pragma once

#include <cmath>
#include <functional>
#include <span>

namespace polybed::core {

/// Sets the absolute tolerances at a state, entry by entry. \param y  this rank's state  \param dydt  its rates, of
/// the implicit integrator only; else empty. Collective.
using TolerancesAt =
    std::function<void(std::span<const double> y, std::span<const double> dydt, std::span<double> atol)>;

/// Sets weight_i = 1/(rtol |y_i| + atol_i) with the tolerances at y. \param weight  work space until then
inline void weigh_errors(double rtol, const TolerancesAt& atol, std::span<const double> y, std::span<const double> dydt,
                         std::span<double> weight) {
  atol(y, dydt, weight);
  for (std::size_t n = 0; n < y.size(); ++n) weight[n] = 1 / (rtol * std::abs(y[n]) + weight[n]);
}

}  // namespace polybed::core
