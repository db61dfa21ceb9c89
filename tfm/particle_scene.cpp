#include "tfm/particle_scene.hpp"

namespace polybed::tfm {

namespace {

using core::Broken;
using core::Scene;
using core::StartKind;

core::Rule for_particles(std::vector<std::string> keys, const std::string& what, bool (*is_so)(const Scene&)) {
  return {std::move(keys), what + " is for the DEM only, the two-fluid model cannot run it",
          [is_so](const Scene& scene) { return core::broken_if(is_so(scene)); }};
}

bool leans(const Scene& scene) {
  const auto& down = scene.column.down;
  return down[0] != 0 || down[2] != 0 || !(down[1] < 0);
}

/// Of a column that leans: it needs walls to lean on and a start that does not ask where down is.
core::Rule for_leaning_particles(const std::string& key, const std::string& where, bool (*is_so)(const Scene&)) {
  return {
      {"column.gravity_direction", key},
      "column.gravity_direction other than down " + where + " is for the DEM only, the two-fluid model cannot run it",
      [is_so](const Scene& scene) { return core::broken_if(leans(scene) && is_so(scene)); }};
}

}  // namespace

const std::vector<core::Rule>& model_rules() {
  static const std::vector<core::Rule> all{
      for_particles({"fluid.name"}, "fluid.name = \"none\"", [](const Scene& s) { return !s.fluid.present(); }),
      for_particles({"column.ends"}, "column.ends = \"periodic\"",
                    [](const Scene& s) { return s.column.ends == core::Boundary::periodic; }),
      for_particles({"dem.shear_rate"}, "dem.shear_rate other than 0",
                    [](const Scene& s) { return s.column.shear_rate != 0; }),
      {{"bed.start"},
       "bed.start = \"{}\" is for the DEM only, the two-fluid model cannot run it",
       [](const Scene& s) {
         const StartKind kind = s.bed.start.kind;
         return kind == StartKind::random || kind == StartKind::list ? Broken({text_of(s.bed.start)}) : Broken();
       }},
      for_leaning_particles("column.closed", "without column.closed = true",
                            [](const Scene& s) { return !s.column.closed; }),
      for_leaning_particles("column.sides", "with column.sides = \"periodic\"",
                            [](const Scene& s) { return s.column.sides == core::Boundary::periodic; }),
      for_leaning_particles("bed.start", "with bed.start = \"settled\"",
                            [](const Scene& s) { return s.bed.start.kind == StartKind::settled; })};
  return all;
}

std::vector<std::string> only_for_particles(const Scene& scene) {
  std::vector<std::string> found;
  for (const core::Rule& rule : model_rules())
    for (std::string& fault : rule.faults(scene)) found.push_back(std::move(fault));
  return found;
}

void refuse_particle_scene(const Scene& scene) { core::refuse(model_rules(), scene); }

}  // namespace polybed::tfm
