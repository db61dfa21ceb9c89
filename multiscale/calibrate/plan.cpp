#include "multiscale/calibrate/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/mixture.hpp"
#include "closures/stress_reference.hpp"
#include "core/case/file.hpp"
#include "core/error.hpp"
#include "fluid/solids_table.hpp"

namespace polybed::multiscale {

namespace {

std::vector<double> axis(const std::vector<double>& given, std::vector<double> usual, const char* key) {
  std::vector<double> values = given.empty() ? std::move(usual) : given;
  for (std::size_t n = 1; n < values.size(); ++n)
    if (!(values[n] > values[n - 1])) throw core::CaseError(fmt::format("calibrate.{} must rise", key));
  return values;
}

TableAxes axes_of(const core::Scene& scene, const std::string& regime) {
  const core::Calibrate& c = scene.calibrate;
  const bool sheared = regime != "bed";
  const fluid::TablePlace of_case = fluid::place_of(scene);
  TableAxes a;
  a.phi = axis(c.solids_fraction,
               sheared ? std::vector{0.1, 0.2, 0.3, 0.4, 0.45, 0.5} : std::vector{0.2, 0.3, 0.4, 0.45, 0.5},
               "solids_fraction");
  a.stokes = regime == "wet" ? axis(c.stokes, {1, 3, 10}, "stokes") : std::vector{0.0};
  a.restitution =
      regime == "dry" ? axis(c.restitution, {of_case.restitution}, "restitution") : std::vector{of_case.restitution};
  a.friction = sheared ? axis(c.friction, {of_case.friction}, "friction") : std::vector{of_case.friction};
  a.share = sheared ? axis(c.share, {0}, "share") : std::vector{0.0};
  if (a.phi.size() < 2) throw core::CaseError("calibrate.solids_fraction: a table needs two of them or more");
  if (!c.share.empty() && scene.species.size() != 2)
    throw core::CaseError(fmt::format("calibrate.share is of two species, the case has {}", scene.species.size()));
  for (const double mu : a.friction)
    if (sheared && a.phi.back() > closures::jamming_fraction(mu) - 0.02)
      throw core::CaseError(
          fmt::format("calibrate.solids_fraction = {:g}: spheres of friction {:g} jam at {:.3f}; a sheared box stays "
                      "0.02 below",
                      a.phi.back(), mu, closures::jamming_fraction(mu)));
  for (const double e : a.restitution)
    for (const double mu : a.friction)
      if (regime == "dry" && !(e < 1 && closures::effective_restitution(e, mu) > 0))
        throw core::CaseError(
            "calibrate.restitution: a dry box needs less than 1, and e - 1.5 mu exp(-3 mu) above 0 of its friction");
  return a;
}

/// As calibrate.regime says, or by the numbers of the scene.
fluid::Regime regime_of(const core::Scene& scene) {
  const core::BoxRegime given = scene.calibrate.regime;
  if (!scene.fluid.present() && (given == core::BoxRegime::wet || given == core::BoxRegime::bed))
    throw core::CaseError(
        fmt::format("calibrate.regime = \"{}\" needs a fluid: fluid.name is \"none\"", core::name_of(given)));
  fluid::Regime regime = fluid::shear_regime(scene);
  if (given == core::BoxRegime::bed) {
    regime.name = core::name_of(given);
    regime.reason = "as the case says";
  }
  if (regime.name.empty())
    throw core::CaseError("calibrate.regime = \"auto\" needs inlet.superficial_velocity, or say dry or wet");
  return regime;
}

}  // namespace

Plan plan_of(const core::Scene& scene) {
  if (scene.bed.volume_share.size() != scene.species.size())
    throw core::CaseError(
        fmt::format("calibrate needs bed.volume_share; bed.start = \"{}\" has none", text_of(scene.bed.start)));
  Plan plan{regime_of(scene), {}, !scene.calibrate.share.empty()};
  plan.axes = axes_of(scene, plan.regime.name);
  for (const double x : plan.axes.share)
    if (plan.binary && !(x > 0 && x < 1))
      throw core::CaseError("calibrate.share: both species have to be there, above 0 and below 1");
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
  // Counted up when such a box would be measured in another way.
  const int method = point.regime == "bed" || point.pushed ? 4 : 3;
  core::Scene box = scene_of_box(scene, point);
  return core::text_hash(fmt::format("{} {} {} {} {} {}{}\n{}", method, point.seed, c.strain, c.discard_strain,
                                     c.doublings, c.softness, point.pushed ? " pushed" : "", core::resolved_case(box)));
}

}  // namespace polybed::multiscale
