// Hard cases that take longer than a change should wait for: T11, T12, T18, T20, T21, T24.
#include <algorithm>
#include <cmath>

#include "hard/cases.hpp"
#include "hard/scenes.hpp"

namespace polybed::hard {

namespace {

/// 0.5 mm glass in air, minimum fluidisation at 0.21 m/s, eight cells wide.
core::Scene gas_bed() {
  core::Scene scene = between_walls(uniform_bed(0.5e-3, 2500, 1.2, 1.8e-5, 0.6, 40, 0.16), 8);
  scene.effects = {{"drag", "ergun"}, {"solids_stress", "frictional"}};
  scene.bed.static_height = 0.05;
  scene.bed.start_solids_fraction = 0.58;
  return scene;
}

/// T11: a packed bed, then ten times minimum fluidisation at once.
void piston(Trial& trial) {
  core::Scene scene = gas_bed();
  scene.inlet.superficial_velocity = {{0.0, 0.1}, {0.02, 0.1}, {0.02, 2.1}};
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.08);
}

/// T12: a jet of twenty times minimum fluidisation through a bed, until its bubble has broken the surface.
void jet(Trial& trial) {
  core::Scene scene = gas_bed();
  scene.inlet.superficial_velocity = {{0.0, 0.2}};
  scene.jets.push_back({{0.012}, {0.020}, {{0.0, 4.2}}});
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.15);
}

/// T18: two species settle and rest in a closed column of six by twenty cells, for many steps; left and right stay
/// mirror images. The drift of mass is held against the number of steps.
void many_steps(Trial& trial) {
  core::Scene scene = between_walls(two_species(20, 0.08, true), 6);
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.3;
  scene.tfm.fixed_step = 4e-4;
  scene.tfm.pressure_tolerance = 1e-12;
  const auto run = trial.begin(scene);
  const std::vector<double> before = measures::species_volumes(run->model().constants().grid, run->fields().solids);
  trial.advance(*run, 8, {.steps = false});
  const core::Grid& grid = run->model().constants().grid;
  const std::vector<double> after = measures::species_volumes(grid, run->fields().solids);
  double apart = 0;
  for (const core::Field& phi : run->fields().solids.fraction) apart = std::max(apart, asymmetry(grid, phi, phi));
  trial.report("mirror asymmetry", apart);
  trial.report("steps", double(run->work().steps));
  for (std::size_t j = 0; j < 2; ++j)
    trial.measure("drift of mass per step", std::abs(after[j] / before[j] - 1) / double(run->work().steps), 1e-16);
}

/// Fractions after a time of an expanding bed below the frictional onset, at a tolerance.
std::vector<double> at_tolerance(Trial& trial, double rtol, double until = 0.06) {
  core::Scene scene = two_species(30, 0.09, false);
  scene.inlet.superficial_velocity = {{0.0, 0.03}};
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.45;
  scene.tfm.rtol = rtol;
  const auto run = trial.begin(scene);
  trial.advance(*run, until, {.steps = false});
  return profile_of(*run).fraction[0];
}

/// T20: the error falls, or at least does not grow, from tolerance to tolerance, as far as the integrator goes; the
/// reference is the tightest one.
void tolerances(Trial& trial) {
  const bool implicit = trial.treatment().integrator == "implicit" || trial.naive();
  const double loosest = implicit ? 1e-3 : 1e-1, tightest = implicit ? 1e-7 : 1e-9;
  const std::vector<double> reference = at_tolerance(trial, tightest);
  double last = 1;
  for (double rtol = loosest; rtol > 15 * tightest; rtol *= 0.1) {
    const std::vector<double> phi = at_tolerance(trial, rtol);
    double error = 0;
    for (std::size_t k = 0; k < phi.size(); ++k) error += std::abs(phi[k] - reference[k]) / double(phi.size());
    trial.report("error at " + std::to_string(int(std::lround(std::log10(rtol)))), error);
    trial.measure("error grows as rtol falls", error / last, 1);
    last = error;
  }
}

