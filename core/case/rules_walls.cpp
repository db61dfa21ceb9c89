// Requirements on a round column and on walls inside the column.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/case/case_rules.hpp"
#include "core/case/size_classes.hpp"

namespace polybed::core {

namespace {

bool has_round_wall(const Scene& scene) {
  return std::any_of(scene.walls.begin(), scene.walls.end(), [](const InnerWall& wall) { return wall.is_round(); });
}

/// A particle that touches a wall on all sides at once has no nearest point, and Hertz' contact is no longer a spot. A
/// round wall must be at least twice as wide as the particles.
bool too_narrow(double diameter, const Species& species) { return 2 * species.diameter > diameter * (1 + 1e-12); }

Broken not_round(const Scene& scene) {
  const std::vector<double>& size = scene.column.given_size;
  if (!scene.column.is_round() || (size.size() != 2 && size.size() != 3)) return {};
  return broken_if(size.size() == 2 || std::abs(size[0] - size[1]) > 1e-12 * size[0]);
}

Broken column_too_narrow(const Scene& scene) {
  Broken broken;
  if (!scene.column.is_round() || scene.column.given_size.empty()) return broken;
  const double diameter = scene.column.is_tapered() ? scene.column.narrowest() : scene.column.given_size[0];
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    if (too_narrow(diameter, scene.species[j]))
      broken.add({fmt::format("{:.4g}", scene.species[j].diameter), fmt::format("{:.4g}", diameter)},
                 entry_of(scene, scene.species, j));
  return broken;
}

bool is_uneven(double a, double b) { return std::abs(a - b) > 1e-9 * std::abs(b); }

/// Finds more than two points at one height, or a step at an end.
Broken profile_unsteady(const Scene& scene) {
  const auto& profile = scene.column.profile;
  for (const std::size_t n : {std::size_t(1), profile.size() - 1})
    if (profile.size() > 1 && profile[n - 1].first == profile[n].first)
      return Broken({fmt::format("{:.4g}", profile[n].first)});
  for (std::size_t n = 2; n < profile.size(); ++n)
    if (profile[n - 2].first == profile[n].first) return Broken({fmt::format("{:.4g}", profile[n].first)});
  return {};
}

/// Checks the first and the last height.
Broken profile_of_another_height(const Scene& scene) {
  const Column& column = scene.column;
  if (!column.is_tapered() || column.given_size.empty()) return {};
  const double low = column.profile.front().first, high = column.profile.back().first,
               height = column.given_size.back();
  if (low == 0 && !is_uneven(high, height)) return {};
  return Broken({fmt::format("{:.4g}", low), fmt::format("{:.4g}", high), fmt::format("{:.4g}", height)});
}

Broken profile_of_another_width(const Scene& scene) {
  const Column& column = scene.column;
  if (!column.is_tapered() || column.given_size.empty()) return {};
  const double widest = column.widest(), width = (column.around_axis() ? 2 : 1) * column.given_size[0];
  if (!is_uneven(widest, width)) return {};
  return Broken({fmt::format("{:.6g}", widest), fmt::format("{:.6g}", width)});
}

/// The cells in the middle must be open over the whole height.
Broken profile_too_narrow(const Scene& scene) {
  constexpr double least = 4;
  const Column& column = scene.column;
  if (!column.is_tapered()) return {};
  double cell = column.size[0] / column.cells[0];
  if (column.is_round()) cell = std::max(cell, column.size[2] / column.cells[2]);
  const double cells = column.narrowest() / cell;
  if (cells > least * (1 - 1e-9)) return {};
  return Broken({fmt::format("{:.4g}", column.narrowest()), fmt::format("{:.2g}", cells), fmt::format("{:g}", least)});
}

Broken layers_with_corners(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.layers.size(); ++n)
    if (scene.column.shape != ColumnShape::box && !scene.layers[n].from.empty()) broken.add({std::to_string(n + 1)}, n);
  return broken;
}

/// Whether a part of the cross-section, for a feed or a jet, has a corner beyond a round column.
template <class Part>
bool is_beyond_the_circle(const Column& column, const Part& part, ColumnFace end) {
  if (is_side(end)) return false;
  const double within = 0.5 * column.diameter_at(end) * (1 + 1e-12), centre = 0.5 * column.size[0];
  if (column.around_axis()) return column.is_tapered() && !part.to.empty() && part.to[0] > within;
  if (!column.is_round() || part.from.size() != 2 || part.to.size() != 2) return false;
  for (const double x : {part.from[0], part.to[0]})
    for (const double z : {part.from[1], part.to[1]})
      if (std::hypot(x - centre, z - centre) > within) return true;
  return false;
}

Broken feeds_beyond_the_circle(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.feeds.size(); ++n)
    if (const Feed& feed = scene.feeds[n]; is_beyond_the_circle(scene.column, feed, feed.at))
      broken.add({feed.species, fmt::format("{:.4g}", scene.column.diameter_at(feed.at))},
                 entry_of(scene, scene.feeds, n));
  return broken;
}

