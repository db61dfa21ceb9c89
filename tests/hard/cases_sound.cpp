// Hard case of a fluid that carries sound: C11.
#include <algorithm>
#include <cmath>
#include <vector>

#include "fluid/compressible.hpp"
#include "hard/cases.hpp"
#include "hard/textbook.hpp"
#include "scenes/beds.hpp"

namespace polybed::hard {

namespace {

constexpr double length = 1, density = 998.207, sound = 1450.683, crossing = length / sound, driven = 0.1;
/// It rests first: a fluid that is driven from the start on would begin with the pressure of an incompressible one.
constexpr double start = 1e-4, driven_at = start + 0.2 * crossing;  ///< s
constexpr double joukowsky = density * sound * driven;              ///< Pa

/// A pipe of Tait water alone, one cell wide, open at the top, driven in at the bottom within a fifth of the time that
/// sound takes to the top.
core::Scene pipe(int cells) {
  core::Scene scene = scenes::uniform_bed(1e-3, 2000, density, 1e-5, 0.5, cells, length);
  scene.bed.static_height = 0;
  scene.effects.clear();
  scene.column.gravity = 0;
  scene.fluid.equation_of_state = core::Compressibility::tait;
  scene.inlet.superficial_velocity = {{0.0, 0.0}, {start, 0.0}, {driven_at, driven}};
  return scene;
}

/// Pressures at the bottom after each step, Pa, and by what share the fluid's mass is not what came in and went out.
struct Heard {
  std::vector<double> bottom;
  double mass_error = 0;
};

Heard of_product(const std::string& integrator, core::Scene scene, double step, int steps) {
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  core::Timers timers;
  tfm::Model model(scene, timers);
  const auto cell = std::size_t(model.constants().grid.index(0, 0));
  Heard heard;
  std::vector<double> breakpoints{start, driven_at};
  for (int n = 1; n <= steps; ++n) {
    while (model.time() < n * step * (1 - 1e-12)) {
      const bool jumps = !breakpoints.empty() && breakpoints.front() <= n * step;
      model.step(jumps ? breakpoints.front() : n * step);
      if (!jumps || model.time() < breakpoints.front()) continue;
      model.restart();
      breakpoints.erase(breakpoints.begin());
    }
    model.show(model.time());
    heard.bottom.push_back(model.fields().fluid.pressure[cell]);
  }
  heard.mass_error =
      model.fluid_account(model.time())->error(fluid::fluid_mass(model.constants().grid, model.fields().fluid));
  return heard;
}

Heard heard_of(const Trial& trial, const core::Scene& scene, double step, int steps) {
  if (trial.naive()) return {textbook::sound(trial.treatment().naive, scene, step, steps), 0};
  return of_product(trial.treatment().integrator, scene, step, steps);
}

/// C11: behind the wave the pressure is Joukowsky's; and at steps of the flow, in which sound crosses five cells, it
/// still ends at 0, that of a pipe of which as much flows out as in.
void water_hammer(Trial& trial) {
  constexpr int cells = 40;
  const double fine = 0.1 * length / cells / sound;
  const Heard hammer = heard_of(trial, pipe(cells), fine, int((start + 1.7 * crossing) / fine));
  double sum = 0;
  int samples = 0;
  for (std::size_t n = 0; n < hammer.bottom.size(); ++n)
    if (double(n + 1) * fine > start + 0.7 * crossing) {
      sum += hammer.bottom[n];
      ++samples;
    }
  trial.measure("pressure of Joukowsky", std::abs(sum / samples / joukowsky - 1), 0.02);
  trial.measure("V1 mass of the fluid", hammer.mass_error, 1e-6);  // the integrator's tolerance, not the scheme's sums
  if (!trial.naive() && trial.treatment().integrator == "explicit")
    return;  // it follows sound, whatever steps are asked for
  const double coarse = 5 * length / cells / sound;
  const Heard flow = heard_of(trial, pipe(cells), coarse, 200);
  double most = 0;
  for (const double p : flow.bottom) most = std::max(most, std::isfinite(p) ? std::abs(p) : 1e300);
  // Once driven, nothing drives it further: what is heard stays below twice the first wave.
  trial.measure("pressure over Joukowsky's, at steps of five cells", most / joukowsky, 2);
}

}  // namespace

std::vector<HardCase> sound_cases() {
  return {{"C11",
           "a water hammer",
           {"explicit_sound"},
           {{"explicit", "limited", ""}, {"implicit", "limited", ""}},
           water_hammer,
           false}};
}

}  // namespace polybed::hard
