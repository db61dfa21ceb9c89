#include "closures/fluid_properties.hpp"

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace polybed::closures {

namespace {

constexpr double zero_celsius = 273.15;

void check_range(const char* fluid, double kelvin, double least, double most) {
  if (kelvin >= least && kelvin <= most) return;
  std::ostringstream message;
  message << "temperature of " << fluid << ": " << kelvin - zero_celsius << " degC is outside "
          << std::lround(least - zero_celsius) << " to " << std::lround(most - zero_celsius) << " degC";
  throw std::out_of_range(message.str());
}

}  // namespace

double water_density(double kelvin) {
  check_range("water", kelvin, zero_celsius, zero_celsius + 40);
  const double t = kelvin - zero_celsius, d = t - 3.983035;
  return 999.97495 * (1 - d * d * (t + 301.797) / (522528.9 * (t + 69.34881)));
}

double water_viscosity(double kelvin) {
  check_range("water", kelvin, zero_celsius, zero_celsius + 40);
  constexpr std::array<double, 4> a{280.68, 511.45, 61.131, 0.45903}, b{-1.9, -7.7, -19.6, -40};
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += a[i] * std::pow(kelvin / 300, b[i]);
  return 1e-6 * sum;
}

double air_density(double kelvin, double pressure) {
  check_range("air", kelvin, 200, 1000);
  return pressure / (287.05 * kelvin);
}

double air_viscosity(double kelvin) {
  check_range("air", kelvin, 200, 1000);
  return 1.458e-6 * kelvin * std::sqrt(kelvin) / (kelvin + 110.4);
}

}  // namespace polybed::closures