/// A rule for jets or discharges.
template <class Part>
Rule beyond_the_circle(const std::string& table, std::vector<Part> Scene::*parts) {
  const std::string from = table + ".from", to = table + ".to";
  return {{from, to, "column.size", "column.shape", "column.profile"},
          "[[" + table + "]] number {} reaches beyond the round column, {} m in diameter: move " + from + " and " + to +
              " inwards",
          [parts](const Scene& scene) {
            Broken broken;
            for (std::size_t n = 0; n < (scene.*parts).size(); ++n)
              if (const Part& part = (scene.*parts)[n]; is_beyond_the_circle(scene.column, part, part.at))
                broken.add({std::to_string(n + 1), fmt::format("{:.4g}", scene.column.diameter_at(part.at))}, n);
            return broken;
          }};
}

/// Cells so long that a wall could cut one off from all others.
Broken long_cells_in_a_cylinder(const Scene& scene) {
  constexpr double most = 4;
  const Column& column = scene.column;
  const double ratio = double(column.cells[0]) / column.cells[2];
  if (!column.is_round() || column.dimensions != 3 || (ratio <= most && ratio * most >= 1)) return {};
  return Broken({std::to_string(column.cells[0]), std::to_string(column.cells[2])});
}

std::vector<Rule> profile_rules() {
  return {{{"column.profile", "column.shape"},
           "column.profile is for round columns: use column.shape = \"axisymmetric\" or \"cylinder\"",
           [](const Scene& scene) {
             return broken_if(scene.column.is_tapered() && scene.column.shape == ColumnShape::box);
           },
           true},
          {{"column.profile", "column.size"},
           "column.profile goes from {} to {} m: from 0 to the height of the column, {} m",
           profile_of_another_height,
           true},
          {{"column.profile"},
           "column.profile: too many pairs at {} m: a step inside has two, each end has one",
           profile_unsteady,
           true},
          {{"column.profile", "column.size", "column.shape"},
           "column.profile is {} m in diameter where it is widest, column.size {} m: make them equal",
           profile_of_another_width,
           true},
          {{"column.profile", "column.cells", "column.size"},
           "column.profile: {} m at its narrowest are {} cells, at least {}: take more cells in column.cells",
           profile_too_narrow}};
}

