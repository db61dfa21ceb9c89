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
  const std::string& start = scene.bed.start;
  add(scene.fluid.name == "none", "fluid.name = \"none\"");
  add(column.ends == "periodic", "column.ends = \"periodic\"");
  const bool leans = column.down[0] != 0 || column.down[2] != 0 || !(column.down[1] < 0);
  const std::string aslant = "column.gravity_direction other than down ";
  add(leans && !column.closed, aslant + "without column.closed = true");
  add(leans && column.sides == "periodic", aslant + "with column.sides = \"periodic\"");
  add(leans && start == "settled", aslant + "with bed.start = \"settled\"");
  add(leans && scene.fluid.equation_of_state != "incompressible", aslant + "with a compressible fluid");
  add(scene.dem.shear_rate != 0, "dem.shear_rate other than 0");
  add(start == "random" || start.starts_with("list:"), "bed.start = \"" + start + "\"");
  return found;
}

void refuse_particle_scene(const core::Scene& scene) {
  const std::vector<std::string> found = only_for_particles(scene);
  if (!found.empty()) throw core::CaseError(fmt::format("{}", fmt::join(found, "\n")));
}

}  // namespace polybed::tfm
