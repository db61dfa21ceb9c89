// Hard cases of one sphere in cells not much larger than itself: C2 and C3.
#include <algorithm>
#include <cmath>
#include <vector>

#include "hard/cases.hpp"
#include "hard/suspension.hpp"
#include "measures/profile.hpp"

namespace polybed::hard {

namespace {

using scenes::water;

/// Mean net pressure of the lowest row of cells less that of the highest, Pa.
double drop_of(const fluid::Flow& flow) {
  const std::vector<double> mean = measures::lateral_mean(flow.grid(), flow.state().pressure);
  return mean.front() - mean.back();
}

/// What lies furthest from the straight line through values at equal distances.
double off_the_line(const std::vector<double>& values) {
  const auto n = double(values.size());
  double mean = 0, slope = 0, spread = 0, most = 0;
  for (const double v : values) mean += v / n;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double x = double(k) - 0.5 * (n - 1);
    slope += x * values[k];
    spread += x * x;
  }
  for (std::size_t k = 0; k < values.size(); ++k)
    most = std::max(most, std::abs(values[k] - mean - slope / spread * (double(k) - 0.5 * (n - 1))));
  return most;
}

/// C2: a sphere crosses two cells slowly, too heavy to be held up: the pressure drop that its drag takes stays even.
void crosses_cells(Trial& trial) {
  constexpr double d = 1e-3, cell = 1.5e-3, speed = 10e-3;
  constexpr int to_a_cell = 40;
  core::Scene scene = scene_of(d, 1e12, water, cell, {8, 16, 8}, 1);
  scene.column.sides = core::Boundary::periodic;
  scene.dem.kernel = trial.naive() ? core::Kernel::bilinear : core::Kernel::diffusion;
  if (!trial.naive()) scene.dem.kernel_width = 6 * d;
  const auto run = begin_suspension(trial, scene, {{"a", {4.1 * cell, 10.3 * cell, 3.9 * cell}, {0, -speed, 0}}},
                                    cell / speed / to_a_cell);
  for (int n = 0; n < 2 * to_a_cell; ++n) run->step();
  std::vector<double> drop;
  for (int n = 0; n < 2 * to_a_cell; ++n) {
    run->step();
    drop.push_back(drop_of(run->flow()));
  }
  // Its weight in the fluid would be this drag, were it as heavy as falls at its speed.
  const double drag =
      3 * scenes::pi * water.viscosity * d * speed * scenes::drag_of("schiller_naumann", 1, d, speed, water);
  const double area = scene.column.size[0] * scene.column.size[2];
  trial.measure("ripple of the pressure drop over weight per area", off_the_line(drop) * area / drag, 0.01);
}

/// C3: a sphere of glass falls in cells of one to four diameters: as fast as alone, though it stirs what it feels.
void feels_itself(Trial& trial) {
  const scenes::Sphere glass{5e-4, 2500, water, 9.81};
  for (const auto& [cells, n] : {std::pair{1.0, 24}, {2.5, 16}, {4.0, 12}}) {
    const double cell = cells * glass.diameter;
    core::Scene scene = scene_of(glass.diameter, glass.density, water, cell, {n, n, n}, 4);
    scene.column.gravity = glass.gravity;
    scene.effects["fluid_stress"] = "newtonian";
    scene.dem.kernel = trial.naive() ? core::Kernel::bilinear : core::Kernel::diffusion;
    if (!trial.naive()) scene.dem.kernel_width = 6 * glass.diameter;
    const auto run = begin_suspension(trial, scene, {{"a", {0.52 * n * cell, (n - 4) * cell, 0.47 * n * cell}}}, 1e-4);
    for (int k = 0; k < 250; ++k) run->step();
    const double share = run->particles().motion[0].v[1] / glass.at(0.1)[0] - 1;
    trial.report("speed beyond that of one alone, cells of " + std::to_string(cells).substr(0, 3) + " d", share);
    trial.measure("speed beyond that of one alone", std::abs(share), 0.01);
  }
}

}  // namespace

std::vector<HardCase> one_sphere_cases() {
  const std::vector<Treatment> coupled{{"coupled", "", ""}};
  return {{"C2", "a sphere crosses cells slowly", {"pcm_void"}, coupled, crosses_cells, false},
          {"C3", "a sphere and its own wake", {"pcm_void"}, coupled, feels_itself, false}};
}

}  // namespace polybed::hard
