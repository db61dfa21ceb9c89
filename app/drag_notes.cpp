#include "app/drag_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "closures/drag.hpp"
#include "closures/mixture.hpp"
#include "fluid/inlet.hpp"
#include "relevance/advised_drag.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/situation.hpp"

namespace polybed::app {

namespace {

/// Relative difference in the settled bed's drag between a partition and the mean law, at the inlet's velocity.
std::string partition_note(const core::Scene& scene, const relevance::FluidConstants& fluid) {
  const double velocity = polybed::fluid::Ramp(scene.inlet.superficial_velocity).greatest();
  std::vector<double> diameter;
  for (const core::Species& species : scene.species) diameter.push_back(species.diameter);
  const std::vector<double>& share = scene.bed.volume_share;
  if (share.size() != diameter.size() || !(scene.bed.solids_fraction > 0)) return "";
  const closures::DragLaw law = relevance::drag_law_of(scene);
  const double voidage = 1 - scene.bed.solids_fraction, mean = closures::sauter_diameter(share, diameter);
  std::vector<double> f(share.size()), slope(share.size()), slip(share.size(), velocity);
  closures::drag_of_mixture(law, voidage, share, diameter, slip, fluid.density, fluid.viscosity, f, slope);
  const double reynolds = fluid.density * velocity * mean / fluid.viscosity;
  const double deviation = closures::deviation_from_base(law, voidage, reynolds, share, diameter, f);
  if (!law.partition || std::abs(deviation) < 1e-9) return "";
  return fmt::format("drag of all species together: {:+.2f} % of the mean law {} in the settled bed, by {}",
                     100 * deviation, scene.drag().name, scene.partition().name);
}

/// For several species without a partition.
std::string sum_note(const core::Scene& scene, const std::string& named) {
  const auto laws = closures::drag_laws();
  if (scene.species.size() < 2 || std::none_of(laws.begin(), laws.end(), [&](const closures::DragLawInfo& law) {
        return law.name == named && !law.obeys_sum_rule;
      }))
    return "";
  const relevance::Survey survey = relevance::survey(scene);
  const std::string better = relevance::advised_drag(scene, survey.drag_scene).partition;
  const bool helps =
      core::is_law(better) && relevance::is_mean_law(named) && survey.mixture_part > scene.chooser.tolerance;
  return fmt::format(
      "drag = \"{}\" acts on each species by itself: in a mixture the sum of the drags is not that of the "
      "pressure drop, which is therefore not exact{}",
      named, helps ? fmt::format("; take partition = \"{}\"", better) : "");
}

}  // namespace

std::vector<std::string> notes_on_drag(const core::Scene& scene, const relevance::FluidConstants& fluid) {
  if (!scene.drag().given) return {"drag is off: nothing couples the solids to the fluid"};
  std::string note = scene.partition().given ? partition_note(scene, fluid) : sum_note(scene, scene.drag().name);
  return note.empty() ? std::vector<std::string>() : std::vector{std::move(note)};
}

}  // namespace polybed::app
