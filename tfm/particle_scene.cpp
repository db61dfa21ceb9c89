#include "tfm/particle_scene.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace polybed::tfm {

std::vector<std::string> only_for_particles(const core::Scene& scene) {
  std::vector<std::string> found;
  const auto add = [&](bool set, const std::string& what) {
    if (set) found.push_back(what + " is for the DEM only, the two-fluid model cannot run it");
  };
  const core::Column& column = scene.column;
  const core::StartKind start = scene.bed.start.kind;
  add(!scene.fluid.present(), "fluid.name = \"none\"");
  add(column.ends == core::Boundary::periodic, "column.ends = \"periodic\"");
  const bool leans = column.down[0] != 0 || column.down[2] != 0 || !(column.down[1] < 0);
  const std::string aslant = "column.gravity_direction other than down ";
  add(leans && !column.closed, aslant + "without column.closed = true");
  add(leans && column.sides == core::Boundary::periodic, aslant + "with column.sides = \"periodic\"");
  add(leans && start == core::StartKind::settled, aslant + "with bed.start = \"settled\"");
  add(leans && scene.fluid.compressible(), aslant + "with a compressible fluid");
  add(scene.column.shear_rate != 0, "dem.shear_rate other than 0");
  add(start == core::StartKind::random || start == core::StartKind::list,
      "bed.start = \"" + text_of(scene.bed.start) + "\"");
  return found;
}

void refuse_particle_scene(const core::Scene& scene) {
  const std::vector<std::string> found = only_for_particles(scene);
  if (!found.empty()) throw core::CaseError(fmt::format("{}", fmt::join(found, "\n")));
}

}  // namespace polybed::tfm