/// T20, beyond the range: refused, or done.
void beyond_tolerances(Trial& trial, double rtol) { at_tolerance(trial, rtol, 1e-3); }

double seconds_per_step(Trial& trial, int species) {
  core::Scene scene = two_species(40, 0.12, true);
  scene.species.resize(1);
  scene.bed.volume_share = {};
  for (int j = 0; j < species; ++j) {
    scene.species.push_back(scene.species[0]);
    scene.species.back().name = "solid " + std::to_string(j);
    scene.species.back().diameter = (0.5 + 0.4 * j) * 1e-3;
    scene.species.back().density = 2600 - 200 * j;
    scene.bed.volume_share.push_back(1.0 / species);
  }
  scene.species.erase(scene.species.begin());
  scene.bed.static_height = 0.04;
  scene.bed.start_solids_fraction = 0.4;
  const auto run = trial.begin(scene);
  const double begin = core::cpu_seconds();
  trial.advance(*run, 0.3);
  return (core::cpu_seconds() - begin) / double(std::max<std::uint64_t>(run->work().steps, 1));
}

/// T21: five species settle; a step costs at most as the square of their number.
void five_species(Trial& trial) {
  const double one = seconds_per_step(trial, 1), five = seconds_per_step(trial, 5);
  trial.report("cost of a step, five species over one", five / one);
  trial.measure("cost over the square of the number", five / one / 25, 1);
}

/// T24: viscosities from 1e-6 to 1e3 Pa s, and a column without gravity. Explicit steps are bound to the relaxation of
/// slip, D^2 rho_s/(18 mu): they get two hundred of those times, implicit ones a second.
void viscosities(Trial& trial) {
  const std::vector<double> all{1e-6, 1e-3, 1.0, 1e3}, viscous{1.0};  // where drag, not the fall of a sphere, is fast
  for (const double viscosity : trial.naive() ? viscous : all)
    for (const double gravity : {9.81, 0.0}) {
      core::Scene scene = uniform_bed(1e-3, 2200, 998.207, viscosity, 0.58, 30, 0.09);
      scene.effects["solids_stress"] = "frictional";
      scene.tfm.max_packing = 0.62;
      scene.column.gravity = gravity;
      scene.inlet.superficial_velocity = {{0.0, viscosity < 1e3 ? 0.03 : 1e-6}};
      scene.bed.static_height = 0.03;
      scene.bed.start_solids_fraction = 0.5;
      const double slip_time = 1e-6 * 2200 / (18 * viscosity);
      const bool implicit = trial.treatment().integrator == "implicit";
      const auto run = trial.begin(scene);
      trial.advance(*run, implicit || trial.naive() ? 1.0 : std::min(1.0, 200 * slip_time));
    }
}

}  // namespace

std::vector<HardCase> demanding_cases() {
  const std::vector<Treatment> both{{"explicit", "limited", ""}, {"implicit", "limited", ""}};
  return {
      {"T11", "packed gas bed, step to 10 u_mf", {"drag_explicit"}, all_schemes(), piston},
      {"T12", "jet at 20 u_mf breaks the surface", {"divide_by_phi"}, all_schemes(), jet},
      {"T18", "twenty thousand steps in a closed column", {"jacobi_preconditioner"}, all_schemes(), many_steps},
      {"T20", "tolerances from 1e-1 to 1e-9", {}, all_schemes(), tolerances},
      {"T20 loose", "tolerance 1e-1", {}, both, [](Trial& trial) { beyond_tolerances(trial, 1e-1); }},
      {"T20 tight", "tolerance 1e-13", {}, both, [](Trial& trial) { beyond_tolerances(trial, 1e-13); }},
      {"T21", "five species", {"jacobi_preconditioner"}, all_schemes(), five_species},
      {"T24", "viscosity 1e-6 to 1e3 Pa s, with and without gravity", {"drag_explicit"}, all_schemes(), viscosities}};
}

}  // namespace polybed::hard
