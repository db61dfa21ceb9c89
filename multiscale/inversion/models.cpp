#include "multiscale/inversion/models.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "closures/terminal_velocity.hpp"
#include "core/error.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using closures::DragLaw;
using Residual = std::function<std::optional<double>(double)>;
constexpr double least_voidage = 0.2;
constexpr int scan = 4000;          ///< intervals of the scan for roots
constexpr int scan_of_pairs = 400;  ///< the same for a mean law with a partition: there are 75 of them to list

/// Roots in (low, high) of a residual that can be undefined in places: sign changes of a scan, refined by bisection.
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

/// Ridders' method: a root of a function that is below 0 at low and above 0 at high, to the last digits.
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

/// Solves load(u) = target for u > 0, with a load that grows with u: bisection in the logarithm, then Ridders' method.
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

/// Density of solids and fluid together, kg/m3; T(5.6).
double bulk_density(const BinaryBed& bed, double voidage) {
  return (1 - voidage) * (bed.share[0] * bed.density[0] + bed.share[1] * bed.density[1]) + voidage * bed.fluid.density;
}

/// Superficial velocity at which species j rests in a mixture, where its drag is (rho_j - rho_b) g V_j; none if it
/// floats in the bulk. \param voidage  of the mixture
std::optional<double> resting_velocity(const BinaryBed& bed, const DragLaw& law, double voidage, std::size_t j) {
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

std::vector<InversionPoint> by_force_balance(const BinaryBed& bed, const DragLaw& law) {
  const Residual residual = [&](double voidage) -> std::optional<double> {
    const auto u1 = resting_velocity(bed, law, voidage, 0), u2 = resting_velocity(bed, law, voidage, 1);
    return u1 && u2 ? std::optional(std::log(*u1 / *u2)) : std::nullopt;
  };
  std::vector<InversionPoint> points;
  for (const double voidage : roots(residual, least_voidage, 1, law.partition ? scan_of_pairs : scan))
    points.push_back({*resting_velocity(bed, law, voidage, 1), voidage});
  return points;
}

closures::ShapeFactor shape_of(const DragLaw& law, std::size_t j) {
  return law.shape ? law.shape->species[j] : closures::ShapeFactor();
}

/// Voidage of a uniform bed of species j alone at u: f(eps, Re) 18 mu u / (eps D^2) = (rho_j - rho_f) g.
std::optional<double> pure_voidage(const BinaryBed& bed, const DragLaw& law, double u, std::size_t j) {
  const double weight = (bed.density[j] - bed.fluid.density) * bed.gravity, d = bed.diameter[j];
  const double re = bed.fluid.density * u * d / bed.fluid.viscosity;
  const closures::ShapeFactor shape = shape_of(law, j);
  const auto excess = [&](double eps) {
    const double f = std::visit([&](const auto& l) { return l.base(eps, re).f; }, law.law) * shape(eps, re);
    return 18 * bed.fluid.viscosity * u * f / (eps * d * d) - weight;
  };
  double low = least_voidage, high = 1;
  if (!(weight > 0) || excess(low) < 0 || excess(high) > 0) return std::nullopt;
  for (int n = 0; n < 100; ++n) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (excess(middle) > 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<InversionPoint> by_bulk_density(const BinaryBed& bed, const DragLaw& law) {
  const auto voidages = [&](double log_u) {
    return std::pair(pure_voidage(bed, law, std::exp(log_u), 0), pure_voidage(bed, law, std::exp(log_u), 1));
  };
  const Residual residual = [&](double log_u) -> std::optional<double> {
    const auto [e1, e2] = voidages(log_u);
    if (!e1 || !e2) return std::nullopt;
    return (1 - *e1) * (bed.density[0] - bed.fluid.density) - (1 - *e2) * (bed.density[1] - bed.fluid.density);
  };
  std::vector<InversionPoint> points;
  for (double log_u : roots(residual, std::log(1e-6), std::log(10.0), scan)) {
    const auto [e1, e2] = voidages(log_u);
    points.push_back({std::exp(log_u), 1 - 1 / (bed.share[0] / (1 - *e1) + bed.share[1] / (1 - *e2))});
  }
  return points;
}

std::vector<InversionPoint> by_expansion(const BinaryBed& bed, const DragLaw& law) {
  std::array<double, 2> terminal{}, exponent{};
  for (std::size_t j = 0; j < 2; ++j) {
    const closures::DragTurtonLevenspiel single;
    const closures::ShapeFactor shape = shape_of(law, j);
    terminal[j] = closures::terminal_velocity([&](double eps, double re) { return single(eps, re).f * shape(eps, re); },
                                              bed.diameter[j], bed.density[j] - bed.fluid.density, bed.fluid.density,
                                              bed.fluid.viscosity, bed.gravity);
    exponent[j] = closures::DragRichardsonZaki{}.exponent(bed.fluid.density * terminal[j] * bed.diameter[j] /
                                                          bed.fluid.viscosity);
  }
  const double average = bed.share[0] * bed.diameter[0] + bed.share[1] * bed.diameter[1];
  const auto slip = [&](double voidage, std::size_t j) {
    const double own = closures::MixturePatwardhanTien::own_voidage(voidage, bed.diameter[j], average);
    return terminal[j] * std::pow(own, exponent[j] - 2) * (bed.density[j] - bulk_density(bed, voidage)) /
           (bed.density[j] - bed.fluid.density);
  };
  const Residual residual = [&](double voidage) -> std::optional<double> {
    const double a = slip(voidage, 0), b = slip(voidage, 1);
    return a > 0 && b > 0 ? std::optional(std::log(a / b)) : std::nullopt;
  };
  std::vector<InversionPoint> points;
  for (double voidage : roots(residual, least_voidage, 1, scan))
    points.push_back({voidage * slip(voidage, 1), voidage});
  return points;
}

/// Left minus right side of T(5.10) with rho_f (printed rho_b), for a share x of species 1.
double gibilaro(const BinaryBed& bed, double x, double voidage, double u) {
  const double mean = 1 / (x / bed.diameter[0] + (1 - x) / bed.diameter[1]);
  const double re = bed.fluid.density * u * mean / bed.fluid.viscosity;
  const double tanh = std::tanh(20 * voidage - 8);
  const double s = voidage < 0.4 ? 2.55 : 2.55 - 2.1 * std::pow(tanh, 0.99);
  const double excess = x * (bed.density[0] - bed.fluid.density) + (1 - x) * (bed.density[1] - bed.fluid.density);
  return std::pow(std::pow(17.3 / re, s) + std::pow(0.336, s), 1 / s) * bed.fluid.density * u * u /
             (bed.gravity * mean) -
         std::pow(voidage, 4.8) * excess;
}

std::vector<InversionPoint> by_density_maximum(const BinaryBed& bed) {
  const auto voidage_at = [&](double x, double u, double near) {
    double low = std::max(near - 0.02, 0.1), high = std::min(near + 0.02, 1.2);
    for (int n = 0; n < 100; ++n) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (gibilaro(bed, x, middle, u) > 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  };
  const auto velocity_at = [&](double voidage) {
    return velocity_of([&](double u) { return gibilaro(bed, bed.share[0], voidage, u); }, 0);
  };
  const Residual slope_of_density = [&](double voidage) -> std::optional<double> {
    const double u = velocity_at(voidage), step = 1e-4;
    const auto density = [&](double x) {
      const double eps = voidage_at(x, u, voidage);
      return (1 - eps) * (x * bed.density[0] + (1 - x) * bed.density[1]) + eps * bed.fluid.density;
    };
    return (density(bed.share[0] + step) - density(bed.share[0] - step)) / (2 * step);
  };
  std::vector<InversionPoint> points;
  for (double voidage : roots(slope_of_density, least_voidage, 1, scan))
    points.push_back({velocity_at(voidage), voidage});
  return points;
}

}  // namespace

BinaryBed binary_bed(const core::Scene& scene) {
  if (scene.species.size() != 2)
    throw core::CaseError(fmt::format("inversion needs two species, the case has {}", scene.species.size()));
  if (scene.bed.volume_share.size() != 2)
    throw core::CaseError("inversion needs bed.volume_share: bed.start = \"" + text_of(scene.bed.start) +
                          "\" has none");
  BinaryBed bed;
  for (std::size_t j = 0; j < 2; ++j) {
    bed.diameter[j] = scene.species[j].diameter;
    bed.density[j] = scene.species[j].density;
    bed.share[j] = scene.bed.volume_share[j];
  }
  bed.fluid = relevance::fluid_constants(scene.fluid);
  bed.gravity = scene.column.gravity;
  return bed;
}

const std::vector<InversionMethod>& inversion_methods() {
  static const std::vector<InversionMethod> methods{
      {"force_balance", "drag of each species against its weight in the bulk", true, true, by_force_balance},
      {"bulk_density", "pure beds of equal bulk density, Epstein and LeClair 1985", true, false, by_bulk_density},
      {"expansion", "equal slip velocities, Masliyah 1979", false, false, by_expansion},
      {"density_maximum", "composition of largest bulk density, Gibilaro 1986", false, false,
       [](const BinaryBed& bed, const DragLaw&) { return by_density_maximum(bed); }}};
  return methods;
}

std::vector<InversionPoint> inversion_points(const BinaryBed& bed, const DragLaw& law, const std::string& method) {
  std::string names;
  for (const InversionMethod& m : inversion_methods()) {
    if (m.name == method) return m.points(bed, law);
    names += "\n  " + m.name + ": " + m.help;
  }
  throw core::CaseError("unknown method '" + method + "'; allowed are" + names);
}

std::optional<std::size_t> on_top_below(const BinaryBed& bed, const DragLaw& law, const InversionPoint& point) {
  constexpr double less = 0.999;  // of the voidage: on one side of the point
  const auto u1 = resting_velocity(bed, law, less * point.voidage, 0),
             u2 = resting_velocity(bed, law, less * point.voidage, 1);
  if (!u1 || !u2) return std::nullopt;
  const bool lower = std::min(*u1, *u2) < point.velocity;  // else denser mixtures rest at higher velocities
  return (*u1 < *u2) == lower ? 0 : 1;
}

}  // namespace polybed::multiscale
