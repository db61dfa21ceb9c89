#include "tfm/shear_regime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/bed_expansion.hpp"
#include "closures/drag.hpp"
#include "closures/lubrication.hpp"
#include "closures/relevance.hpp"
#include "closures/stress_reference.hpp"
#include "core/case/scene.hpp"
#include "core/error.hpp"
#include "fluid/inlet.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::tfm {

namespace {

closures::DragLaw law_of_scene(const core::Scene& scene) {
  if (!scene.drag().acts())
    throw core::CaseError("calibrate: particles in a fluid need a drag law: [effects] drag = ..., see polybed list");
  return relevance::with_shape(relevance::drag_law_named(scene.drag().name), scene);
}

/// Voidage at which drag balances the buoyant weight of one species alone, in [0.4, 0.99].
double floating_voidage(const core::Scene& scene, const closures::DragLaw& law, const core::Species& species,
                        const relevance::FluidConstants& fluid, double velocity) {
  const closures::CarriedBed bed{species.diameter, std::abs(species.density - fluid.density), fluid.density,
                                 fluid.viscosity, scene.column.gravity};
  const auto f = [&](double eps, double reynolds) { return closures::pure_drag_at(law, eps, reynolds); };
  return std::min(closures::carried_voidage(f, bed, velocity, 0.4), 0.99);
}

}  // namespace

RegimeNumbers regime_numbers(const core::Scene& scene, std::size_t species, double velocity, double voidage) {
  const core::Species& s = scene.species[species];
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const closures::DragLaw law = law_of_scene(scene).alone(species);
  RegimeNumbers n;
  n.species = s.name;
  n.velocity = velocity;
  n.voidage = voidage > 0 ? voidage : floating_voidage(scene, law, s, fluid, velocity);
  const double slip = velocity / n.voidage;
  n.shear_rate = closures::shear_rate_at_wall(slip, scene.column.size[0], s.diameter);
  n.stokes_least = closures::stokes_of_impact(s.density, fluid.density, s.diameter, 0.2 * slip, fluid.viscosity);
  n.stokes_most = 5 * n.stokes_least;
  n.stokes_of_shear = closures::stokes_of_shear(s.density, s.diameter, n.shear_rate, fluid.viscosity);
  const double reynolds = fluid.density * velocity * s.diameter / fluid.viscosity;
  n.shear_times_relaxation =
      n.shear_rate * closures::slip_relaxation_time(s.diameter, s.density, fluid.viscosity, n.voidage,
                                                    closures::pure_drag_at(law, n.voidage, reynolds));
  return n;
}

Regime shear_regime(const core::Scene& scene) {
  if (!scene.fluid.present()) return {core::BoxRegime::dry, "there is no fluid", {}};
  const core::BoxRegime given = scene.calibrate.regime;
  const bool sheared = given == core::BoxRegime::dry || given == core::BoxRegime::wet;
  Regime regime{sheared ? given : core::BoxRegime::automatic, "as the case says", {}};
  const double velocity = fluid::Ramp(scene.inlet.superficial_velocity).greatest();
  for (std::size_t j = 0; velocity > 0 && j < scene.species.size(); ++j)
    regime.numbers.push_back(regime_numbers(scene, j, velocity, 0));
  if (sheared || regime.numbers.empty()) return regime;
  const RegimeNumbers& most = *std::max_element(
      regime.numbers.begin(), regime.numbers.end(),
      [](const auto& a, const auto& b) { return a.shear_times_relaxation < b.shear_times_relaxation; });
  regime.kind = most.shear_times_relaxation >= 1 ? core::BoxRegime::dry : core::BoxRegime::wet;
  regime.reason = fmt::format(
      "shear rate x relaxation time (gamma tau_p) = {:.2g} of {}, {}; Stokes number of impacts (St*) = {:.2g} to "
      "{:.2g}",
      most.shear_times_relaxation, most.species, regime.kind == core::BoxRegime::dry ? "1 or more" : "below 1",
      most.stokes_least, most.stokes_most);
  return regime;
}

}  // namespace polybed::tfm
