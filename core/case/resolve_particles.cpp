#include "core/case/resolve_particles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

namespace polybed::core {

namespace {

using Messages = std::vector<std::string>;

void gravity(Column& column, Messages& wrong) {
  const std::vector<double>& given = column.gravity_direction;
  if (given.empty()) return;
  if (given.size() != column.given_size.size()) {
    wrong.push_back(
        fmt::format("column.gravity_direction has {} numbers, column.size {}", given.size(), column.given_size.size()));
    return;
  }
  // As column.size: the height comes last in the case and second on the axes.
  const bool plane = given.size() == 2;
  const std::array<double, 3> along{given[0], given.back(), plane ? 0 : given[1]};
  const double length = std::hypot(along[0], along[1], along[2]);
  if (!(length > 0)) {
    wrong.push_back("column.gravity_direction has no direction: all its numbers are 0");
    return;
  }
  for (std::size_t d = 0; d < 3; ++d) column.down[d] = along[d] / length;
}

void periodic_ends(const Scene& scene, Messages& wrong) {
  const Column& column = scene.column;
  if (column.ends != Boundary::periodic) return;
  const auto contradicts = [&](bool set, const char* what) {
    if (set) wrong.push_back(fmt::format("column.ends = \"periodic\" and {} contradict each other", what));
  };
  contradicts(column.closed, "column.closed = true");
  contradicts(column.outlet == Outlet::open, "column.outlet = \"open\"");
  contradicts(!scene.feeds.empty(), "[[feed]]");
  if (scene.fluid.present() && scene.column.shear_rate == 0)
    wrong.push_back(
        "column.ends = \"periodic\" is for particles without a fluid, or for a sheared box whose fluid moves with its "
        "flow: set fluid.name = \"none\", or dem.shear_rate");
}

void shear(const Scene& scene, Messages& wrong) {
  if (scene.column.shear_rate == 0) return;
  const auto needs = [&](bool met, const std::string& what) {
    if (!met) wrong.push_back(fmt::format("dem.shear_rate = {:g} 1/s needs {}", scene.column.shear_rate, what));
  };
  needs(scene.column.sides == Boundary::periodic, "column.sides = \"periodic\"");
  needs(scene.column.ends == Boundary::periodic, "column.ends = \"periodic\"");
  needs(scene.column.gravity == 0, fmt::format("column.gravity = 0, it is {:g} m/s2", scene.column.gravity));
  if (!scene.fluid.present()) return;
  const auto idle = [&](bool set, const char* what) {
    if (set) wrong.push_back(fmt::format("{} cannot act in a sheared box: its fluid moves with its flow", what));
  };
  idle(!scene.inlet.superficial_velocity.empty(), "inlet.superficial_velocity");
  idle(!scene.jets.empty(), "[[jet]]");
  idle(scene.bed.held, "dem.held = true");
  idle(scene.fluid.compressible(), "fluid.equation_of_state");
}

/// An opening in the bottom: what it needs, and its width.
void opening(const Scene& scene, Messages& wrong) {
  if (!scene.dem.opening) return;
  const Column& column = scene.column;
  const double width = *scene.dem.opening, depth = column.size[2];
  const auto say = [&](bool set, const std::string& what) {
    if (set) wrong.push_back(fmt::format("dem.opening = {:g} m: {}", width, what));
  };
  say(scene.fluid.present(), "particles cannot leave a column with a fluid; set fluid.name = \"none\"");
  say(column.ends == Boundary::periodic, "column.ends = \"periodic\" leaves no bottom to open");
  say(width >= column.size[0],
      fmt::format("it must be narrower than the bottom, which is {:g} m wide", column.size[0]));
  say(column.dimensions == 3 && width >= depth,
      fmt::format("it must be narrower than the bottom, which is {:g} m deep", depth));
  double largest = 0;
  for (const Species& species : scene.species) largest = std::max(largest, species.diameter);
  say(width < largest, fmt::format("the largest particle, of {:g} m, must fit through", largest));
}

/// Particles in a fluid: what it cannot be, and what needs it.
void in_fluid(const Scene& scene, Messages& wrong) {
  const auto say = [&](bool set, const char* what) {
    if (set) wrong.emplace_back(what);
  };
  const Column& column = scene.column;
  const bool fluid = scene.fluid.present();
  const bool tilted = column.down[0] != 0 || column.down[2] != 0 || !(column.down[1] < 0);
  const bool inflow = !scene.inlet.superficial_velocity.empty() || !scene.jets.empty();
  say(scene.bed.held && !fluid, "dem.held = true is a fixed bed for a fluid to flow through: fluid.name is \"none\"");
  say(scene.dem.kernel == Kernel::bilinear && scene.dem.kernel_width.has_value(),
      "dem.kernel_width cannot act: dem.kernel = \"bilinear\" has the width of the cells; use \"diffusion\" or "
      "\"auto\"");
  say(fluid && tilted && scene.fluid.compressible(),
      "column.gravity_direction other than down and a compressible fluid contradict each other: its density at rest "
      "falls with height; use fluid.equation_of_state = \"incompressible\"");
  say(fluid && tilted && inflow && !column.closed,
      "column.gravity_direction other than down needs a fluid that does not flow in, since the pressure at the outlet "
      "is "
      "that of a level surface: use column.closed = true, without inlet.superficial_velocity and [[jet]]");
}

void no_fluid(const Scene& scene, Messages& wrong) {
  if (scene.fluid.present()) return;
  const auto idle = [&](bool set, const char* what) {
    if (set) wrong.push_back(fmt::format("{} cannot act: fluid.name = \"none\"", what));
  };
  idle(!scene.inlet.superficial_velocity.empty(), "inlet.superficial_velocity");
  idle(!scene.jets.empty(), "[[jet]]");
  idle(scene.fluid.temperature.has_value(), "fluid.temperature");
  idle(scene.fluid.density.has_value(), "fluid.density");
  idle(scene.fluid.viscosity.has_value(), "fluid.viscosity");
  idle(scene.fluid.compressible(), "fluid.equation_of_state");
}

/// A path of a list is meant from the working directory or, if nothing is there, from the folder of the case.
void place_of_list(Bed& bed, const std::string& case_name, Messages& wrong) {
  namespace fs = std::filesystem;
  const auto is_file = [](const fs::path& path) {
    std::error_code error;
    return fs::exists(path, error) && !fs::is_directory(path, error);
  };
  const fs::path given = bed.start.file;
  if (is_file(given)) return;
  const fs::path beside = fs::path(case_name).parent_path() / given;
  if (is_file(beside))
    bed.start.file = beside.string();
  else
    wrong.push_back(fmt::format("bed.start = \"{}\": no such file in the working directory or beside the case file",
                                text_of(bed.start)));
}

void bed(Scene& scene, const std::string& case_name, Messages& wrong) {
  Bed& bed = scene.bed;
  const bool list = bed.start.kind == StartKind::list;
  const auto idle = [&](bool set, const char* key) {
    if (set) wrong.push_back(fmt::format("bed.{} cannot act: bed.start = \"{}\"", key, text_of(bed.start)));
  };
  idle(bed.start_fraction && (list || bed.start.kind == StartKind::random), "start_solids_fraction");
  idle(list && !bed.volume_share.empty(), "volume_share");
  idle(list && bed.static_height > 0, "static_height");
  idle(list && !bed.particles.empty(), "particles");
  if (list) place_of_list(bed, case_name, wrong);
}

}  // namespace

std::vector<std::string> resolve_particles(Scene& scene, const std::string& case_name, const WrongKeys& wrong_keys) {
  Messages wrong;
  const auto sound = [&](std::initializer_list<std::string_view> keys) { return wrong_keys.sound(keys); };
  const bool fluid = sound({"fluid.name"}), shape = sound({"column.size", "column.ends"});
  if (sound({"column.size", "column.gravity_direction"})) gravity(scene.column, wrong);
  if (fluid && sound({"column.ends", "dem.shear_rate"})) periodic_ends(scene, wrong);
  if (fluid && shape && sound({"dem.shear_rate", "column.sides", "column.gravity"})) shear(scene, wrong);
  if (fluid && shape && sound({"dem.opening", "species.diameter"})) opening(scene, wrong);
  if (fluid && sound({"column.size", "column.gravity_direction"})) in_fluid(scene, wrong);
  if (fluid) no_fluid(scene, wrong);
  if (sound({"bed.start"})) bed(scene, case_name, wrong);
  return wrong;
}

}  // namespace polybed::core
