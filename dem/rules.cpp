#include "dem/rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/case/resolve.hpp"
#include "dem/effects/maker.hpp"
#include "dem/holes.hpp"
#include "dem/scene.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::dem {

namespace {

bool discharges_below(const core::Scene& scene) {
  return std::any_of(scene.discharges.begin(), scene.discharges.end(),
                     [](const core::Discharge& d) { return d.at == core::ColumnFace::bottom; });
}

core::Broken blocked_discharges(const core::Scene& scene) {
  core::Broken broken;
  if (scene.bed.held) return broken;
  const double largest = core::largest_diameter(scene);
  for (const Hole& hole : rectangles_of(scene, bare_box_of(scene.column))) {
    const Vector& half = hole.opening.half;
    if (2 * *std::min_element(half.begin(), half.end()) < largest * (1 - 1e-12))
      broken.add({std::to_string(hole.discharge + 1), fmt::format("{:.4g}", largest)}, hole.discharge);
  }
  return broken;
}

core::Broken discharges_that_touch(const core::Scene& scene) {
  core::Broken broken;
  if (scene.bed.held || scene.discharges.empty()) return broken;
  for (const auto& [a, b] : touching_holes(scene, bare_box_of(scene.column)))
    broken.add({std::to_string(a + 1), std::to_string(b + 1)}, b);
  return broken;
}

/// What dem.own_share = "removed" does not know yet, in a fluid.
core::Rule with_own_share(const std::string& key, const std::string& what, bool (*is)(const core::Scene&)) {
  return {
      {key, "fluid.name", "dem.own_share"},
      what + " and dem.own_share = \"removed\" cannot be combined yet; use dem.own_share = \"kept\"",
      [is](const core::Scene& scene) {
        return core::broken_if(scene.fluid.present() && scene.dem.own_share == core::OwnShare::removed && is(scene));
      }};
}

}  // namespace

std::vector<core::Rule> key_rules() {
  const std::vector<core::Rule> own{
      {{"dem.held", "fluid.name", "effects.drag"},
       "dem.held = true without drag: nothing resists the flow through the bed; name a law in effects.drag",
       [](const core::Scene& scene) {
         return core::broken_if(scene.bed.held && scene.fluid.present() && !scene.drag().given);
       }},
      {{"dem.kernel_width", "dem.kernel"},
       "dem.kernel_width cannot act: dem.kernel = \"bilinear\" has the width of the cells; use \"diffusion\" or "
       "\"auto\"",
       [](const core::Scene& scene) {
         return core::broken_if(scene.dem.kernel == core::Kernel::bilinear && scene.dem.kernel_width.has_value());
       }},
      {{"column.pressure_gradient", "dem.greatest_speed", "dem.fixed_step", "column.ends"},
       "column.pressure_gradient = {} Pa/m: the speed that it gives to particles is unknown and sets their step: give "
       "dem.greatest_speed",
       [](const core::Scene& scene) {
         const double* given = std::get_if<double>(&scene.column.pressure_gradient);
         if (!scene.flows_around() || given == nullptr || scene.bed.held || scene.dem.greatest_speed ||
             scene.dem.fixed_step)
           return core::Broken();
         return core::Broken({fmt::format("{:g}", *given)});
       }},
      with_own_share("column.shape", "column.shape = \"cylinder\"",
                     [](const core::Scene& scene) { return scene.column.is_round(); }),
      with_own_share("column.grading", "column.grading",
                     [](const core::Scene& scene) { return scene.column.grading.has_value(); }),
      {{"column.grading_across"},
       "column.grading_across: polybed tfm can run it, polybed dem cannot yet",
       [](const core::Scene& scene) { return core::broken_if(scene.column.grading_across.has_value()); }},
      with_own_share("wall.shape", "[[wall]]", [](const core::Scene& scene) { return !scene.walls.empty(); }),
      {{"wall.shape", "fluid.name", "column.shape"},
       "[[wall]] in a round column with a fluid: polybed tfm can run it, polybed dem cannot yet",
       [](const core::Scene& scene) {
         return core::broken_if(!scene.walls.empty() && scene.fluid.present() && scene.column.is_round());
       }},
      {{"wall.shape", "fluid.name", "bed.start"},
       "[[wall]] in a fluid and bed.start = \"list:FILE\" or \"checkpoint:FILE\" cannot be combined yet in polybed "
       "dem: particles could begin inside a wall; use \"mixed\"",
       [](const core::Scene& scene) {
         const core::StartKind kind = scene.bed.start.kind;
         return core::broken_if(!scene.walls.empty() && scene.fluid.present() &&
                                (kind == core::StartKind::list || kind == core::StartKind::checkpoint));
       }},
  };
  return relevance::joined({rules_of_keys(), own, feed_rules()});
}

