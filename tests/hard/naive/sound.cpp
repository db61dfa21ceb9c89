#include "hard/naive/sound.hpp"

#include <stdexcept>

#include "fluid/compressible.hpp"
#include "fluid/inlet.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::hard::naive {

std::vector<double> bottom_pressures(const std::string& name, const core::Scene& scene, double step, int steps) {
  if (name != "explicit_sound") throw std::invalid_argument("no textbook treatment of sound called " + name);
  const double density = relevance::fluid_constants(scene.fluid).density;
  const double sound =
      fluid::speed_of_sound(fluid::equation_of_state(scene.fluid, density), scene.fluid.outlet_pressure);
  const int cells = scene.column.cells[1];
  const double h = scene.column.size[1] / cells;
  const fluid::Ramp inlet(scene.inlet.superficial_velocity);
  std::vector<double> p(std::size_t(cells), 0.0), u(std::size_t(cells) + 1, 0.0), bottom;
  for (int n = 1; n <= steps; ++n) {
    u[0] = inlet.velocity(n * step);
    for (std::size_t k = 1; k < u.size(); ++k) {
      const bool top = k == p.size();  // p = 0 half a cell above it
      u[k] -= step / density * ((top ? 0 : p[k]) - p[k - 1]) / (top ? 0.5 * h : h);
    }
    for (std::size_t k = 0; k < p.size(); ++k) p[k] -= step * density * sound * sound * (u[k + 1] - u[k]) / h;
    bottom.push_back(p[0]);
  }
  return bottom;
}

}  // namespace polybed::hard::naive