std::vector<Rule> round_column_rules() {
  return {
      {{"column.size", "column.shape"},
       "column.shape = \"cylinder\" takes column.size = [diameter, diameter, height]",
       not_round,
       true},
      {{"species.diameter", "column.size", "column.shape"},
       "species.diameter: {} m is more than half the diameter of the round column, {} m",
       column_too_narrow,
       true},
      {{"column.shape", "column.size"},
       "column.shape = \"axisymmetric\" takes column.size = [radius, height]",
       [](const Scene& scene) { return broken_if(scene.column.around_axis() && scene.column.given_size.size() == 3); },
       true},
      {{"column.depth", "column.shape"},
       "column.depth and column.shape = \"axisymmetric\" contradict each other: leave column.depth out",
       [](const Scene& scene) { return broken_if(scene.column.around_axis() && scene.column.depth); }},
      {{"column.sides", "column.shape"},
       "column.sides = \"periodic\" and column.shape = \"{}\" contradict each other: use column.sides = \"wall\"",
       [](const Scene& scene) {
         const Column& column = scene.column;
         if (column.shape == ColumnShape::box || column.sides != Boundary::periodic) return Broken();
         return Broken({std::string(name_of(column.shape))});
       }},
      {{"layer.from", "column.shape"},
       "[[layer]] number {} has corners, a round column has none: leave layer.from and layer.to out",
       layers_with_corners},
      {{"feed.from", "feed.to", "feed.species", "column.size", "column.shape", "column.profile"},
       "[[feed]] of {} reaches beyond the round column, {} m in diameter: move feed.from and feed.to inwards, or "
       "leave them out",
       feeds_beyond_the_circle},
      beyond_the_circle("jet", &Scene::jets),
      beyond_the_circle("discharge", &Scene::discharges),
      {{"column.cells", "column.size", "column.shape"},
       "column.cells: {} cells across and {} deep in a round column: at most four times as many one way",
       long_cells_in_a_cylinder}};
}

Broken wall_ends_miscounted(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.walls.size(); ++n) {
    const InnerWall& wall = scene.walls[n];
    const bool rod = wall.shape == WallShape::rod, alone = rod && wall.to.empty();
    if (wall.from.size() != 2 || (!alone && wall.to.size() != 2) || (rod && !alone && wall.from != wall.to))
      broken.add({std::to_string(wall.from.size()), std::to_string(wall.to.size())}, n);
  }
  return broken;
}

Broken walls_outside(const Scene& scene) {
  Broken broken;
  const auto& size = scene.column.size;
  for (std::size_t n = 0; n < scene.walls.size(); ++n) {
    const InnerWall& wall = scene.walls[n];
    const double across = scene.column.around_axis() ? 2 * size[0] : std::min(size[0], size[2]);
    const double width = wall.is_round() ? across : size[0];
    const auto beyond = [&](std::size_t d, double most) {
      return std::max(wall.from[d], wall.to[d]) > most * (1 + 1e-12);
    };
    if (beyond(0, width) || beyond(1, size[1]))
      broken.add({std::to_string(n + 1), fmt::format("{:.4g}", width), fmt::format("{:.4g}", size[1])}, n);
  }
  return broken;
}

Broken walls_without_length(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.walls.size(); ++n)
    if (scene.walls[n].shape != WallShape::rod && scene.walls[n].from == scene.walls[n].to)
      broken.add({std::to_string(n + 1)}, n);
  return broken;
}

Broken cylinders_of_two_diameters(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.walls.size(); ++n) {
    const InnerWall& wall = scene.walls[n];
    if (wall.shape == WallShape::cylinder && !wall.from.empty() && !wall.to.empty() && wall.from[0] != wall.to[0])
      broken.add({std::to_string(n + 1), fmt::format("{:.4g}", wall.from[0]), fmt::format("{:.4g}", wall.to[0])}, n);
  }
  return broken;
}

Broken walls_too_narrow(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.walls.size(); ++n) {
    const InnerWall& wall = scene.walls[n];
    if (!wall.is_round() || wall.from.empty() || wall.to.empty()) continue;
    const double narrowest = std::min(wall.from[0], wall.to[0]) - wall.thickness;
    if (wall.thickness > 0 && narrowest <= 0) continue;  // solid
    const auto large = std::find_if(scene.species.begin(), scene.species.end(),
                                    [&](const Species& species) { return too_narrow(narrowest, species); });
    if (large != scene.species.end())
      broken.add({std::to_string(n + 1), fmt::format("{:.4g}", narrowest), fmt::format("{:.4g}", 2 * large->diameter)},
                 n);
  }
  return broken;
}

