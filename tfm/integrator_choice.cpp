// The integrator for a scene.
#include <fmt/format.h>

#include "core/error.hpp"
#include "relevance/fluid_properties.hpp"
#include "tfm/rules.hpp"
#include "tfm/step_estimate.hpp"
#include "tfm/stepping.hpp"

namespace polybed::tfm {

namespace {

IntegratorChoice cheapest(const core::Scene& scene, const Constants& constants, const Effects& effects,
                          double greatest_inflow) {
  constexpr double dear_above = 1.5;
  using enum core::TfmIntegrator;
  if (effects.compressible) return {implicit_steps, "compressible: sound is faster than anything that matters"};
  if (constants.fluid.density < relevance::lightest_liquid)
    return {implicit_steps, "gas: drag relaxes faster than anything moves"};
  if (scene.flows_around()) return {implicit_steps, "between joined ends the drag sets the mean flow, too"};
  if (scene.column.closed || greatest_inflow == 0) return {implicit_steps, "nothing flows in: the bed settles"};
  const double replaced = split_steps_per_implicit(scene, constants, effects, greatest_inflow);
  return {replaced > dear_above ? implicit_steps
          : effects.drag        ? split_steps
                                : explicit_steps,
          fmt::format("in a liquid, an implicit step for {:.1f} others", replaced)};
}

}  // namespace

IntegratorChoice choose_integrator(const core::Scene& scene, const Constants& constants, const Effects& effects,
                                   double greatest_inflow) {
  const IntegratorChoice choice = scene.tfm.integrator == core::TfmIntegrator::automatic
                                      ? cheapest(scene, constants, effects, greatest_inflow)
                                      : IntegratorChoice{scene.tfm.integrator, "as the case says"};
  if (choice.kind == core::TfmIntegrator::split_steps && (effects.compressible || !effects.drag))
    throw core::StartError(std::vector{scene.places.problem(
        {"tfm.integrator"}, fmt::format("tfm.integrator = \"imex\" takes the drag implicitly: it needs {}",
                                        effects.compressible ? "an incompressible fluid" : "a drag law"))});
  const std::string wrong = wrong_with_implicit_tolerance(scene.tfm.rtol);
  if (choice.kind == core::TfmIntegrator::implicit_steps && !wrong.empty())
    throw core::StartError(std::vector{
        scene.places.problem({"tfm.rtol", "tfm.integrator"},
                             fmt::format("tfm.rtol = {} with the implicit integrator: {}", scene.tfm.rtol, wrong))});
  return choice;
}

}  // namespace polybed::tfm
