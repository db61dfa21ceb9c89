#include "relevance/gas_slip.hpp"

#include "closures/gas_slip.hpp"
#include "core/case/laws.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::relevance {

double mean_free_path_at(double pressure, double density, double viscosity) {
  constexpr double kelvin = 1;  // only the product R T is asked for
  return closures::mean_free_path(density, viscosity, kelvin, pressure / density);
}

std::vector<double> slip_divisors(const core::Scene& scene, std::span<const double> diameters) {
  std::vector<double> divisors(diameters.size(), 1.0);
  if (!core::acts(scene, "gas_slip")) return divisors;
  const FluidConstants fluid = fluid_constants(scene.fluid);
  const double path = mean_free_path_at(scene.fluid.outlet_pressure, fluid.density, fluid.viscosity);
  for (std::size_t j = 0; j < divisors.size(); ++j) divisors[j] = closures::cunningham_divisor(2 * path / diameters[j]);
  return divisors;
}

}  // namespace polybed::relevance
