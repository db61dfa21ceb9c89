#include "multiscale/inversion/balance.hpp"

#include <cmath>
#include <utility>

namespace polybed::multiscale {

std::vector<double> roots(const Residual& residual, double low, double high, int intervals) {
  std::vector<double> found;
  std::optional<double> last;
  double last_at = low;
  for (int n = 1; n < intervals; ++n) {
    const double at = low + (high - low) * n / intervals;
    const std::optional<double> here = residual(at);
    if (last && here && *last * *here <= 0 && *last != 0) {
      double a = last_at, b = at;
      for (int k = 0; k < 100; ++k) {
        const double middle = 0.5 * (a + b);
        if (middle == a || middle == b) break;
        const std::optional<double> value = residual(middle);
        if (!value) break;
        (*value * *last > 0 ? a : b) = middle;
      }
      found.push_back(0.5 * (a + b));
    }
    last = here;
    last_at = at;
  }
  return found;
}

namespace {

/// Ridders' method: a root of a function that is below 0 at low and above 0 at high, to its last digits.
double ridders(const std::function<double(double)>& f, double low, double high, double at_low, double at_high) {
  double last = low;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high), at_middle = f(middle);
    const double next = middle - (middle - low) * at_middle / std::sqrt(at_middle * at_middle - at_low * at_high);
    const double at_next = f(next);
    if (at_next == 0 || std::abs(next - last) <= 1e-15 * next) return next;
    for (const auto& [at, value] : {std::pair(middle, at_middle), std::pair(next, at_next)}) {
      if (value < 0 && at >= low) low = at, at_low = value;
      if (value >= 0 && at <= high) high = at, at_high = value;
    }
    last = next;
  }
  return last;
}

}  // namespace

double velocity_of(const std::function<double(double)>& load, double target) {
  double low = 1e-12, high = 1e3;
  const auto halve = [&] {
    const double middle = std::sqrt(low * high);
    (load(middle) < target ? low : high) = middle;
  };
  while (high / low > 2) halve();
  const double at_low = load(low) - target, at_high = load(high) - target;
  if (at_low < 0 && at_high > 0 && std::isfinite(at_low * at_high))
    return ridders([&](double u) { return load(u) - target; }, low, high, at_low, at_high);
  for (int n = 0; n < 200 && high / low > 1 + 1e-15; ++n) halve();
  return std::sqrt(low * high);
}

double bulk_density(const BinaryBed& bed, double voidage) {
  return (1 - voidage) * (bed.share[0] * bed.density[0] + bed.share[1] * bed.density[1]) + voidage * bed.fluid.density;
}

std::optional<double> resting_velocity(const BinaryBed& bed, const closures::DragLaw& law, double voidage,
                                       std::size_t j) {
  const double weight = (bed.density[j] - bulk_density(bed, voidage)) * bed.gravity;
  if (!(weight > 0)) return std::nullopt;
  // Drag per volume of the species, Pa/m: 18 mu u f_j / D_j^2.
  const auto drag = [&](double u) {
    std::array<double, 2> f{}, slope{};
    closures::drag_of_mixture(law, voidage, bed.share, bed.diameter, std::array{u, u}, bed.fluid.density,
                              bed.fluid.viscosity, f, slope);
    return 18 * bed.fluid.viscosity * u * f[j] / (bed.diameter[j] * bed.diameter[j]);
  };
  return velocity_of(drag, weight);
}

}  // namespace polybed::multiscale