/// Flat walls next to a round column or another round wall: both would push where they meet.
Broken flat_beside_round(const Scene& scene) {
  Broken broken;
  const bool round = scene.column.shape != ColumnShape::box || has_round_wall(scene);
  for (std::size_t n = 0; n < scene.walls.size(); ++n)
    if (round && !scene.walls[n].is_round()) broken.add({std::to_string(n + 1)}, n);
  return broken;
}

/// Least thickness of a wall in a fluid, m: no cell then has open parts on both sides of it. A rod of two cells closes
/// at least one.
double least_thickness(const Column& column, const InnerWall& wall) {
  std::array<double, 3> h{};
  for (std::size_t a = 0; a < 3; ++a) h[a] = column.size[a] / column.cells[a];
  if (wall.shape == WallShape::rod) return 2 * std::max(h[0], h[1]);
  const double along = wall.to[0] - wall.from[0], up = (wall.is_round() ? 2 : 1) * (wall.to[1] - wall.from[1]);
  const double across = wall.is_round() && !column.around_axis() ? std::hypot(h[0], h[2]) : h[0];
  return (across * std::abs(up) + h[1] * std::abs(along)) / std::hypot(along, up);
}

Broken walls_too_thin(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.walls.size(); ++n) {
    const InnerWall& wall = scene.walls[n];
    if (!scene.fluid.present() || wall.from.empty() || (wall.to.empty() && wall.shape != WallShape::rod)) continue;
    const double least = least_thickness(scene.column, wall);
    if (wall.thickness < least * (1 - 1e-9))
      broken.add({std::to_string(n + 1), fmt::format("{:.4g}", wall.thickness), fmt::format("{:.4g}", least)}, n);
  }
  return broken;
}

/// Walls in the way of what enters evenly through the bottom, and on which the size of the bed depends.
Broken walls_on_the_bottom(const Scene& scene) {
  Broken broken;
  const double least = scene.column.size[1] / scene.column.cells[1];
  for (std::size_t n = 0; n < scene.walls.size(); ++n) {
    const InnerWall& wall = scene.walls[n];
    if (!scene.fluid.present() || wall.from.size() != 2 || wall.to.size() != 2) continue;
    const double low = std::min(wall.from[1], wall.to[1]) - 0.5 * wall.thickness;
    if (low < least * (1 - 1e-9))
      broken.add({std::to_string(n + 1), fmt::format("{:.4g}", low), fmt::format("{:.4g}", least)}, n);
  }
  return broken;
}

/// A rule for walls inside the column: broken if a scene has one and `wrong` is true.
Rule wall_rule(const std::string& key, const std::string& message, bool (*wrong)(const Scene&)) {
  return {{"wall.from", key}, "[[wall]]: " + message, [wrong](const Scene& scene) {
            return broken_if(!scene.walls.empty() && wrong(scene));
          }};
}

