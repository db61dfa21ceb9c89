#include "multiscale/cost/axes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "closures/drag.hpp"
#include "core/error.hpp"
#include "dem/continuum_scene.hpp"

namespace polybed::multiscale {

namespace {

std::string key(const std::string& name, const std::string& value) { return name + "=" + value; }

/// Puts the level of the case among others, by its value; returns its place.
std::size_t with_given(std::vector<Level>& levels, Level given, bool falling) {
  const auto same = [&](const Level& l) { return std::abs(l.value - given.value) <= 1e-9 * std::abs(given.value); };
  auto found = std::find_if(levels.begin(), levels.end(), same);
  if (found == levels.end()) {
    found = std::find_if(levels.begin(), levels.end(),
                         [&](const Level& l) { return falling ? l.value < given.value : l.value > given.value; });
    found = levels.insert(found, std::move(given));
  }
  return std::size_t(found - levels.begin());
}

Level number_level(const std::string& name, double value) {
  return {fmt::format("{:.3g}", value), value, {key(name, fmt::format("{:.17g}", value))}, "", 1};
}

Axis numbers(const std::string& axis, const std::string& name, const std::vector<double>& values, double given,
             bool falling, const std::vector<double>& beyond) {
  Axis made{axis, AxisKind::numerics, {}, 0, {}};
  for (const double v : values) made.levels.push_back(number_level(name, v));
  made.given = with_given(made.levels, number_level(name, given), falling);
  for (const double v : beyond) made.beyond.push_back(number_level(name, v));
  return made;
}

Axis rtol_axis(const core::Scene& scene) {
  return numbers("rtol", "tfm.rtol", {1e-2, 1e-3, 1e-4, 1e-5}, scene.tfm.rtol, true, {1e-6, 1e-7});
}

Axis grid_axis(const core::Scene& scene) {
  Axis axis{"grid", AxisKind::numerics, {grid_level(scene, 2), grid_level(scene, 1), grid_level(scene, 0.5)}, 1, {}};
  if (scene.column.cells[0] == 1) axis.levels.push_back(grid_level(scene, 0.25));
  const double finest = axis.levels.back().value;
  for (const double factor : {2.0, 4.0}) axis.beyond.push_back(grid_level(scene, finest / factor));
  return axis;
}

Axis scheme_axis(const core::Scene& scene) {
  Axis axis{"scheme", AxisKind::numerics, {}, 0, {}};
  if (scene.tfm.integrator != core::TfmIntegrator::automatic || scene.tfm.flux != core::FractionFlux::limited)
    axis.levels.push_back(
        {fmt::format("{} {}", core::name_of(scene.tfm.integrator), core::name_of(scene.tfm.flux)), 0, {}, "", 1});
  for (const char* integrator : {"auto", "explicit", "implicit"})
    if (integrator != core::name_of(scene.tfm.integrator) || scene.tfm.flux != core::FractionFlux::limited)
      axis.levels.push_back({integrator, 0, {key("tfm.integrator", integrator), key("tfm.flux", "limited")}, "", 1});
    else if (axis.levels.empty())
      axis.levels.push_back({integrator, 0, {}, "", 1});
  if (scene.tfm.flux == core::FractionFlux::limited)
    axis.levels.push_back({"upwind", 0, {key("tfm.flux", "upwind")}, "", 1});
  return axis;
}

Axis steps_axis(const core::Scene& scene) {
  return numbers("steps", "dem.steps_per_contact", {10, 20, 50, 100}, scene.dem.steps_per_contact, false, {200, 400});
}

Axis coupling_axis(const core::Scene& scene) {
  return numbers("coupling", "dem.fluid_every", {50, 16, 5}, scene.dem.fluid_every, true, {2, 1});
}

/// The averaging time is the last quarter of the run: n of them end at until (3 + n)/4.
Axis window_axis(const core::Scene& scene) {
  Axis axis{"window", AxisKind::statistics, {}, 0, {}};
  for (const double n : {1.0, 3.0, 10.0})
    axis.levels.push_back(
        {fmt::format("x{:g}", n), n, {key("run.until", fmt::format("{:.17g}", scene.run.until * (3 + n) / 4))}, "", 1});
  axis.levels.front().overrides.clear();
  return axis;
}

/// Softer contacts last four times as long with a modulus divided by 4^(5/2), Hertz.
Axis stiffness_axis(const core::Scene& scene) {
  Axis axis{"stiffness", AxisKind::model, {}, 1, {}};
  for (const double factor : {32.0, 1.0})
    axis.levels.push_back(
        number_level("dem.youngs_modulus", scene.dem.youngs_modulus.value_or(core::least_modulus) / factor));
  const auto soften = [&](const std::string& name, const std::optional<double>& given) {
    if (given) axis.levels[0].overrides.push_back(key(name, fmt::format("{:.17g}", *given / 32)));
  };
  for (const core::Species& s : scene.species) soften("species." + s.name + ".youngs_modulus", s.youngs_modulus);
  for (std::size_t n = 0; n < scene.contact_pairs.size(); ++n)
    soften(fmt::format("contact_pair.{}.youngs_modulus", n), scene.contact_pairs[n].youngs_modulus);
  axis.levels[1].overrides.clear();
  return axis;
}

Axis kernel_axis(const core::Scene& scene) {
  Axis axis{"kernel", AxisKind::model, {{"given", 0, {}, "", 1}}, 0, {}};
  double greatest = 0;
  for (const core::Species& s : scene.species) greatest = std::max(greatest, s.diameter);
  for (const double d : {3.0, 4.0, 6.0})
    axis.levels.push_back(
        {fmt::format("{:g} d", d),
         d,
         {key("dem.kernel", "diffusion"), key("dem.kernel_width", fmt::format("{:.17g}", d * greatest))},
         "",
         1});
  return axis;
}

Axis drag_axis(const core::Scene& scene) {
  const std::string given = core::law_of(scene, "drag");
  Axis axis{"drag", AxisKind::model, {{given, 0, {}, "", 1}}, 0, {}};
  if (given == "none") return axis;
  std::vector<std::string> others{"cello", "vbk_theory", "gidaspow", "di_felice"};
  for (const std::string& law : others)
    if (law != given) axis.levels.push_back({law, 0, {key("effects.drag", law)}, "", 1});
  return axis;
}

/// The pressure and the stress of the solids.
Axis stress_axis(const core::Scene& scene) {
  const std::string given = core::law_of(scene, "solids_stress");
  Axis axis{"effects", AxisKind::model, {{given, 0, {}, "", 1}}, 0, {}};
  if (given == "frictional") axis.levels.push_back({"kinetic", 0, {key("effects.solids_stress", "kinetic")}, "", 1});
  if (given == "kinetic") axis.levels.push_back({"frictional", 0, {key("effects.solids_stress", "frictional")}, "", 1});
  return axis;
}

Axis level_axis(const core::Scene& scene, const std::string& model) {
  Axis axis{"level", AxisKind::model, {{model == "tfm" ? "tfm 2-D" : "dem", 0, {}, "", 1}}, 0, {}};
  if (model == "tfm" && scene.column.dimensions == 3) axis.levels.front().label = "tfm 3-D";
  if (core::law_of(scene, "drag") != "none" && scene.bed.static_height > 0)
    axis.levels.push_back({"force balance", 0, {}, "force_balance", 1});
  if (model == "tfm" && scene.column.dimensions == 2 && scene.column.cells[0] > 1)
    axis.levels.push_back(
        {"tfm 1-D", 0, {key("column.cells", fmt::format("[1,{}]", scene.column.given_cells[1]))}, "", 1});
  if (model == "tfm" && core::law_of(scene, "contact") != "none" && dem::only_for_continuum(scene).empty())
    axis.levels.push_back({"dem", 0, {}, "dem", 1});
  if (model == "dem" && core::law_of(scene, "solids_stress") != "none") axis.levels.push_back({"tfm", 0, {}, "tfm", 1});
  return axis;
}

Axis ranks_axis(const core::Scene&) {
  return {"ranks", AxisKind::machine, {{"1", 1, {}, "", 1}, {"2", 2, {}, "", 2}}, 0, {}};
}

struct Maker {
  std::string name, models;
  bool by_default;
  std::function<Axis(const core::Scene&, const std::string& model)> make;
};

const std::vector<Maker>& makers() {
  const auto plain = [](Axis (*make)(const core::Scene&)) {
    return [make](const core::Scene& scene, const std::string&) { return make(scene); };
  };
  static const std::vector<Maker> all{{"rtol", "tfm", true, plain(rtol_axis)},
                                      {"grid", "tfm", true, plain(grid_axis)},
                                      {"scheme", "tfm", true, plain(scheme_axis)},
                                      {"steps", "dem", true, plain(steps_axis)},
                                      {"coupling", "dem", true, plain(coupling_axis)},
                                      {"window", "tfm dem", false, plain(window_axis)},
                                      {"stiffness", "dem", true, plain(stiffness_axis)},
                                      {"kernel", "dem", false, plain(kernel_axis)},
                                      {"drag", "tfm dem", true, plain(drag_axis)},
                                      {"effects", "tfm", true, plain(stress_axis)},
                                      {"level", "tfm dem", true, level_axis},
                                      {"ranks", "tfm dem", false, plain(ranks_axis)}};
  return all;
}

/// Coupling and kernel are those of a fluid.
bool acts(const Maker& maker, const core::Scene& scene, const std::string& model) {
  const bool of_fluid = maker.name == "coupling" || maker.name == "kernel";
  return maker.models.find(model) != std::string::npos && !(of_fluid && !scene.fluid.present());
}

}  // namespace

Level grid_level(const core::Scene& scene, double coarser) {
  std::vector<std::int64_t> cells = scene.column.given_cells;
  for (std::int64_t& n : cells)
    if (n > 1) n = std::max<std::int64_t>(1, std::llround(double(n) / coarser));
  Level level{fmt::format("{}", fmt::join(cells, "x")), coarser, {}, "", 1};
  if (coarser != 1) level.overrides = {key("column.cells", fmt::format("[{}]", fmt::join(cells, ",")))};
  return level;
}

std::vector<std::string> axis_names() {
  std::vector<std::string> names;
  for (const Maker& maker : makers()) names.push_back(maker.name);
  return names;
}

std::vector<std::string> acting_axes(const core::Scene& scene, const std::string& model) {
  std::vector<std::string> names;
  for (const Maker& maker : makers())
    if (acts(maker, scene, model)) names.push_back(maker.name);
  return names;
}

std::vector<Axis> axes_of(const core::Scene& scene, const std::string& model, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto found =
        std::find_if(makers().begin(), makers().end(), [&](const Maker& maker) { return maker.name == name; });
    if (found == makers().end())
      throw core::CaseError(fmt::format("--axes {}: there are {}", name, fmt::join(axis_names(), ", ")));
    if (!acts(*found, scene, model))
      throw core::CaseError(fmt::format("--axes {}: does not act in this case by {}", name, model));
  }
  std::vector<Axis> axes;
  for (const Maker& maker : makers()) {
    const bool asked = std::find(names.begin(), names.end(), maker.name) != names.end();
    if (!(names.empty() ? maker.by_default && acts(maker, scene, model) : asked)) continue;
    axes.push_back(maker.make(scene, model));
  }
  return axes;
}

}  // namespace polybed::multiscale
