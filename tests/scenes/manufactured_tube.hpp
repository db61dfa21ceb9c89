// The manufactured solution in a round column: polynomials of the distance from the axis times waves along the height,
// whose ends are joined. Nothing crosses the wall, on which the fluid rests and the solids slip.
#pragma once

#include "scenes/manufactured_box.hpp"

namespace polybed::scenes {

/// Fine particles in a tube of 10 mm: drag rules, errors gather for thirty relaxation times of the slip.
constexpr Regime tube_of_fines{0.01, 0.02, 5e-4, 0.01};
/// Coarse ones in a more viscous liquid: all terms count, for a short time as in `balanced`.
constexpr Regime tube_of_coarse{0.01, 0.1, 8e-3, 0.005};

/// As high as wide.
inline core::Scene manufactured_tube(const Regime& regime, core::ColumnShape shape, int across) {
  const bool rings = shape == core::ColumnShape::axisymmetric;
  core::Scene scene =
      rings ? all_effects(regime, 2, {across / 2, across, 1}) : all_effects(regime, 3, {across, across, across});
  scene.column.shape = shape;
  scene.column.sides = core::Boundary::wall;
  const double diameter = regime.length;
  if (rings) scene.column.size = {diameter / 2, diameter, std::numbers::pi * diameter / 2};
  return scene;
}

/// The constants of a tube whose ends are joined.
inline tfm::Constants joined_tube(const core::Scene& scene) {
  core::Timers timers;
  tfm::Constants constants = tfm::Model(scene, timers).constants();
  constants.grid.periodic[1] = true;
  return constants;
}

/// \param x, z  from the axis  \param lean  1: different from one side to the other; 0: the same all around
inline Exact exact_in_tube(double x, double y, double z, double radius, double lean) {
  const double length = 2 * radius;
  const Jet along_x{x, {1, 0, 0}, {}}, along_z{z, {0, 0, 1}, {}};
  const Jet s = (along_x * along_x + along_z * along_z) * constant(1 / (radius * radius)), q = constant(1) - s;
  const Jet across = constant(lean / radius) * along_x;
  const auto up = [&](double amplitude, double shift) {
    return constant(amplitude) * wave({0, y, 0}, {0, 1, 0}, shift, length);
  };
  Exact e;
  e.phi = {constant(0.18) + q * (up(0.03, 1.0) + constant(0.02) * across), constant(0.14) + q * up(0.03, 2.0)};
  const auto solids = [&](double base, double shift) {  // no shear on the wall
    const Jet outward = q * up(0.02 / radius, shift + 0.7);
    return Vector{outward * along_x, constant(base) + q * q * (up(0.02, shift) + constant(0.02) * across),
                  outward * along_z};
  };
  e.u = {solids(0.02, 0.4), solids(-0.03, 0.9)};
  // A profile, and eddies of the stream function r^2 q^2 g(y). On the wall the flux is what the solids carry.
  const Jet g = up(0.02, 0.5), slope = constant(2 * std::numbers::pi / length) * up(0.02, 0.5 + std::numbers::pi / 2);
  e.flux = {constant(-1) * along_x * q * q * slope,
            constant(0.18 * 0.02 - 0.14 * 0.03) + q * (constant(0.1) + constant(0.05) * across) +
                constant(2) * (q - constant(2) * s) * q * g,
            constant(-1) * along_z * q * q * slope};
  e.pressure = (constant(1) + s + across) * up(200 * length, 0.8);
  return e;
}

/// In cut cells and faces the mean over their open part. The part that a cell takes over from a small one is left out.
inline Solution solution_of_tube(const core::Scene& scene) {
  const int cells = scene.column.cells[0];
  if (scene.column.shape == core::ColumnShape::axisymmetric) {
    const double radius = scene.column.size[0];
    return {3, [=](const auto& x) { return exact_in_tube(x[0], x[1], 0, radius, 0); }, {}};
  }
  const double radius = scene.column.size[0] / 2, h = scene.column.size[0] / cells;
  const auto places = [=](const std::array<double, 3>& centre, int axis) {
    constexpr int parts = 8;
    std::vector<std::array<double, 3>> inside;
    for (int n = 0; n < parts * parts; ++n) {
      std::array<double, 3> x = centre;
      if (axis != 0) x[0] += h * ((n % parts + 0.5) / parts - 0.5);
      if (axis != 2) x[2] += h * ((n / parts + 0.5) / parts - 0.5);
      if (std::hypot(x[0] - radius, x[2] - radius) < radius) inside.push_back(x);
    }
    return inside.empty() ? std::vector{centre} : inside;
  };
  return {3, [=](const auto& x) { return exact_in_tube(x[0] - radius, x[1], x[2] - radius, radius, 1); }, places};
}

}  // namespace polybed::scenes
