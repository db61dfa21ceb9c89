// Boxes of sheared spheres that a liquid drags towards the flow.
#pragma once

#include "scenes/dem_gas.hpp"

namespace polybed::scenes {

/// A gas whose particles relax towards the flow in tau_d = 1/(drag shear_rate), by Stokes' law: 18 mu eps/(rho d^2).
inline core::Scene wet_scene_of(const Gas& gas, double drag) {
  core::Scene scene = scene_of(gas);
  scene.fluid.name = "liquid";
  scene.fluid.density = 1000;
  scene.fluid.viscosity =
      drag * gas.shear_rate * Gas::density * Gas::diameter * Gas::diameter / (18 * (1 - gas.fraction));
  scene.effects["drag"] = "stokes";
  return scene;
}

/// What drag takes from the fluctuations of a gas at a temperature, W.
inline double sink_of(const Gas& gas, double drag, double temperature) {
  return 3 * gas.number * gas.mass() * temperature * drag * gas.shear_rate;
}

/// Theta, p, mu in shear units of phi 0.4, e 0.9 with drag, as another program found them; N = 2048 there.
struct DragRow {
  double drag;
  std::array<double, 3> expected;
};
constexpr DragRow drag_rows[] = {
    {0.1, {0.792, 2.223, 0.686}}, {1, {0.1998, 0.666, 0.340}}, {10, {0.011, 0.193, 0.142}}};

}  // namespace polybed::scenes
