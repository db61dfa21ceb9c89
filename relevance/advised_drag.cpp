#include "relevance/advised_drag.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "closures/drag.hpp"
#include "closures/minimum_fluidisation.hpp"
#include "relevance/situation.hpp"

namespace polybed::relevance {

namespace {

using namespace std::string_view_literals;

// The data behind each law. A law in none of these lists suits any scene.
constexpr std::array of_one_sphere{"stokes"sv, "turton_levenspiel"sv, "schiller_naumann"sv, "dallavalle"sv};
constexpr std::array of_packed_beds{"carman_kozeny"sv, "ergun"sv, "fand"sv};
constexpr std::array of_held_spheres{"cello"sv,          "vbk"sv, "vbk_theory"sv, "vbk_corrected"sv, "yin_sundaresan"sv,
                                     "brinkman_oseen"sv, "hkl"sv};
constexpr std::array of_suspensions{"wen_yu"sv, "di_felice"sv, "richardson_zaki"sv};
constexpr std::array of_dilute_suspensions{"batchelor"sv};
constexpr std::array for_comparison{"syamlal"sv};

template <class List>
bool is_among(const List& list, const std::string& law) {
  return std::find(list.begin(), list.end(), law) != list.end();
}

/// Whether the inlet lifts any of the species, from the correlation of Wen and Yu, which needs no law of the case.
bool is_lifted(const core::Scene& scene, const Survey& survey) {
  return std::any_of(scene.species.begin(), scene.species.end(), [&](const core::Species& s) {
    return survey.greatest_velocity >= closures::minimum_fluidisation(s.diameter, s.density - survey.fluid_density,
                                                                      survey.fluid_density, survey.viscosity,
                                                                      scene.column.gravity);
  });
}

bool has_sizes(const core::Scene& scene) {
  return std::any_of(scene.species.begin(), scene.species.end(),
                     [&](const core::Species& s) { return s.diameter != scene.species.front().diameter; });
}

}  // namespace

DragScene drag_scene_of(const core::Scene& scene, const Survey& survey) {
  constexpr double alone = 0.01;  // solids fraction
  if (scene.bed.held) return DragScene::fixed;
  if (survey.solids_fraction < alone) return DragScene::lone;
  const bool packed = survey.solids_fraction >= scene.bed.solids_fraction && scene.bed.solids_fraction > 0;
  if (packed && !is_lifted(scene, survey)) return DragScene::fixed;
  return survey.is_gas ? DragScene::gas_bed : DragScene::liquid_bed;
}

AdvisedDrag advised_drag(const core::Scene& scene, DragScene kind) {
  const bool sizes = has_sizes(scene);
  const std::string shares = sizes ? "brinkman_oseen" : "none";
  switch (kind) {
    case DragScene::lone:
      return {"turton_levenspiel"};
    case DragScene::fixed:
      return {"brinkman_oseen"};
    case DragScene::gas_bed:
      return {"gidaspow", shares};
    case DragScene::liquid_bed:
      return {sizes ? "wen_yu" : "richardson_zaki", shares};
  }
  return {};
}

std::vector<std::string> laws_of_beds(DragScene kind) {
  if (kind == DragScene::liquid_bed) return {of_suspensions.begin(), of_suspensions.end()};
  if (kind == DragScene::gas_bed) return {"gidaspow", "wen_yu", "hkl"};
  return {};
}

std::string unsuited(const std::string& law, DragScene kind) {
  if (is_among(of_one_sphere, law) && kind != DragScene::lone)
    return law + " is made for one sphere: it ignores the neighbours";
  if (is_among(of_dilute_suspensions, law) && kind != DragScene::lone)
    return law + " is made for dilute suspensions, below a solids fraction of 0.05";
  if (is_among(of_packed_beds, law) && kind != DragScene::fixed)
    return law + " is made for packed beds, not for open ones";
  if (is_among(of_held_spheres, law) && kind == DragScene::liquid_bed)
    return law + " is made for held spheres: liquid beds rise too high";
  if (is_among(of_suspensions, law) && kind == DragScene::fixed)
    return law + " is made for suspended spheres, not for packed ones";
  return "";
}

bool serves_comparison(const std::string& law) { return is_among(for_comparison, law); }

bool ignores_neighbours(const std::string& law) { return is_among(of_one_sphere, law); }

bool is_mean_law(const std::string& law) {
  const auto laws = closures::drag_laws();
  return std::any_of(laws.begin(), laws.end(), [&](const auto& one) { return one.name == law && one.is_mean; });
}

AdvisedDrag drag_taken(const core::Scene& scene, const Survey& survey) {
  const bool named = core::is_law(scene.drag().name);
  const AdvisedDrag advised = advised_drag(scene, drag_scene_of(scene, survey));
  AdvisedDrag taken{named ? scene.drag().name : advised.law};
  const std::string partition = scene.partition().name;
  if (core::is_law(partition))
    taken.partition = partition;
  else if (partition == core::automatic && is_mean_law(taken.law))
    taken.partition = advised.partition;
  return taken;
}

}  // namespace polybed::relevance
