// Hard cases of fluidised beds: T4, T16, T22, T23.
#include <algorithm>
#include <cmath>

#include "closures/drag_cello.hpp"
#include "hard/cases.hpp"
#include "hard/scenes.hpp"

namespace polybed::hard {

namespace {

/// Force per volume that the exchange of momentum leaves over on a face, relative to what the solids get: the same
/// state evaluated with drag and without.
double exchange_left_over(const core::Scene& scene, const tfm::Model& model, const std::vector<double>& state) {
  core::Scene without = scene;
  without.effects.erase("drag");
  core::Timers timers;
  const tfm::StateLayout layout(model.constants().grid, int(model.constants().species()),
                                model.integrator_kind() == core::TfmIntegrator::implicit_steps);
  tfm::RightHandSide with_drag(scene, model.constants(), model.boundaries(), model.inlet(), {}, timers);
  tfm::RightHandSide no_drag(without, model.constants(), model.boundaries(), model.inlet(), {}, timers);
  if (!with_drag.evaluate(model.time(), layout, state) || !no_drag.evaluate(model.time(), layout, state)) return 1;
  const core::Grid& grid = model.constants().grid;
  const core::Index s = grid.stride(1);
  double worst = 0;
  core::for_each_row(grid, model.boundaries().moving_faces(1, false), [&](core::Index begin, core::Index end) {
    for (core::Index c = begin; c < end; ++c) {
      const auto f = std::size_t(c);
      double solids = 0;
      for (std::size_t j = 0; j < model.constants().species(); ++j)
        solids += core::face_mean(with_drag.fields().solids.fraction[j].data(), c, s) * model.constants().density[j] *
                  (with_drag.fields().solids.acceleration[j][1][f] - no_drag.fields().solids.acceleration[j][1][f]);
      const double fluid = core::face_mean(with_drag.fields().fluid.voidage.data(), c, s) *
                           model.constants().fluid.density *
                           (with_drag.fields().fluid_acceleration[1][f] - no_drag.fields().fluid_acceleration[1][f]);
      worst = std::max(worst, std::abs(solids + fluid) / std::max(std::abs(solids), 1.0));
    }
  });
  return worst;
}

/// T4: 1 mm steel in air, density ratio 6500, above minimum fluidisation: one row of cells for long enough to carry the
/// bed, and four rows, where drag relaxes eddies of the gas in 3e-5 s.
void steel_in_air(Trial& trial, bool balance) {
  core::Scene scene = uniform_bed(1e-3, 7800, 1.2, 1.8e-5, 0.58, 30, 0.15);
  scene.effects = {{"drag", "ergun"}, {"solids_stress", "frictional"}};
  scene.bed.static_height = 0.06;
  scene.bed.start_solids_fraction = 0.48;
  scene.inlet.superficial_velocity = {{0.0, 1.976}};  // carries 0.48 after Ergun, by hand: below the frictional onset
  if (balance) {
    const auto run = trial.begin(scene);
    trial.advance(*run, 8, {.fluidised = true});  // slugs leave momentum at either end of the mean: of 2 s up to 1 %
    return;
  }
  core::Scene wide = scene;
  wide.column.cells[0] = 4;
  wide.column.size[0] *= 4;
  const auto eddies = trial.begin(wide);
  trial.advance(*eddies, 0.02);
  const auto run = trial.begin(scene);
  trial.advance(*run, 1);
  if (trial.naive()) return;
  run->model().restart();
  trial.measure("V4 exchange sums to 0",
                exchange_left_over(scene, run->model(), run->model().checkpoint().arrays.at("state")), 1e-12);
}

/// Height of a bed of 1 mm glass in water after the inlet has followed a table.
double height_after(Trial& trial, const std::vector<std::pair<double, double>>& inlet, double until, double start) {
  core::Scene scene = uniform_bed(1e-3, 2200, 998.207, 1.00157e-3, 0.6, 40, 0.16);
  scene.effects["solids_stress"] = "frictional";
  scene.bed.static_height = 0.04;
  scene.bed.start_solids_fraction = start;
  scene.inlet.superficial_velocity = inlet;
  const auto run = trial.begin(scene);
  trial.advance(*run, until);
  return measures::bed_height(profile_of(*run)).value_or(0);
}

/// T16: the inlet is stepped up, shut, reversed and opened again; the bed ends where one ends that comes from below,
/// and where one ends that comes from above.
void stepped_inlet(Trial& trial) {
  const double end = 6;
  const double stepped = height_after(
      trial,
      {{0, 0.03}, {0.5, 0.03}, {0.5, 0.05}, {1, 0.05}, {1, 0}, {1.3, 0}, {1.3, -0.005}, {1.5, -0.005}, {1.5, 0.03}},
      end + 1.5, 0.5);
  const double from_below = height_after(trial, {{0, 0.03}}, end, 0.55);
  const double from_above = height_after(trial, {{0, 0.03}}, end, 0.30);
  trial.measure("the same bed after all that", std::abs(stepped / from_below - 1), 1e-3);
  trial.measure("the same bed from above", std::abs(from_above / from_below - 1), 1e-3);
}

/// T22: 1 kg/m3 heavier than the fluid; a bed of 1 mm spheres that starts at the force balance, f U/eps = D^2 (rho_s -
/// rho_f) g/(18 mu), with one in a hundred more in its upper half. Reported: what a relative change of the excess
/// density does to that of the density itself, the condition of anything found from the difference.
void nearly_neutral(Trial& trial) {
  constexpr double phi = 0.4, excess = 998.207e-3, diameter = 1e-3, viscosity = 1.00157e-3;
  const double stokes = diameter * diameter * excess * 9.81 / (18 * viscosity);
  double low = 0, high = stokes;
  for (int n = 0; n < 100; ++n) {
    const double u = 0.5 * (low + high);
    (u * closures::DragCello{}(1 - phi, 998.207 * u * diameter / viscosity).f < stokes * (1 - phi) ? low : high) = u;
  }
  trial.report("condition, d ln excess / d ln density", 1.001 / 0.001);
  core::Scene scene = uniform_bed(1e-3, 998.207 * 1.001, 998.207, 1.00157e-3, 0.4, 40, 0.08);
  scene.effects = {{"drag", "cello"}, {"solids_stress", "frictional"}};
  scene.tfm.max_packing = 0.62;
  scene.bed.static_height = 0.03;
  scene.inlet.superficial_velocity = {{0.0, low}};
  const auto run = trial.begin(scene, [&](tfm::Model& model) {
    set_fractions(model, [&](std::size_t, int k, double fraction) { return fraction * (k < 8 ? 1.0 : 1.01); });
  });
  trial.advance(*run, 10, {.fluidised = true});
}

/// Fractions of a bed of 1 mm spheres in water at the end of a run, from where it rests to where it does not; solids
/// heavier than water stand on the distributor, lighter ones hang under the screen at the top.
std::vector<double> bed_of(Trial& trial, double excess, double gravity, double inlet, double until, double fixed_step) {
  core::Scene scene = uniform_bed(1e-3, 998.207 + excess, 998.207, 1.00157e-3, 0.58, 30, 0.12);
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.max_packing = 0.62;
  scene.column.gravity = gravity;
  scene.inlet.superficial_velocity = {{0.0, inlet}};
  if (fixed_step > 0) scene.tfm.fixed_step = fixed_step;
  scene.tfm.pressure_tolerance = 1e-13;
  const bool hangs = excess * gravity < 0;
  const auto run = trial.begin(scene, [&](tfm::Model& model) {
    set_fractions(model, [&](std::size_t, int k, double) { return (hangs ? 29 - k : k) < 11 ? 0.5 : 0.0; });
  });
  trial.advance(*run, until, {.steps = fixed_step == 0});
  std::vector<double> phi = profile_of(*run).fraction[0];
  if (hangs) std::reverse(phi.begin(), phi.end());
  return phi;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

/// T23: a bed turned upside down is its mirror image, and solids lighter than the fluid by as much as others are
/// heavier end where those do. With steps of one length; the implicit integrator has none, and its Newton iteration
/// leaves rtol.
void light_solids(Trial& trial) {
  const double round_off = trial.treatment().integrator == "implicit" ? 1e-3 : 1e-12;
  trial.measure("V11 mirror image",
                farthest(bed_of(trial, 400, 9.81, 0.01, 0.5, 1e-3), bed_of(trial, 400, -9.81, -0.01, 0.5, 1e-3)),
                round_off);
  trial.measure("the bed that hangs is the bed that stands",
                farthest(bed_of(trial, 400, 9.81, 0.01, 4, 0), bed_of(trial, -400, 9.81, -0.01, 4, 0)), 1e-3);
}

}  // namespace

std::vector<HardCase> fluidised_cases() {
  return {{"T4",
           "steel in air, density ratio 6500",
           {"drag_explicit"},
           all_schemes(),
           [](Trial& trial) { steel_in_air(trial, false); }},
          {"T4 balance",
           "slugging steel in air: pressure drop against weight",
           {"advective_momentum"},
           all_schemes(),
           [](Trial& trial) { steel_in_air(trial, true); }},
          {"T16", "inlet stepped, shut, reversed, opened", {"clip_rhs"}, all_schemes(), stepped_inlet},
          {"T22", "density ratio 1.001", {}, all_schemes(), nearly_neutral},
          {"T23", "solids lighter than the fluid, downflow", {}, all_schemes(), light_solids}};
}

}  // namespace polybed::hard
