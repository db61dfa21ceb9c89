#include "tfm/step_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "closures/bed_expansion.hpp"
#include "closures/drag.hpp"
#include "closures/drag_schiller_naumann.hpp"
#include "closures/mixture.hpp"
#include "closures/terminal_velocity.hpp"
#include "relevance/drag_law.hpp"
#include "tfm/effects/solids_stress_frictional.hpp"
#include "tfm/fast_drag.hpp"

namespace polybed::tfm {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// 1/s: relaxation of the fastest species' slip while all species drag the fluid along; and the slow relaxation that
/// remains in steps with implicit drag.
struct DragRates {
  double whole = 0, slow = 0;
};

DragRates drag_rates(const Constants& constants, const closures::DragLaw& law, const UniformBed& bed) {
  const double eps = 1 - bed.solids_fraction;
  const std::size_t n = constants.species();
  std::vector<double> slip(n, bed.velocity), f(n), slope(n);
  closures::drag_of_mixture(law, eps, constants.bed_share, constants.diameter, slip, constants.fluid.density,
                            constants.fluid.viscosity, f, slope);
  double on_fluid = 0, own = 0;
  SlowDrag slow(eps, constants.fluid.density);
  for (std::size_t j = 0; j < n; ++j) {
    const double b = 18 * constants.fluid.viscosity * eps * f[j] / (constants.diameter[j] * constants.diameter[j]);
    on_fluid += constants.bed_share[j] * bed.solids_fraction * b / (eps * constants.fluid.density);
    own = std::max(own, b / constants.density[j]);
    slow.add(constants.bed_share[j] * bed.solids_fraction, b, constants.density[j]);
  }
  return {own + on_fluid, slow.rate()};
}

/// dp_s/dphi by a central difference: the slot Stress provides only the pressure.
double stress_slope(const StressEffect& stress, double solids_fraction) {
  constexpr double delta = 1e-5;
  return std::max(
      0.0, (stress.pressure_at(solids_fraction + delta) - stress.pressure_at(solids_fraction - delta)) / (2 * delta));
}

}  // namespace

double mean_density(const Constants& constants) {
  return std::inner_product(constants.density.begin(), constants.density.end(), constants.bed_share.begin(), 0.0);
}

double terminal_velocity(const Constants& constants, std::size_t species) {
  return closures::settling_velocity(constants.diameter[species], constants.density[species] - constants.fluid.density,
                                     constants.fluid.density, constants.fluid.viscosity, constants.gravity,
                                     constants.shape.empty() ? closures::ShapeFactor() : constants.shape[species]);
}

double greatest_terminal_velocity(const Constants& constants) {
  double greatest = 0;
  for (std::size_t j = 0; j < constants.species(); ++j) greatest = std::max(greatest, terminal_velocity(constants, j));
  return greatest;
}

double expanded_fraction(const Constants& constants, const closures::DragLaw& law, double velocity, double packed) {
  const double excess = mean_density(constants) - constants.fluid.density;
  if (!(excess * constants.gravity > 0)) return 0;
  const double diameter = closures::sauter_diameter(constants.bed_share, constants.diameter);
  const auto f = [&](double eps, double re) { return closures::pure_drag_at(law, eps, re); };
  const closures::CarriedBed bed{diameter, excess, constants.fluid.density, constants.fluid.viscosity,
                                 constants.gravity};
  return 1 - closures::carried_voidage(f, bed, velocity, 1 - packed);
}

std::vector<TimeScale> time_scales_of_bed(const core::Scene& scene, const Constants& constants, const Effects& effects,
                                          const UniformBed& bed, bool split) {
  const double h = constants.grid.smallest_spacing();
  const auto scale = [](double rate) { return rate > 0 ? 1 / rate : infinite; };
  const double speed = std::max(bed.velocity / (1 - bed.solids_fraction), greatest_terminal_velocity(constants));
  std::vector<TimeScale> scales{{"convection", scale(speed / h), 0}};
  if (effects.drag && scene.drag().given) {
    const DragRates drag = drag_rates(constants, relevance::drag_law_of(scene), bed);
    scales.push_back({"drag", scale(split ? drag.slow : drag.whole), 0});
  }
  if (effects.solids_stress) {
    const double wave = std::sqrt(stress_slope(*effects.solids_stress, bed.solids_fraction) / mean_density(constants));
    scales.push_back({"acoustics", scale(wave / h), 0});
    const double alpha = bulk_viscosity_of(scene, constants.grid);
    scales.push_back({"bulk viscosity", scale(2 * constants.grid.dimensions * alpha * wave / h), 0});
  }
  if (effects.fluid_stress)
    scales.push_back(
        {"viscosity", scale(4 * constants.grid.dimensions * effects.fluid_stress->kinematic_viscosity() / (h * h)), 0});
  return scales;
}

double explicit_step(const std::vector<TimeScale>& scales) {
  constexpr double share = 1.4;
  double shortest = infinite;
  for (const TimeScale& scale : scales) shortest = std::min(shortest, scale.seconds);
  return share * shortest;
}

namespace {

/// Time for convection and fall of solids through a cell, s, at a tolerance; steps scale with its cubic root.
/// \param free  solids fall freely, as in a stream that lifts them; else at most as fast as a lone particle
double accurate_step(const Constants& constants, double velocity, double rtol, double share, bool free) {
  constexpr double measured_at = 1e-3;
  const double h = constants.grid.smallest_spacing();
  const double pull = constants.gravity * std::abs(1 - constants.fluid.density / mean_density(constants));
  const double fall = std::sqrt(pull / h), lone = greatest_terminal_velocity(constants) / h;
  const double rate = std::abs(velocity) / h + (free ? fall : std::min(fall, lone));
  return rate > 0 ? share / rate * std::cbrt(rtol / measured_at) : infinite;
}

constexpr double implicit_share = 0.5, split_share = 0.75;

}  // namespace

double implicit_step(const Constants& constants, double velocity, double rtol) {
  return accurate_step(constants, velocity, rtol, implicit_share, velocity != 0);
}

double split_step(const Constants& constants, const std::vector<TimeScale>& scales, double velocity, double rtol) {
  return std::min(explicit_step(scales), accurate_step(constants, velocity, rtol, split_share, velocity != 0));
}

double split_steps_per_implicit(const core::Scene& scene, const Constants& constants, const Effects& effects,
                                double velocity) {
  const double rest = scene.bed.solids_fraction;
  const double phi = !effects.drag ? rest : expanded_fraction(constants, relevance::drag_law_of(scene), velocity, rest);
  const std::vector<TimeScale> scales = time_scales_of_bed(scene, constants, effects, {phi, velocity}, true);
  const double inside = velocity / (1 - phi), rtol = scene.tfm.rtol;  // solids that fall together overturn the fluid
  return accurate_step(constants, inside, rtol, implicit_share, true) /
         std::min(explicit_step(scales), accurate_step(constants, inside, rtol, split_share, true));
}

}  // namespace polybed::tfm
