// Hard cases of beds that settle and rest: T1, T2, T3, T17.
#include <fmt/format.h>

#include <cmath>

#include "hard/cases.hpp"
#include "hard/scenes.hpp"

namespace polybed::hard {

namespace {

/// Height of the bed after 1 s of settling; the freeboard holds `trace` of both species, the fine one is absent from
/// the lower half of the bed, the coarse one from the upper half.
double height_after_settling(Trial& trial, double trace) {
  core::Scene scene = two_species(50, 0.1, true);
  scene.bed.start = {core::StartKind::layered};
  scene.bed.static_height = 0.02;
  scene.bed.start_solids_fraction = 0.3;
  const auto run = trial.begin(scene, [&](tfm::Model& model) {
    // Down from the trace at the surface of the bed to exactly nothing at the top of the column.
    set_fractions(model,
                  [&](std::size_t, int k, double phi) { return phi > 0 || k > 45 ? phi : trace * (1 - k / 45.0); });
  });
  trial.advance(*run, 1.0);
  return measures::bed_height(profile_of(*run)).value_or(0);
}

/// T1: what stands in the freeboard, from 1e-16 to 1e-8, does not matter.
void vanishing_phases(Trial& trial) {
  const double none = height_after_settling(trial, 0);
  for (const double trace : {1e-16, 1e-8})
    trial.measure("height does not see the freeboard", std::abs(height_after_settling(trial, trace) / none - 1), 1e-4);
}

/// T2: an empty species beside another changes nothing. With steps of one length; the implicit integrator has none, and
/// its error norm changes with the number of fields: there the limit is what rtol lets through in 100 steps.
void empty_species(Trial& trial) {
  core::Scene one = uniform_bed(0.807e-3, 1395, 998.207, 1.00157e-3, 0.62, 40, 0.08);
  one.column.closed = true;
  one.effects = {{"drag", "cello"}, {"solids_stress", "frictional"}, {"species_exchange", "syamlal"}};
  one.bed.static_height = 0.03;
  one.bed.start_solids_fraction = 0.4;
  one.tfm.fixed_step = 1e-3;
  one.tfm.pressure_tolerance = 1e-13;
  core::Scene two = one;
  two.species.push_back(two.species[0]);
  two.species[1].name = "none";
  two.species[1].diameter = 2e-3;
  two.species[1].density = 1170;
  two.bed.volume_share.push_back(0);
  const auto a = trial.begin(one);
  trial.advance(*a, 0.3, {.steps = false});
  const std::vector<double> alone = profile_of(*a).fraction[0];
  const auto b = trial.begin(two);
  trial.advance(*b, 0.3, {.steps = false});
  const std::vector<double> beside = profile_of(*b).fraction[0];
  double apart = 0;
  for (std::size_t k = 0; k < alone.size(); ++k) apart = std::max(apart, std::abs(alone[k] - beside[k]));
  trial.measure("equal to the bed of one species", apart,
                trial.treatment().integrator == "implicit" ? 100 * one.tfm.rtol : 1e-12);
}

/// Glass in water, 1.2 mm, in a closed column.
core::Scene closed_column(int cells, double height) {
  core::Scene scene = uniform_bed(1.2e-3, 2700, 998.207, 1.00157e-3, 0.6, cells, height);
  scene.column.closed = true;
  scene.effects["solids_stress"] = "frictional";
  return scene;
}

/// T3: a suspension settles to the maximum packing, and the bed is held; at the end it should be at rest.
void settle_and_hold(Trial& trial, double until, bool rests) {
  core::Scene scene = closed_column(20, 0.1);
  scene.bed.static_height = 0.05;
  scene.bed.start_solids_fraction = 0.35;
  const auto run = trial.begin(scene);
  trial.advance(*run, until, {.settles = true, .rests = rests});
}

/// Height of a settled bed of which the topmost cell, too, carries its own weight: near a height, m.
double height_at_rest(core::Scene& scene, double near) {
  scene.bed.static_height = near;
  core::Timers timers;
  const tfm::Model model(scene, timers);
  const tfm::StressEffect& stress = *model.effects().solids_stress;
  scene.tfm.max_packing = stress.max_packing();
  const double dy = model.constants().grid.spacing[1], weight = (2700 - 998.207) * 9.81 * dy;
  double phi = 0, carried = 0, solids = 0;
  while (solids < near * scene.bed.solids_fraction) {
    double low = 0.5, high = 0.7;
    for (int n = 0; n < 200; ++n) {
      const double here = 0.5 * (low + high);
      (stress.pressure_at(here) < carried + 0.5 * (here + phi) * weight ? low : high) = here;
    }
    phi = 0.5 * (low + high);
    carried = stress.pressure_at(phi);
    solids += phi * dy;
  }
  return solids / scene.bed.solids_fraction;
}

/// T17: a settled bed, restarted after some steps, stays at rest.
void rest_and_restart(Trial& trial) {
  core::Scene scene = closed_column(20, 0.2);
  scene.bed.start = {core::StartKind::settled};
  scene.bed.static_height = height_at_rest(scene, 0.15);
  scene.tfm.fixed_step = 5e-4;  // half of what the elastic waves allow
  const auto run = trial.begin(scene);
  trial.advance(*run, 0.5, {.rests_always = true});
  run->restart();
  trial.advance(*run, 1.0, {.rests_always = true});
}

}  // namespace

std::vector<HardCase> settling_cases() {
  return {{"T1", "fractions of 1e-16 to 0 in the freeboard", {"divide_by_phi"}, all_schemes(), vanishing_phases},
          {"T2", "an empty species beside another", {"divide_by_phi composition"}, all_schemes(), empty_species},
          {"T3",
           "settle to the maximum packing and hold",
           {"hard_packing", "jacobi_preconditioner"},
           all_schemes(),
           [](Trial& trial) { settle_and_hold(trial, 4, false); }},
          {"T3 rest",
           "settle to the maximum packing, then rest",
           {},
           all_schemes(),
           // A thin layer on top presses the cell below it together by little at a time: speeds fall by 2/s, by 1.3/s
           // with first-order fluxes, which lift more solids for the motion to pay for.
           [](Trial& trial) { settle_and_hold(trial, 24, true); }},
          {"T17", "a settled bed, restarted at rest", {"unbalanced_gravity"}, all_schemes(), rest_and_restart}};
}

}  // namespace polybed::hard
