// Requirements of the initial particles: room, and numbers that set the time step.
#include <numeric>
#include <optional>

#include "core/error.hpp"
#include "core/numerics/blocks.hpp"
#include "dem/coupling/kernel.hpp"
#include "dem/joined_work.hpp"
#include "dem/packing.hpp"
#include "dem/rules.hpp"
#include "dem/scene.hpp"
#include "relevance/choice.hpp"

namespace polybed::dem {

namespace {

using core::Broken;
using core::Scene;

bool is_listed(const Scene& scene) { return scene.bed.start.kind == core::StartKind::list; }

/// The box and the materials of a scene with numbers of particles in the case; nothing without them, or if other rules
/// report their problems.
struct Counted {
  Box box;
  Materials materials;
};

std::optional<Counted> counted_start(const Scene& scene) {
  const core::Bed& bed = scene.bed;
  const std::size_t given = bed.particles.empty() ? bed.volume_share.size() : bed.particles.size();
  const bool placed = bed.start_solids_fraction > 0 || bed.start.kind == core::StartKind::random;
  if (is_listed(scene) || scene.species.empty() || given != scene.species.size() || !placed) return {};
  return Counted{box_of(scene), Materials(scene)};
}

Broken without_room(const Scene& scene) {
  const std::optional<Counted> start = counted_start(scene);
  const std::string wrong = start ? no_room_for(scene, start->materials, start->box) : "";
  return wrong.empty() ? Broken() : Broken({wrong});
}

/// Range of the forces in a scene beyond contact, m; nothing if they cannot be created, which other rules report.
std::optional<double> reach_of(const Scene& scene, const Materials& materials) {
  if (relevance::has_auto(scene)) return {};  // judged again after the choice
  try {
    return make_pair_laws(scene, materials).reach();
  } catch (const core::CaseError&) {
    return {};
  }
}

/// \param axis  of the box
core::Rule room_for_images(const std::string& key, std::initializer_list<std::size_t> axes) {
  std::vector<std::string> keys{key};
  for (const char* other : {"column.", "wall.", "fluid.", "species.", "dem.", "contact_pair.", "effects."})
    keys.emplace_back(other);
  return {std::move(keys), key + ": {}", [axes = std::vector(axes)](const Scene& scene) {
            Broken broken;
            const Materials materials(scene);
            const std::optional<double> reach = reach_of(scene, materials);
            for (const std::size_t axis : axes)
              if (const std::string wrong = reach
                                                ? no_room_for_images(box_of(scene), axis, materials.greatest_diameter(),
                                                                     *reach, skin_of(scene, materials))
                                                : "";
                  !wrong.empty())
                broken.add({wrong});
            return broken;
          }};
}

Broken speed_unknown(const Scene& scene) {
  const std::optional<Counted> start = counted_start(scene);
  if (!start || scene.dem.fixed_step || scene.dem.start_speed > 0) return {};
  try {
    return core::broken_if(!(known_speeds(scene, start->materials, start->box, {}).greatest > 0));
  } catch (const core::CaseError&) {  // the fluid is unknown
    return {};
  }
}

/// The kernel's smoothing needs the whole column.
Broken shared_with_a_wide_kernel(const Scene& scene) {
  const std::optional<Counted> start = counted_start(scene);
  if (!start || !scene.fluid.present() || scene.dem.fluid_ranks != core::FluidRanks::shared) return {};
  const std::vector<std::int64_t> numbers = particle_numbers(scene, start->materials);
  const double cell = core::grid_of(scene.column, nullptr).smallest_spacing();
  return core::broken_if(kernel_of(scene, cell, start->materials.greatest_diameter(),
                                   std::accumulate(numbers.begin(), numbers.end(), std::int64_t(0)))
                             .width > 0);
}

/// Keys that determine the initial particles.
std::vector<std::string> start_keys(std::vector<std::string> first) {
  for (const char* key :
       {"bed.", "column.", "species.", "wall.", "fluid.", "dem.", "inlet.", "jet.", "feed.", "discharge."})
    first.emplace_back(key);
  return first;
}

}  // namespace

std::vector<core::Rule> start_rules() {
  return {
      {start_keys({"column.size", "bed.start_solids_fraction"}), "the particles have no room at their start: {}",
       without_room},
      room_for_images("column.depth", {2}),
      room_for_images("column.size", {0, 1}),
      {start_keys({"dem.greatest_speed", "column.gravity"}), unknown_speed, speed_unknown},
      {{"bed.start", "column.gravity"},
       "bed.start = \"settled\": without column.gravity nothing settles; use \"random\" or \"mixed\"",
       [](const Scene& scene) {
         return core::broken_if(scene.bed.start.kind == core::StartKind::settled && !(scene.column.gravity > 0));
       }},
      {{"bed.start", "column.ends", "column.sides", "column.gravity_direction", "column.size", "column.shape", "wall."},
       "bed.start = \"settled\": along joined faces particles fall for ever; use \"random\" or \"mixed\", or walls "
       "across the direction of column.gravity",
       [](const Scene& scene) {
         return core::broken_if(scene.bed.start.kind == core::StartKind::settled && scene.column.gravity > 0 &&
                                falls_through_joined_faces(box_of(scene), gravity_of(scene)));
       }},
      {start_keys({"dem.fluid_ranks", "dem.kernel"}),
       "dem.fluid_ranks = \"shared\" does not go with a kernel of diffusion, which needs the whole column: use "
       "\"each\", or cells of at least 1.5 diameters with dem.kernel = \"bilinear\"",
       shared_with_a_wide_kernel}};
}

core::Rule contact_rule() {
  return {{"effects.contact"},
          "effects.contact: particles need a law of contact: hertz_mindlin, hertz or linear",
          [](const Scene& scene) { return core::broken_if(!core::acts(scene, "contact")); }};
}

}  // namespace polybed::dem
