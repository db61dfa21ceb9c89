#include "multiscale/calibrate/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "closures/mixture.hpp"
#include "closures/stress_reference.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::multiscale {

namespace {

using core::Broken;
using core::Calibrate;
using core::Scene;

std::vector<double> axis(const std::vector<double>& given, std::vector<double> usual) {
  return given.empty() ? std::move(usual) : given;
}

core::Rule must_rise(const std::string& key, std::vector<double> Calibrate::*axis) {
  return {{"calibrate." + key}, "calibrate." + key + " must rise", [axis](const Scene& scene) {
            const std::vector<double>& values = scene.calibrate.*axis;
            const auto falls = [](double a, double b) { return !(b > a); };
            return core::broken_if(std::adjacent_find(values.begin(), values.end(), falls) != values.end());
          }};
}

Broken regime_without_fluid(const Scene& scene) {
  const core::BoxRegime given = scene.calibrate.regime;
  const bool wet = given == core::BoxRegime::wet || given == core::BoxRegime::bed;
  return wet && !scene.fluid.present() ? Broken({std::string(core::name_of(given))}) : Broken();
}

Broken not_of_two_species(const Scene& scene) {
  if (scene.calibrate.share.empty() || scene.species.size() == 2) return {};
  return Broken({std::to_string(scene.species.size())});
}

std::vector<core::Rule> share_rules() {
  return {
      {{"calibrate.share", "species.name"}, "calibrate.share is of two species, the case has {}", not_of_two_species},
      {{"calibrate.share"},
       "calibrate.share: both species have to be there, above 0 and below 1",
       [](const Scene& scene) {
         const std::vector<double>& share = scene.calibrate.share;
         return core::broken_if(std::any_of(share.begin(), share.end(), [](double x) { return !(x > 0 && x < 1); }));
       }},
      {{"calibrate.share", "calibrate.regime"},
       "calibrate.share cannot act: the fluidised boxes of calibrate.regime = \"bed\" have one size",
       [](const Scene& scene) {
         return core::broken_if(!scene.calibrate.share.empty() && scene.calibrate.regime == core::BoxRegime::bed);
       }}};
}

TableAxes axes_of(const core::Scene& scene, core::BoxRegime regime) {
  const core::Calibrate& c = scene.calibrate;
  const bool sheared = regime != core::BoxRegime::bed;
  const tfm::TablePlace of_case = tfm::place_of(scene);
  TableAxes a;
  a.phi = axis(c.solids_fraction,
               sheared ? std::vector{0.1, 0.2, 0.3, 0.4, 0.45, 0.5} : std::vector{0.2, 0.3, 0.4, 0.45, 0.5});
  a.stokes = regime == core::BoxRegime::wet ? axis(c.stokes, {1, 3, 10}) : std::vector{0.0};
  a.restitution =
      regime == core::BoxRegime::dry ? axis(c.restitution, {of_case.restitution}) : std::vector{of_case.restitution};
  a.friction = sheared ? axis(c.friction, {of_case.friction}) : std::vector{of_case.friction};
  a.share = sheared ? axis(c.share, {0}) : std::vector{0.0};
  for (const double mu : a.friction)
    if (sheared && a.phi.back() > closures::jamming_fraction(mu) - 0.02)
      throw core::CaseError(
          fmt::format("calibrate.solids_fraction = {:g}: spheres of friction {:g} jam at {:.3f}; a sheared box stays "
                      "0.02 below",
                      a.phi.back(), mu, closures::jamming_fraction(mu)));
  for (const double e : a.restitution)
    for (const double mu : a.friction)
      if (regime == core::BoxRegime::dry && !(e < 1 && closures::effective_restitution(e, mu) > 0))
        throw core::CaseError(
            "calibrate.restitution: a dry box needs less than 1, and e - 1.5 mu exp(-3 mu) above 0 of its friction");
  return a;
}

/// From calibrate.regime, or from the numbers of the scene.
tfm::Regime regime_of(const core::Scene& scene) {
  const core::BoxRegime given = scene.calibrate.regime;
  tfm::Regime regime = tfm::shear_regime(scene);
  if (given == core::BoxRegime::bed) {
    regime.kind = given;
    regime.reason = "as the case says";
  }
  if (regime.kind == core::BoxRegime::automatic)
    throw core::CaseError("calibrate.regime = \"auto\" needs inlet.superficial_velocity, or say dry or wet");
  return regime;
}

}  // namespace

std::vector<core::Rule> calibrate_rules() {
  std::vector<core::Rule> rules = share_rules();
  for (const auto& [key, axis] :
       {std::pair("solids_fraction", &Calibrate::solids_fraction), std::pair("stokes", &Calibrate::stokes),
        std::pair("restitution", &Calibrate::restitution), std::pair("friction", &Calibrate::friction),
        std::pair("share", &Calibrate::share)})
    rules.push_back(must_rise(key, axis));
  rules.push_back({{"calibrate.solids_fraction"},
                   "calibrate.solids_fraction: a table needs two of them or more",
                   [](const Scene& scene) { return core::broken_if(scene.calibrate.solids_fraction.size() == 1); }});
  rules.push_back({{"calibrate.regime", "fluid.name"},
                   "calibrate.regime = \"{}\" needs a fluid: fluid.name is \"none\"",
                   regime_without_fluid});
  return rules;
}

Plan plan_of(const core::Scene& scene) {
  core::refuse(calibrate_rules(), scene);
  if (scene.bed.volume_share.size() != scene.species.size())
    throw core::CaseError(
        fmt::format("calibrate needs bed.volume_share; bed.start = \"{}\" has none", text_of(scene.bed.start)));
  Plan plan{regime_of(scene), {}, !scene.calibrate.share.empty()};
  if (core::acts(scene, "shape") && !core::all_spheres(scene) && plan.regime.kind != core::BoxRegime::dry)
    throw core::CaseError("calibrate: boxes in a fluid are of spheres: set effects.shape = \"none\"");
  plan.axes = axes_of(scene, plan.regime.kind);
  return plan;
}

MeanSphere mean_sphere(const std::vector<core::Species>& species, const std::vector<double>& share) {
  std::vector<double> diameter;
  double density = 0;
  for (std::size_t j = 0; j < species.size(); ++j) {
    diameter.push_back(species[j].diameter);
    density += share[j] * species[j].density;
  }
  return {closures::sauter_diameter(share, diameter), density};
}

std::string box_hash(const core::Scene& scene, const BoxPoint& point) {
  const core::Calibrate& c = scene.calibrate;
  // Increase it when such a box is measured in another way.
  const int method = point.regime == core::BoxRegime::bed || point.pushed ? 4 : 3;
  core::Scene box = scene_of_box(scene, point);
  return core::text_hash(fmt::format("{} {} {} {} {} {}{}\n{}", method, point.seed, c.strain, c.discard_strain,
                                     c.doublings, c.softness, point.pushed ? " pushed" : "", core::resolved_case(box)));
}

}  // namespace polybed::multiscale