std::vector<Rule> rules_of_each_wall() {
  return {
      {{"wall.from", "wall.to"},
       "wall.from and wall.to have {} and {} numbers: 2 here, x and y, or diameter and height of a round one",
       wall_ends_miscounted,
       true},
      {{"wall.from", "wall.to", "wall.shape", "species.diameter"},
       "[[wall]] number {} is {} m in diameter at its narrow end, less than two particles, {} m: widen it",
       walls_too_narrow,
       true},
      {{"wall.shape", "wall.from", "wall.to"},
       "[[wall]] number {} has diameters of {} and {} m: a cylinder has one; use shape = \"cone\"",
       cylinders_of_two_diameters},
      {{"wall.from", "wall.to", "wall.shape", "column.size"},
       "[[wall]] number {} does not lie in the column, {} m wide and {} m high",
       walls_outside},
      {{"wall.thickness", "wall.shape"},
       "[[wall]] number {} is a rod without thickness: give its diameter in wall.thickness",
       [](const Scene& scene) {
         Broken broken;
         for (std::size_t n = 0; n < scene.walls.size(); ++n)
           if (scene.walls[n].shape == WallShape::rod && scene.walls[n].thickness == 0)
             broken.add({std::to_string(n + 1)}, n);
         return broken;
       }},
      {{"wall.from", "wall.to"}, "[[wall]] number {} has no length: its ends are one point", walls_without_length},
      {{"wall.thickness", "wall.from", "wall.to", "column.size", "column.cells", "fluid.name"},
       "[[wall]] number {} is {} m thick, in the fluid it needs {} m or more on these cells, a rod twice as much as "
       "a cell: give wall.thickness, take smaller cells, or set fluid.name = \"none\"",
       walls_too_thin},
      {{"wall.from", "wall.to", "wall.thickness", "column.size", "column.cells", "fluid.name"},
       "[[wall]] number {} begins {} m above the bottom, through which the fluid enters: at least one cell, {} m",
       walls_on_the_bottom},
      {{"wall.shape", "column.shape"},
       "[[wall]] number {} is flat beside round walls: use shape = \"cone\" or \"cylinder\" for all of them, or "
       "column.shape = \"box\" and flat ones",
       flat_beside_round}};
}

/// Ports in the side of a cylinder end beyond two thirds of its radius.
bool is_clear_of_sides(const Column& column, const InnerWall& wall) {
  return column.is_round() && wall.is_round() && !wall.from.empty() && !wall.to.empty() &&
         std::max(wall.from[0], wall.to[0]) + wall.thickness <= 0.5 * column.size[0];
}

std::vector<Rule> rules_of_any_wall() {
  return {
      wall_rule("bed.start", "bed.start = \"layered\" cannot be combined with it in a fluid; use \"mixed\"",
                [](const Scene& scene) { return scene.fluid.present() && scene.bed.start.kind == StartKind::layered; }),
      wall_rule("column.sides", "column.sides = \"periodic\" would end it at the side; use \"wall\"",
                [](const Scene& scene) { return scene.column.sides == Boundary::periodic; }),
      wall_rule("column.ends", "column.ends = \"periodic\" cannot be combined with it; use \"wall\"",
                [](const Scene& scene) { return scene.column.ends == Boundary::periodic; }),
      wall_rule("column.size", "a cone or cylinder needs three dimensions; give column.size three numbers",
                [](const Scene& scene) {
                  return has_round_wall(scene) && scene.column.dimensions != 3 && !scene.column.around_axis();
                }),
      wall_rule("jet.at",
                "[[jet]], [[feed]] and [[discharge]] in the sides cannot be combined with it in a fluid yet, except in "
                "a cylinder where it is round and at most half as wide",
                [](const Scene& scene) {
                  const auto aside = [](const auto& parts) {
                    return std::any_of(parts.begin(), parts.end(), [](const auto& part) { return is_side(part.at); });
                  };
                  const bool clear = std::all_of(scene.walls.begin(), scene.walls.end(), [&](const InnerWall& wall) {
                    return is_clear_of_sides(scene.column, wall);
                  });
                  return scene.fluid.present() && !clear &&
                         (aside(scene.jets) || aside(scene.feeds) || aside(scene.discharges));
                }),
      wall_rule("bed.start", "bed.start = \"random\" would place particles on both sides of it; use \"mixed\"",
                [](const Scene& scene) { return scene.bed.start.kind == StartKind::random; })};
}

}  // namespace

std::vector<Rule> wall_rules() {
  std::vector<Rule> rules;
  for (const auto& part : {round_column_rules(), profile_rules(), rules_of_each_wall(), rules_of_any_wall()})
    rules.insert(rules.end(), part.begin(), part.end());
  return rules;
}

}  // namespace polybed::core
