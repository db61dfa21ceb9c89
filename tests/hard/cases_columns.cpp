// Hard cases of the column's ends, of its cells, and of beds that hardly move: T13, T15, T26.
#include <algorithm>
#include <cmath>

#include "closures/drag_cello.hpp"
#include "hard/cases.hpp"
#include "hard/scenes.hpp"
#include "scenes/manufactured_box.hpp"

namespace polybed::hard {

namespace {

constexpr double fine = 0.2e-3, excess = 1200, water = 1000, viscosity = 1e-3;

/// Slip, m/s, at which drag and the net pressure carry 0.2 mm spheres of 2200 kg/m3 in water at a voidage:
/// 18 mu f(eps, Re) w/D^2 = (rho_s - rho_f) g.
double slip_at(double eps) {
  double low = 0, high = 1;
  for (int n = 0; n < 100; ++n) {
    const double w = 0.5 * (low + high);
    (18 * viscosity * closures::DragCello{}(eps, water * eps * w * fine / viscosity).f * w < fine * fine * excess * 9.81
         ? low
         : high) = w;
  }
  return low;
}

/// The greatest flux of solids, m/s, that falls against a volume flux J: max over phi of phi (eps w - J). What is fed
/// beyond it cannot come down: the column floods.
double flooding_flux(double flux) {
  double most = 0;
  for (double phi = 0.001; phi < 0.5; phi += 0.001) most = std::max(most, phi * ((1 - phi) * slip_at(1 - phi) - flux));
  return most;
}

/// T13: solids are fed through a third of the top, fluid through the bottom, just below flooding, beyond it, below it
/// again; then the fluid is stepped beyond the velocity at which spheres fall, and shut. What the column cannot take
/// leaves through the rest of the top, where the velocity changes its sign.
void near_flooding(Trial& trial) {
  constexpr double flux = 0.010;
  const double flooding = flooding_flux(flux), falling = slip_at(1.0);
  core::Scene scene = uniform_bed(fine, water + excess, water, viscosity, 0.55, 24, 0.048);
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.max_packing = 0.62;
  scene.bed.static_height = 0.004;
  scene.column.cells[0] = 6;
  scene.column.size[0] = 0.012;
  scene.column.sides = core::Boundary::wall;
  scene.column.outlet = core::Outlet::open;
  scene.inlet.superficial_velocity = {{0, flux}, {6.02, flux}, {6.02, 1.2 * falling}, {7.02, 1.2 * falling}, {7.02, 0}};
  const double below = 3 * 0.95 * flooding, beyond = 3 * 1.3 * flooding;
  scene.feeds.push_back({"solid",
                         core::ColumnFace::top,
                         {{0, below}, {2.02, below}, {2.02, beyond}, {4.02, beyond}, {4.02, below}},
                         falling,
                         {0.004},
                         {0.008}});
  const auto run = trial.begin(scene);
  double out = 0, turns = 0, last_sign = 0;
  const core::Grid& grid = run->model().constants().grid;
  for (int n = 1; n <= 160; ++n) {
    trial.advance(*run, 0.05 * n, {.steps = n == 160});
    const fluid::Passed passed = run->model().passed()[0];
    trial.measure("solids that come in by the outlet", std::max(out - passed.out, 0.0), 0);
    out = passed.out;
    const double up = run->fields().solids.velocity[0][1][std::size_t(grid.index(0, grid.cells[1]))];
    turns += up * last_sign < 0 ? 1 : 0;
    last_sign = up;
  }
  // By hand: 2.02 s and then 3.98 s below, 2 s beyond, on a third of the width.
  const double fed = (6 * below + 2 * beyond) * 0.004 * grid.spacing[2];
  trial.measure("fed as prescribed", std::abs(run->model().passed()[0].in / fed - 1), 1e-9);
  trial.report("flooding flux, mm/s", 1e3 * flooding);
  trial.report("share of the feed that has left", out / fed);
  trial.report("changes of sign in a corner of the top", turns);
}

/// T15, a bed: cells twenty times as wide as high, and as high as wide, carry the weight.
void flat_and_tall_cells(Trial& trial) {
  for (const bool flat : {true, false}) {
    core::Scene scene = uniform_bed(1e-3, 2200, 998.207, 1.00157e-3, 0.58, flat ? 120 : 12, flat ? 0.12 : 0.24);
    scene.effects["solids_stress"] = "frictional";
    scene.tfm.max_packing = 0.62;
    scene.column.cells[0] = 6;
    scene.column.size[0] = flat ? 0.12 : 0.006;
    scene.column.sides = core::Boundary::wall;
    scene.bed.static_height = flat ? 0.04 : 0.08;
    scene.bed.start_solids_fraction = 0.4;
    scene.inlet.superficial_velocity = {{0.0, 0.03}};
    const auto run = trial.begin(scene);
    trial.advance(*run, 4, {.fluidised = true});
  }
}

/// T15, the order: every effect on, in a box of n by 20 n cells, after 20 ms: two solids of different velocities under
/// one pressure are ill-posed, and on cells as flat as these ripples grow e-fold in a millisecond. The grid is uniform:
/// stretching does not apply.
void order_on_flat_cells(Trial& trial) {
  constexpr double time = 0.02;
  const bool limited = trial.treatment().flux == "limited";
  const tfm::Scheme scheme = limited ? tfm::Scheme::limited : tfm::Scheme::upwind;
  const double wanted = 0.9 * (limited ? 2 : 1);
  scenes::Error last{};
  for (const int n : {8, 16, 32}) {
    const core::Scene scene = scenes::all_effects(scenes::liquid_bed, 2, {n, 20 * n, 1});
    const scenes::Error now = scenes::Driven(scene, scheme, scheme).error(time);
    const double fraction = std::log2(last.fraction / now.fraction), velocity = std::log2(last.velocity / now.velocity);
    last = now;
    if (n == 8) continue;
    trial.report("order of the fractions to " + std::to_string(n), fraction);
    trial.report("order of the velocities to " + std::to_string(n), velocity);
    trial.measure("order of the fractions, below 0.9 of the formal one", wanted - fraction, 0);
    trial.measure("order of the velocities, below 0.9 of the formal one", wanted - velocity, 0);
  }
}

/// Slope of a straight line through values at times, and how far it may be off: its standard error.
struct Slope {
  double value, error;
};

Slope slope_of(const std::vector<double>& time, const std::vector<double>& value) {
  const auto n = double(time.size());
  double mean_t = 0, mean = 0, tt = 0, tv = 0, vv = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    mean_t += time[k] / n;
    mean += value[k] / n;
  }
  for (std::size_t k = 0; k < time.size(); ++k) {
    tt += (time[k] - mean_t) * (time[k] - mean_t);
    tv += (time[k] - mean_t) * (value[k] - mean);
    vv += (value[k] - mean) * (value[k] - mean);
  }
  return {tv / tt, std::sqrt(std::max(vv / tt - tv * tv / (tt * tt), 0.0) / (n - 2))};
}

/// Drift of the centres of two species apart, m/s, over the second half of 20 s of a bed at a velocity.
Slope drift_apart(Trial& trial, double velocity) {
  core::Scene scene = two_species(72, 0.216, false);
  scene.column.cells[0] = 8;
  scene.column.size[0] = 0.024;
  scene.column.sides = core::Boundary::wall;
  scene.bed.static_height = 0.03;
  scene.bed.start_solids_fraction = 0.1;
  scene.inlet.superficial_velocity = {{0.0, velocity}};
  const auto run = trial.begin(scene);
  std::vector<double> time, apart;
  for (int n = 1; n <= 200; ++n) {
    trial.advance(*run, 0.1 * n, {.steps = false});
    if (n <= 100) continue;
    const measures::Profile profile = profile_of(*run);
    time.push_back(0.1 * n);
    apart.push_back(measures::centre(profile, 0).value_or(0) - measures::centre(profile, 1).value_or(0));
  }
  return slope_of(time, apart);
}

/// T26: within 0.1 % of the velocity at which the forces on both species balance, 35.88 mm/s by `polybed inversion` at
/// 20 degC. Nothing drives the species apart but what is left of start and eddies, and it is slow: a run that ends here
/// is not steady, and the drift, which the summary of a run tells, is seen above its scatter.
void near_inversion(Trial& trial) {
  for (const double part : {0.999, 1.0, 1.001}) {
    const Slope drift = drift_apart(trial, part * 35.88e-3);
    trial.report("drift at " + std::to_string(part) + ", um/s", 1e6 * drift.value);
    trial.report("+-", 1e6 * drift.error);
    trial.measure("three standard errors over the drift", 3 * drift.error / std::abs(drift.value), 1);
  }
}

}  // namespace

std::vector<HardCase> column_cases() {
  return {{"T13", "solids fed from above against fluid from below, near flooding", {}, all_schemes(), near_flooding},
          {"T15", "cells 20:1, flat and tall: a bed", {}, all_schemes(), flat_and_tall_cells},
          {"T15 order",
           "cells 20:1: order on a smooth solution",
           {},
           {{"explicit", "limited", ""}, {"explicit", "upwind", ""}},
           order_on_flat_cells},
          {"T26", "velocity within 0.1 % of inversion: not steady", {}, all_schemes(), near_inversion}};
}

}  // namespace polybed::hard
