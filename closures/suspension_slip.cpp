#include "closures/suspension_slip.hpp"

#include <cmath>

namespace polybed::closures {

std::vector<double> suspension_slips(const DragLaw& law, double voidage, std::span<const double> share,
                                     std::span<const double> diameter, std::span<const double> excess,
                                     double fluid_density, double viscosity, double gravity, double gradient) {
  constexpr int rounds = 200;
  const std::size_t n = diameter.size();
  std::vector<double> creeping(n), slip(n), superficial(n), f(n), slope(n);
  for (std::size_t j = 0; j < n; ++j)
    creeping[j] = (excess[j] * gravity + gradient) * diameter[j] * diameter[j] / (18 * viscosity * voidage);
  slip = creeping;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t j = 0; j < n; ++j) superficial[j] = voidage * std::abs(slip[j]);
    drag_of_mixture(law, voidage, share, diameter, superficial, fluid_density, viscosity, f, slope);
    for (std::size_t j = 0; j < n; ++j) slip[j] = 0.5 * (slip[j] + creeping[j] / f[j]);
  }
  return slip;
}

}  // namespace polybed::closures