const std::vector<core::Rule>& model_rules() {
  static const std::vector<core::Rule> all{
      {{"column.shape"},
       "column.shape = \"axisymmetric\": polybed tfm can run it, polybed dem cannot: particles go around the axis; use "
       "\"cylinder\"",
       [](const core::Scene& scene) { return core::broken_if(scene.column.around_axis()); }},
      {{"discharge.at", "column.shape", "wall.shape"},
       "discharge.at = \"bottom\" in a round column or under a round wall: polybed tfm can run it, polybed dem cannot: "
       "particles leave through the top, by column.outlet = \"open\", or without a fluid through dem.opening",
       [](const core::Scene& scene) {
         const bool walls =
             std::any_of(scene.walls.begin(), scene.walls.end(), [](const auto& w) { return w.is_round(); });
         return core::broken_if(!scene.bed.held && (scene.column.is_round() || walls) && discharges_below(scene));
       }},
      {{"discharge.from", "discharge.to", "discharge.at", "species.diameter", "column.size"},
       "[[discharge]] number {}: the largest particle, of {} m, must fit through: move discharge.from and discharge.to "
       "apart",
       blocked_discharges},
      {{"discharge.from", "discharge.to", "discharge.at", "column.size", "column.cells"},
       "[[discharge]] number {} and {} touch but do not form one rectangle: polybed tfm can run it, polybed dem "
       "cannot, "
       "as particles would meet a rim there; make them one, or move them apart",
       discharges_that_touch},
      {{"discharge.at", "fluid.name", "fluid.equation_of_state"},
       "[[discharge]] in a compressible fluid: polybed tfm can run it, polybed dem cannot: the mass of the fluid that "
       "takes the place of a particle as it leaves would be missing; use fluid.equation_of_state = \"incompressible\"",
       [](const core::Scene& scene) {
         return core::broken_if(!scene.discharges.empty() && !scene.bed.held && scene.fluid.present() &&
                                scene.fluid.compressible());
       }},
      {{"column.outlet", "fluid.name", "fluid.equation_of_state"},
       "column.outlet = \"open\" in a compressible fluid: polybed tfm can run it, polybed dem cannot: the mass of the "
       "fluid that takes the place of a particle as it leaves would be missing; use fluid.equation_of_state = "
       "\"incompressible\"",
       [](const core::Scene& scene) {
         return core::broken_if(scene.column.outlet == core::Outlet::open && scene.fluid.present() &&
                                scene.fluid.compressible());
       }},
      {{"feed.species", "fluid.name", "fluid.equation_of_state"},
       "[[feed]] in a compressible fluid: polybed tfm can run it, polybed dem cannot: the mass of the fluid that a "
       "particle displaces as it enters would be lost; use fluid.equation_of_state = \"incompressible\"",
       [](const core::Scene& scene) {
         return core::broken_if(!scene.feeds.empty() && scene.fluid.present() && scene.fluid.compressible());
       }}};
  return all;
}

}  // namespace polybed::dem
