// Particles in the averaged fluid: scenes, lattices, and the motion of one sphere as an ordinary differential equation.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "closures/drag.hpp"
#include "scenes/beads.hpp"

namespace polybed::scenes {

struct Liquid {
  double density, viscosity;  ///< kg/m3, Pa s
};
constexpr Liquid water{1000, 1e-3}, gas{1.2, 1.8e-5};

/// Soft spheres of one species in a column, m, with the fluid at rest: closed, all sides walls but for the test's word.
inline core::Scene wet_box(double diameter, double density, const Liquid& fluid, dem::Vector size,
                           std::array<int, 3> cells) {
  core::Scene scene = dry_box(0.5 * diameter, {1e6, 0.25, density}, size);
  scene.column.cells = cells;
  scene.column.dimensions = cells[2] > 1 ? 3 : 2;
  scene.column.closed = true;
  scene.fluid.name = "test fluid";
  scene.fluid.density = fluid.density;
  scene.fluid.viscosity = fluid.viscosity;
  scene.effects["drag"] = "schiller_naumann";
  scene.dem.kernel = core::Kernel::bilinear;
  scene.dem.fluid_every = 1;
  return scene;
}

/// Particles on a simple cubic lattice that fills a box, half a spacing from its faces.
inline std::vector<Bead> cubic_lattice(const std::string& species, double spacing, const dem::Vector& size,
                                       const dem::Vector& velocity = {}) {
  std::vector<Bead> beads;
  const auto along = [&](std::size_t k) { return int(std::lround(size[k] / spacing)); };
  for (int k = 0; k < along(2); ++k)
    for (int j = 0; j < along(1); ++j)
      for (int i = 0; i < along(0); ++i)
        beads.push_back({species, {(i + 0.5) * spacing, (j + 0.5) * spacing, (k + 0.5) * spacing}, velocity});
  return beads;
}

/// f of a law for one size. \param slip  superficial, m/s
inline double drag_of(const std::string& law, double voidage, double diameter, double slip, const Liquid& fluid) {
  double f = 0, slope = 0;
  const double share = 1;
  closures::drag_of_mixture(closures::drag_law(law, closures::Guard::on), voidage, {&share, 1}, {&diameter, 1},
                            {&slip, 1}, fluid.density, fluid.viscosity, {&f, 1}, {&slope, 1});
  return f;
}

/// One sphere in an endless fluid that moves upward with a speed of its own:
///   (rho_p + C_m rho_f) V dv/dt = -(rho_p - rho_f) V g - 3 pi mu D f (v - u).
struct Sphere {
  double diameter, density;
  Liquid fluid;
  double gravity, upflow = 0, added_mass = 0;  ///< added_mass: C_m
  std::string law = "schiller_naumann";

  [[nodiscard]] double volume() const { return pi / 6 * diameter * diameter * diameter; }
  [[nodiscard]] double acceleration(double v) const {
    const double slip = upflow - v, f = drag_of(law, 1, diameter, std::abs(slip), fluid);
    const double force =
        -(density - fluid.density) * volume() * gravity + 3 * pi * fluid.viscosity * diameter * f * slip;
    return force / ((density + added_mass * fluid.density) * volume());
  }
  /// Velocity and height over the start at a time, from rest: fourth-order Runge-Kutta steps, 1e-12 at 4000 of them.
  [[nodiscard]] std::array<double, 2> at(double time, int steps = 4000) const {
    double v = 0, y = 0;
    const double h = time / steps;
    for (int n = 0; n < steps; ++n) {
      const double a = acceleration(v), b = acceleration(v + 0.5 * h * a), c = acceleration(v + 0.5 * h * b),
                   d = acceleration(v + h * c);
      y += h * v + h * h / 6 * (a + b + c);
      v += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return {v, y};
  }
  /// Where drag carries the weight, by halving.
  [[nodiscard]] double terminal() const {
    double low = -1e3, high = 1e3;  // acceleration falls with v
    for (int n = 0; n < 200; ++n) (acceleration(0.5 * (low + high)) > 0 ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }
};

/// Solids in all cells, m3.
inline double solids_of(const dem::Model& model) {
  const dem::Coupling::Column column = model.coupling()->column();
  double sum = 0;
  for (const core::Field& phi : column.fraction)
    core::for_each_row(column.grid, [&](core::Index begin, core::Index end) {
      for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
        sum += phi[c] * (column.grid.metric ? column.grid.metric->volume[c] : 1);
    });
  return sum * column.grid.cell_volume();
}

}  // namespace polybed::scenes
