// Requirements on columns and on the times of output, and the list of all rules.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/case/case_rules.hpp"
#include "core/case/resolve.hpp"
#include "core/case/size_classes.hpp"

namespace polybed::core {

namespace {

bool has_axes(const Column& column) { return column.given_size.size() == 2 || column.given_size.size() == 3; }

Broken axes_missing(const Scene& scene) {
  if (has_axes(scene.column)) return {};
  return Broken({std::to_string(scene.column.given_size.size())});
}

Broken cells_beside_size(const Scene& scene) {
  const Column& column = scene.column;
  if (column.given_cells.size() == column.given_size.size()) return {};
  return Broken({std::to_string(column.given_cells.size()), std::to_string(column.given_size.size())});
}

Broken too_many_cells(const Scene& scene) {
  constexpr double most = 2147483647;  // hypre numbers them with 32 bits
  const auto& cells = scene.column.cells;
  const double all = double(cells[0]) * cells[1] * cells[2];
  return all > most ? Broken({fmt::format("{:.3g}", all), fmt::format("{:.0f}", most)}) : Broken();
}

/// A column narrower than a particle has no meaningful solids fraction.
Broken no_room(const Scene& scene) {
  constexpr std::array<const char*, 3> sides{"width", "height", "depth"};
  Broken broken;
  for (std::size_t n = 0; n < scene.species.size(); ++n)
    for (std::size_t axis = 0; axis < sides.size(); ++axis)
      if (scene.species[n].diameter > scene.column.size[axis])
        broken.add({fmt::format("{:.4g}", scene.species[n].diameter), sides[axis],
                    fmt::format("{:.4g}", scene.column.size[axis])},
                   entry_of(scene, scene.species, n));
  return broken;
}

Broken gravity_beside_size(const Scene& scene) {
  const std::size_t given = scene.column.gravity_direction.size(), axes = scene.column.given_size.size();
  return given == 0 || given == axes ? Broken() : Broken({std::to_string(given), std::to_string(axes)});
}

bool is_tilted(const Column& column) { return column.down[0] != 0 || column.down[2] != 0 || !(column.down[1] < 0); }

std::vector<Rule> axis_rules() {
  return {
      {{"column.size"},
       "column.size has {} numbers: two (width, height) or three (width, depth, height)",
       axes_missing,
       true},
      {{"column.cells", "column.size"}, "column.cells has {} numbers, column.size {}", cells_beside_size, true},
      {{"column.gravity_direction", "column.size"},
       "column.gravity_direction has {} numbers, column.size {}",
       gravity_beside_size,
       true},
      {{"column.gravity_direction"},
       "column.gravity_direction has no direction: all its numbers are 0",
       [](const Scene& scene) {
         const std::vector<double>& given = scene.column.gravity_direction;
         return broken_if(!given.empty() && std::all_of(given.begin(), given.end(), [](double g) { return g == 0; }));
       },
       true},
      {{"column.depth", "column.size"},
       "column.depth is the depth of a two-dimensional column; column.size has three numbers",
       [](const Scene& scene) { return broken_if(scene.column.dimensions == 3 && scene.column.depth); }},
      {{"column.cells", "column.size"},
       "column.cells: {} cells; at most {} can be numbered, however large the memory",
       too_many_cells},
      {{"species.diameter", "column.size", "column.depth", "dem.skin"},
       "species.diameter: {} m is more than the {} of the column, {} m",
       no_room}};
}

Broken nothing_above(const Scene& scene) {
  const Column& column = scene.column;
  if (!column.grading || !column.graded_above) return {};
  if (!column.layers.empty() && long(column.layers.size()) < column.even_layers()) return {};
  return Broken({fmt::format("{:.4g}", *column.graded_above), fmt::format("{:.4g}", column.size[1])});
}

std::vector<Rule> grading_rules() {
  return {{{"column.grading", "column.graded_above"},
           "column.grading = {} needs column.graded_above, the height above which layers of cells grow: above the bed "
           "when it is expanded",
           [](const Scene& scene) {
             const Column& column = scene.column;
             return column.grading && !column.graded_above ? Broken({fmt::format("{:g}", *column.grading)}) : Broken();
           }},
          {{"column.graded_above", "column.grading"},
           "column.graded_above cannot act without column.grading, the ratio of the heights of layers, for example 1.1",
           [](const Scene& scene) { return broken_if(scene.column.graded_above && !scene.column.grading); }},
          {{"column.graded_above", "column.grading", "column.size", "column.cells"},
           "column.graded_above = {} m leaves no layers to grade in a column of {} m: lower it, or leave out "
           "column.grading",
           nothing_above},
          {{"column.grading", "column.profile", "column.shape"},
           "column.grading and column.profile cannot be combined yet: leave out one of them",
           [](const Scene& scene) { return broken_if(scene.column.grading && scene.column.is_tapered()); }},
          {{"column.grading", "wall.thickness", "fluid.name"},
           "column.grading and [[wall]] in a fluid cannot be combined yet: leave out one of them",
           [](const Scene& scene) {
             return broken_if(scene.column.grading && scene.fluid.present() && !scene.walls.empty());
           }}};
}

/// "column.grading_across" with what needs even cells across.
Rule even_across(const std::string& key, const std::string& what, bool (*set)(const Scene&)) {
  return {{"column.grading_across", key},
          "column.grading_across and " + what + " cannot be combined yet: leave out one of them",
          [set](const Scene& scene) { return broken_if(scene.column.grading_across && set(scene)); }};
}

Broken too_wide_in_the_middle(const Scene& scene) {
  Broken broken;
  for (const std::vector<double>& widths : scene.column.across)
    if (!widths.empty() && widths[widths.size() / 2] > 10 * widths.front())
      broken.add({fmt::format("{:g}", *scene.column.grading_across),
                  fmt::format("{:.3g}", widths[widths.size() / 2] / widths.front())});
  return broken;
}

std::vector<Rule> across_rules() {
  return {{{"column.grading_across", "column.shape", "column.sides"},
           "column.grading_across makes cells smaller at flat side walls: it needs column.shape = \"box\" and "
           "column.sides = \"wall\"",
           [](const Scene& scene) {
             const Column& column = scene.column;
             return broken_if(column.grading_across &&
                              (column.shape != ColumnShape::box || column.sides != Boundary::wall));
           }},
          {{"column.grading_across", "column.cells"},
           "column.grading_across needs at least three cells across: column.cells has fewer",
           [](const Scene& scene) {
             const auto& cells = scene.column.cells;
             return broken_if(scene.column.grading_across && cells[0] < 3 && cells[2] < 3);
           }},
          {{"column.grading_across", "column.cells"},
           "column.grading_across = {} makes cells in the middle {} times as wide as at the walls, at most 10: use a "
           "smaller ratio or fewer cells",
           too_wide_in_the_middle},
          even_across("jet.superficial_velocity", "[[jet]]", [](const Scene& s) { return !s.jets.empty(); }),
          even_across("feed.species", "[[feed]]", [](const Scene& s) { return !s.feeds.empty(); }),
          even_across("discharge.at", "[[discharge]]", [](const Scene& s) { return !s.discharges.empty(); }),
          even_across("wall.shape", "[[wall]]", [](const Scene& s) { return !s.walls.empty(); }),
          even_across("layer.from", "[[layer]] with from",
                      [](const Scene& s) {
                        return std::any_of(s.layers.begin(), s.layers.end(),
                                           [](const Layer& layer) { return !layer.from.empty(); });
                      }),
          even_across("fluid.equation_of_state", "a compressible fluid",
                      [](const Scene& s) { return s.fluid.present() && s.fluid.compressible(); }),
          even_across("column.gravity_direction", "column.gravity_direction other than down",
                      [](const Scene& s) { return is_tilted(s.column); })};
}

std::vector<Rule> gravity_rules() {
  return {
      {{"column.gravity_direction", "column.size", "fluid.name", "fluid.equation_of_state"},
       "column.gravity_direction other than down and a compressible fluid contradict each other: its density at "
       "rest falls with height; use fluid.equation_of_state = \"incompressible\"",
       [](const Scene& scene) {
         return broken_if(scene.fluid.present() && is_tilted(scene.column) && scene.fluid.compressible());
       }},
      {{"column.gravity_direction", "column.size", "fluid.name", "column.closed", "inlet.superficial_velocity",
        "inlet.at"},
       "column.gravity_direction other than down needs a fluid whose flow is given at both ends, since the pressure at "
       "an outlet is that of a level surface: use inlet.at = \"top\", or column.closed = true without "
       "inlet.superficial_velocity and [[jet]]",
       [](const Scene& scene) {
         const bool inflow = !scene.inlet.superficial_velocity.empty() || !scene.jets.empty();
         return broken_if(scene.fluid.present() && is_tilted(scene.column) && inflow && !scene.column.closed &&
                          scene.inlet.at == ColumnEnd::bottom);
       }}};
}

Rule joined_ends_exclude(const std::string& key, const std::string& what, bool (*set)(const Scene&)) {
  return {{"column.ends", key},
          "column.ends = \"periodic\" and " + what + " contradict each other",
          [set](const Scene& scene) { return broken_if(scene.column.ends == Boundary::periodic && set(scene)); }};
}

/// For a fluid between joined ends. \param remedy  what to do instead
Rule flowing_around_excludes(const std::string& key, const std::string& what, const std::string& remedy,
                             bool (*set)(const Scene&)) {
  return {{"column.ends", key, "fluid.name", "dem.shear_rate"},
          "column.ends = \"periodic\" in a fluid and " + what + " cannot be combined yet: " + remedy,
          [set](const Scene& scene) { return broken_if(scene.flows_around() && set(scene)); }};
}

std::vector<Rule> end_rules() {
  return {
      joined_ends_exclude("column.closed", "column.closed = true", [](const Scene& s) { return s.column.closed; }),
      joined_ends_exclude("column.outlet", "column.outlet = \"open\"",
                          [](const Scene& s) { return s.column.outlet == Outlet::open; }),
      joined_ends_exclude("column.outlet", "column.outlet = \"lid\"",
                          [](const Scene& s) { return s.column.outlet == Outlet::lid; }),
      joined_ends_exclude("column.grading", "column.grading", [](const Scene& s) { return bool(s.column.grading); }),
      joined_ends_exclude("feed.species", "[[feed]]", [](const Scene& s) { return !s.feeds.empty(); }),
      joined_ends_exclude("discharge.at", "[[discharge]]", [](const Scene& s) { return !s.discharges.empty(); }),
      flowing_around_excludes("column.grading_across", "column.grading_across", "leave it out",
                              [](const Scene& s) { return bool(s.column.grading_across); }),
      flowing_around_excludes("column.shape", "a round column", "use column.shape = \"box\"",
                              [](const Scene& s) { return s.column.shape != ColumnShape::box; }),
      flowing_around_excludes("column.gravity_direction", "column.gravity_direction other than down", "leave it out",
                              [](const Scene& s) { return s.column.gravity != 0 && is_tilted(s.column); }),
      flowing_around_excludes("fluid.equation_of_state", "a compressible fluid, whose pressure is given at a top,",
                              "use fluid.equation_of_state = \"incompressible\"",
                              [](const Scene& s) { return s.fluid.compressible(); }),
      {{"column.pressure_gradient", "dem.held", "column.ends", "fluid.name"},
       "column.pressure_gradient = \"weight\" and dem.held = true contradict each other: the fluid does not carry "
       "particles that are held; give a number, negative for an upward flow",
       [](const Scene& scene) {
         return broken_if(scene.flows_around() && scene.bed.held &&
                          std::holds_alternative<MeanGradient>(scene.column.pressure_gradient));
       }},
      {{"column.pressure_gradient", "column.ends", "fluid.name", "dem.shear_rate"},
       "column.pressure_gradient cannot act: it drives a fluid between joined ends, column.ends = \"periodic\"",
       [](const Scene& scene) {
         return broken_if(!scene.flows_around() && std::holds_alternative<double>(scene.column.pressure_gradient));
       }}};
}

Rule shear_needs(const std::string& key, const std::string& what, bool (*met)(const Column&)) {
  return {{"dem.shear_rate", key}, "dem.shear_rate = {} 1/s needs " + what, [met](const Scene& scene) {
            const Column& column = scene.column;
            return column.shear_rate == 0 || met(column) ? Broken() : Broken({fmt::format("{:g}", column.shear_rate)});
          }};
}

std::vector<Rule> shear_rules() {
  return {shear_needs("column.sides", "column.sides = \"periodic\"",
                      [](const Column& column) { return column.sides == Boundary::periodic; }),
          shear_needs("column.ends", "column.ends = \"periodic\"",
                      [](const Column& column) { return column.ends == Boundary::periodic; }),
          {{"dem.shear_rate", "column.gravity"},
           "dem.shear_rate = {} 1/s needs column.gravity = 0, it is {} m/s2",
           [](const Scene& scene) {
             const double rate = scene.column.shear_rate, gravity = scene.column.gravity;
             if (rate == 0 || gravity == 0) return Broken();
             return Broken({fmt::format("{:g}", rate), fmt::format("{:g}", gravity)});
           }}};
}

constexpr double most_outputs = 1e7;

/// Rejects endless series of files, and times that floating point cannot distinguish.
Rule countable(const std::string& key, std::optional<double> OutputPlan::*every) {
  return {{"output." + key, "run.until"},
          "output." + key + " = {} s: {} times until run.until = {} s; at most {}: take a longer one",
          [every](const Scene& scene) {
            const double until = scene.run.until, step = (scene.output.*every).value_or(until);
            if (!(until > most_outputs * step)) return Broken();
            return Broken({fmt::format("{:g}", step), fmt::format("{:.2g}", until / step), fmt::format("{:g}", until),
                           fmt::format("{:g}", most_outputs)});
          }};
}

std::vector<Rule> time_rules() {
  return {countable("every", &OutputPlan::every), countable("history_every", &OutputPlan::history_every),
          countable("checkpoint_every", &OutputPlan::checkpoint_every)};
}

}  // namespace

std::vector<Rule> column_rules() {
  std::vector<Rule> rules;
  for (const auto& part :
       {axis_rules(), grading_rules(), across_rules(), gravity_rules(), end_rules(), shear_rules(), time_rules()})
    rules.insert(rules.end(), part.begin(), part.end());
  return rules;
}

std::span<const Rule> case_rules() {
  static const std::vector<Rule> all = [] {
    std::vector<Rule> rules;
    for (const auto& part : {column_rules(), opening_rules(), wall_rules(), bed_rules(), layer_rules(), idle_rules()})
      rules.insert(rules.end(), part.begin(), part.end());
    return rules;
  }();
  return all;
}

}  // namespace polybed::core
