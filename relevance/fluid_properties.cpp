#include "relevance/fluid_properties.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "closures/equation_of_state.hpp"
#include "closures/fluid_properties.hpp"
#include "closures/gas_slip.hpp"
#include "core/error.hpp"

namespace polybed::relevance {

namespace {

/// Density of water at the outlet's pressure if it is compressible; the tables are for 1 atm.
double water_density(const core::Fluid& fluid, double kelvin) {
  const double at_atmosphere = closures::water_density(kelvin);
  if (fluid.equation_of_state != core::Compressibility::tait) return at_atmosphere;
  return closures::TaitLiquid{at_atmosphere, 101325, fluid.tait_stiffness}.density(fluid.outlet_pressure);
}

}  // namespace

FluidConstants fluid_constants(const core::Fluid& fluid) {
  FluidConstants constants{fluid.density.value_or(0), fluid.viscosity.value_or(0)};
  if (fluid.density && fluid.viscosity) return constants;
  if (!fluid.present()) throw core::CaseError("fluid.name = \"none\": this needs a fluid");
  const bool water = fluid.substance() == core::Substance::water;
  if (fluid.substance() == core::Substance::other)
    throw core::CaseError("fluid '" + fluid.name +
                          "': give fluid.density and fluid.viscosity; only water and air know theirs");
  if (!fluid.temperature)
    throw core::CaseError("fluid.temperature is missing: " + fluid.name +
                          " knows its density and viscosity from it (or give both)");
  try {
    const double t = *fluid.temperature;
    if (!fluid.density)
      constants.density = water ? water_density(fluid, t) : closures::air_density(t, fluid.outlet_pressure);
    if (!fluid.viscosity) constants.viscosity = water ? closures::water_viscosity(t) : closures::air_viscosity(t);
  } catch (const std::out_of_range& error) {
    throw core::CaseError(
        fmt::format("fluid.temperature: {}; beyond it give fluid.density and fluid.viscosity", error.what()));
  }
  return constants;
}

double mean_free_path_at(double pressure, double density, double viscosity) {
  constexpr double kelvin = 1;  // only the product R T is needed
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
