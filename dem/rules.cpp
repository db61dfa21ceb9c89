#include "dem/rules.hpp"

#include "core/case/size_classes.hpp"
#include "dem/effects/maker.hpp"
#include "relevance/effect_rules.hpp"

namespace polybed::dem {

std::vector<core::Rule> key_rules() {
  const std::vector<core::Rule> own{
      {{"dem.held", "fluid.name", "effects.drag"},
       "dem.held = true without drag: nothing resists the flow through the bed; name a law in effects.drag",
       [](const core::Scene& scene) {
         return core::broken_if(scene.bed.held && scene.fluid.present() && !scene.effects.contains("drag"));
       }},
      {{"dem.kernel_width", "dem.kernel"},
       "dem.kernel_width cannot act: dem.kernel = \"bilinear\" has the width of the cells; use \"diffusion\" or "
       "\"auto\"",
       [](const core::Scene& scene) {
         return core::broken_if(scene.dem.kernel == core::Kernel::bilinear && scene.dem.kernel_width.has_value());
       }},
      {{"column.shape", "dem.own_share"},
       "column.shape = \"cylinder\" and dem.own_share = \"removed\" cannot be combined yet; use dem.own_share = "
       "\"kept\"",
       [](const core::Scene& scene) {
         return core::broken_if(scene.column.is_round() && scene.fluid.present() &&
                                scene.dem.own_share == core::OwnShare::removed);
       }}};
  return relevance::joined({rules_of_keys(), own, feed_rules()});
}

const std::vector<core::Rule>& model_rules() {
  static const std::vector<core::Rule> all{
      {{"column.shape"},
       "column.shape = \"axisymmetric\": polybed tfm can run it, polybed dem cannot: particles go around the axis; use "
       "\"cylinder\"",
       [](const core::Scene& scene) { return core::broken_if(scene.column.around_axis()); }},
      {{"feed.at"},
       "feed.at = \"{}\": polybed tfm can run it, polybed dem cannot: particles enter through the bottom or the top",
       [](const core::Scene& scene) {
         core::Broken broken;
         for (std::size_t n = 0; n < scene.feeds.size(); ++n)
           if (const core::ColumnFace at = scene.feeds[n].at; is_side(at))
             broken.add({std::string(core::name_of(at))}, core::entry_of(scene, scene.feeds, n));
         return broken;
       }},
      {{"discharge.at"},
       "[[discharge]]: polybed tfm can run it, polybed dem cannot: particles leave through the top, by column.outlet = "
       "\"open\", or without a fluid through dem.opening",
       [](const core::Scene& scene) { return core::broken_if(scene.fluid.present() && !scene.discharges.empty()); }},
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
