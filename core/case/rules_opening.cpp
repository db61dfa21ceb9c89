// Requirements on parts of the column's ends and sides (jets, feeds, discharges), on layers, and on an opening that
// particles fall through.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "core/case/case_rules.hpp"
#include "core/case/resolve.hpp"
#include "core/case/size_classes.hpp"

namespace polybed::core {

namespace {

/// Number of coordinates of a corner.
std::size_t corner_size(const Scene& scene) { return scene.column.given_size.size() == 3 ? 2 : 1; }

/// The extent of a whole end or side or, for a layer, of the whole cross-section.
template <class Part>
bool is_all(const Part& part) {
  return !std::is_same_v<Part, Jet> && part.from.empty() && part.to.empty();
}

/// The end or side that the corners of a part refer to; for a layer, the bottom.
template <class Part>
ColumnFace place_of(const Part& part) {
  if constexpr (requires { part.at; }) return part.at;
  return ColumnFace::bottom;
}

template <class Part>
std::string name_of_place(const Part& part) {
  if (std::is_same_v<Part, Layer>) return "in the column";
  return fmt::format("on the {}{}", name_of(place_of(part)), is_side(place_of(part)) ? " side" : "");
}

template <class Part>
Broken corners_miscounted(const Scene& scene, const std::vector<Part>& parts) {
  Broken broken;
  const std::size_t n = corner_size(scene);
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (!is_all(parts[k]) && (parts[k].from.size() != n || parts[k].to.size() != n))
      broken.add({std::to_string(parts[k].from.size()), std::to_string(parts[k].to.size()), std::to_string(n)},
                 entry_of(scene, parts, k));
  return broken;
}

template <class Part>
Broken beside_the_end(const Scene& scene, const std::vector<Part>& parts) {
  Broken broken;
  const std::vector<double>& given = scene.column.given_size;  // width, then the depth if there is one, and height
  const std::array<double, 3> size{given.front(), given.back(), given[1]};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const Part& part = parts[k];
    for (std::size_t d = 0; d < part.from.size(); ++d) {
      const double most = size[std::size_t(axis_along(place_of(part), int(given.size()), d))];
      const bool ordered = part.from[d] < part.to[d];
      if (ordered && part.to[d] <= most * (1 + 1e-12)) continue;
      broken.add({fmt::format("{:.4g}", part.from[d]), fmt::format("{:.4g}", part.to[d]),
                  ordered ? fmt::format("does not lie {}, 0 to {:.4g} m", name_of_place(part), most)
                          : "ends before it starts: \"from\" must be below \"to\""},
                 entry_of(scene, parts, k));
      break;
    }
  }
  return broken;
}

/// True if two parts have nothing in common. A part without corners is its whole end or side.
template <class Part, class Other>
bool apart(const Part& a, const Other& b) {
  if (a.at != b.at) return true;
  for (std::size_t d = 0; d < std::min(a.from.size(), b.from.size()); ++d)
    if (a.to[d] <= b.from[d] || b.to[d] <= a.from[d]) return true;
  return false;
}

template <class Part>
Broken overlap_each_other(const std::vector<Part>& parts) {
  Broken broken;
  for (std::size_t a = 0; a < parts.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (!apart(parts[a], parts[b])) broken.add({std::to_string(b + 1), std::to_string(a + 1)}, a);
  return broken;
}

template <class Part>
Broken at_the_top(const std::vector<Part>& parts) {
  Broken broken;
  for (std::size_t n = 0; n < parts.size(); ++n)
    if (parts[n].at == ColumnFace::top) broken.add({}, n);
  return broken;
}

/// Finds inflows that overlap a discharge.
Broken discharges_overlap_inflows(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.discharges.size(); ++n) {
    const auto see = [&](const auto& parts, const char* table) {
      for (std::size_t k = 0; k < parts.size(); ++k)
        if (!apart(scene.discharges[n], parts[k]))
          broken.add({std::to_string(n + 1), table, std::to_string(1 + *entry_of(scene, parts, k))}, n);
    };
    see(scene.jets, "jet");
    see(scene.feeds, "feed");
  }
  return broken;
}

Broken discharges_below_vacuum(const Scene& scene) {
  Broken broken;
  const Fluid& fluid = scene.fluid;
  for (std::size_t n = 0; n < scene.discharges.size() && fluid.equation_of_state == Compressibility::ideal_gas; ++n)
    if (const double pressure = scene.discharges[n].pressure.value_or(0); fluid.outlet_pressure + pressure <= 0)
      broken.add({fmt::format("{:g}", pressure), std::to_string(n + 1), fmt::format("{:g}", fluid.outlet_pressure)}, n);
  return broken;
}

Broken feeds_overlap(const Scene& scene) {
  Broken broken;
  for (std::size_t a = 0; a < scene.feeds.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Feed &one = scene.feeds[a], &other = scene.feeds[b];
      if (one.species == other.species && !apart(one, other))
        broken.add({one.species, std::to_string(1 + *entry_of(scene, scene.feeds, b)),
                    std::to_string(1 + *entry_of(scene, scene.feeds, a))},
                   entry_of(scene, scene.feeds, a));
    }
  return broken;
}

Broken feeds_of_no_species(const Scene& scene) {
  Broken broken;
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    const std::string& name = scene.feeds[n].species;
    if (std::none_of(scene.species.begin(), scene.species.end(), [&](const auto& s) { return s.name == name; }))
      broken.add({name}, entry_of(scene, scene.feeds, n));
  }
  return broken;
}

Broken feeds_denser_than_the_bed(const Scene& scene) {
  Broken broken;
  const double settled = scene.bed.solids_fraction;
  for (std::size_t n = 0; n < scene.feeds.size(); ++n) {
    const Feed& feed = scene.feeds[n];
    for (const auto& [time, flux] : feed.superficial_velocity)
      if (flux > settled * feed.velocity)
        broken.add({feed.species, fmt::format("{:.4g}", flux), fmt::format("{:.4g}", feed.velocity),
                    fmt::format("{:.4g}", flux / settled)},
                   entry_of(scene, scene.feeds, n));
  }
  return broken;
}

/// Where a port can lie beside a profile: "from 0.1 to 0.2 m".
std::string widest_heights(const Column& column) {
  const auto& profile = column.profile;
  std::string text;
  for (std::size_t k = 1; k < profile.size(); ++k)
    if (std::min(profile[k - 1].second, profile[k].second) >= column.widest() * (1 - 1e-9))
      text +=
          fmt::format("{}from {:.4g} to {:.4g} m", text.empty() ? "" : " or ", profile[k - 1].first, profile[k].first);
  return text.empty() ? "nowhere over a straight part" : text;
}

/// Finds ports in a cone, or in another part of the wall inside the widest one. One without corners is the whole side.
template <class Part>
Broken ports_in_a_narrow_part(const Scene& scene, const std::vector<Part>& parts) {
  Broken broken;
  const auto& profile = scene.column.profile;
  if (scene.column.shape == ColumnShape::box || profile.empty()) return broken;
  const double widest = scene.column.widest(), near = 1e-9 * profile.back().first;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Part& part = parts[n];
    if (!is_side(part.at)) continue;
    const double low = part.from.empty() ? profile.front().first : part.from.back(),
                 high = part.to.empty() ? profile.back().first : part.to.back();
    bool fits = true;
    for (std::size_t k = 1; k < profile.size(); ++k)
      if (profile[k].first > low + near && profile[k - 1].first < high - near)
        fits = fits && std::min(profile[k - 1].second, profile[k].second) >= widest * (1 - 1e-9);
    if (!fits)
      broken.add({std::string(name_of(part.at)), fmt::format("{:.4g}", low), fmt::format("{:.4g}", high),
                  fmt::format("{:.4g}", widest), widest_heights(scene.column)},
                 entry_of(scene, parts, n));
  }
  return broken;
}

/// Finds ports in the side of a cylinder that do not lie in the quarter of the wall on that side. One without corners
/// is the whole side.
template <class Part>
Broken ports_off_their_side(const Scene& scene, const std::vector<Part>& parts) {
  Broken broken;
  if (!scene.column.is_round() || scene.column.given_size.size() != 3) return broken;
  const double diameter = scene.column.given_size[0], margin = 0.5 * (1 - std::sqrt(0.5)) * diameter;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const Part& part = parts[n];
    if (!is_side(part.at) || (!part.from.empty() && (part.from.size() != 2 || part.to.size() != 2))) continue;
    const bool fits =
        !part.from.empty() && part.from[0] >= margin * (1 - 1e-9) && part.to[0] <= (diameter - margin) * (1 + 1e-9);
    if (!fits)
      broken.add({std::string(name_of(part.at)), fmt::format("{:g}", 1e-6 * std::ceil(1e6 * margin)),
                  fmt::format("{:g}", 1e-6 * std::floor(1e6 * (diameter - margin)))},
                 entry_of(scene, parts, n));
  }
  return broken;
}

/// Rules for the position of jets, feeds or discharges.
template <class Part>
std::vector<Rule> place_rules(const std::string& table, std::vector<Part> Scene::*parts) {
  const std::string from = table + ".from", to = table + ".to", at = table + ".at";
  using Test = bool (*)(const Column&, ColumnFace);
  const auto rule = [&](const std::string& key, const std::string& message, Test wrong) {
    return Rule{{at, key}, at + " = \"{}\"" + message, [parts, wrong](const Scene& scene) {
                  Broken broken;
                  for (std::size_t n = 0; n < (scene.*parts).size(); ++n)
                    if (const ColumnFace face = (scene.*parts)[n].at; is_side(face) && wrong(scene.column, face))
                      broken.add({std::string(name_of(face))}, entry_of(scene, scene.*parts, n));
                  return broken;
                }};
  };
  return {
      {{from, to, "column.size"},
       from + " and " + to + " have {} and {} numbers: {} here",
       [parts](const Scene& scene) { return corners_miscounted(scene, scene.*parts); },
       true},
      {{from, to, at, "column.size"},
       "a " + table + " from {} to {} m {}",
       [parts](const Scene& scene) { return beside_the_end(scene, scene.*parts); }},
      rule("column.size", ": a column of two dimensions has two sides, left and right",
           [](const Column& column, ColumnFace face) { return column.dimensions == 2 && axis_of(face) == 2; }),
      rule("column.sides", " and column.sides = \"periodic\" contradict each other: joined sides have no wall",
           [](const Column& column, ColumnFace) { return column.sides == Boundary::periodic; }),
      rule("column.shape", " is no side of an axisymmetric column, whose wall is \"right\"",
           [](const Column& column, ColumnFace face) { return column.around_axis() && face == ColumnFace::left; }),
      {{at, from, to, "column.profile", "column.shape"},
       at + " = \"{}\", from {} to {} m: a port lies where column.profile has its greatest diameter, {} m, as the grid "
            "ends there: {}",
       [parts](const Scene& scene) { return ports_in_a_narrow_part(scene, scene.*parts); }},
      {{at, from, to, "column.shape", "column.size"},
       at + " = \"{}\" in a cylinder: " + from + " and " + to +
           " lie between {} and {} m across, where the wall faces that side: a part of the next side takes the rest",
       [parts](const Scene& scene) { return ports_off_their_side(scene, scene.*parts); }}};
}

std::vector<Rule> jet_rules() {
  std::vector<Rule> rules = place_rules("jet", &Scene::jets);
  rules.push_back({{"jet.at"}, "jet.at = \"top\": a jet enters through the bottom or a side", [](const Scene& scene) {
                     return at_the_top(scene.jets);
                   }});
  rules.push_back({{"jet.from", "jet.to", "jet.at", "column.size"},
                   "two jets overlap: [[jet]] number {} and {}",
                   [](const Scene& scene) { return overlap_each_other(scene.jets); }});
  return rules;
}

std::vector<Rule> discharge_rules() {
  std::vector<Rule> rules = place_rules("discharge", &Scene::discharges);
  rules.push_back({{"discharge.at"},
                   "discharge.at = \"top\": a discharge lies in the bottom or a side; solids leave through the top by "
                   "column.outlet = \"open\"",
                   [](const Scene& scene) { return at_the_top(scene.discharges); }});
  const auto add = [&](const std::string& key, const std::string& message, auto wrong) {
    rules.push_back({{"discharge.at", "discharge.pressure", key}, message, [wrong](const Scene& scene) {
                       Broken broken;
                       for (std::size_t n = 0; n < scene.discharges.size(); ++n)
                         if (wrong(scene, scene.discharges[n])) broken.add({std::to_string(n + 1)}, n);
                       return broken;
                     }});
  };
  add("discharge.superficial_velocity",
      "[[discharge]] number {} takes discharge.superficial_velocity or, in a side, discharge.pressure: give one of "
      "them",
      [](const Scene&, const Discharge& d) { return d.superficial_velocity.empty() != d.pressure.has_value(); });
  add("discharge.pressure",
      "[[discharge]] number {} in the bottom cannot have a pressure, as the distributor's flow is given: use "
      "discharge.superficial_velocity",
      [](const Scene&, const Discharge& d) { return d.pressure && d.at == ColumnFace::bottom; });
  add("inlet.at",
      "[[discharge]] number {} has a pressure, but inlet.at = \"top\" gives the flow at both ends: use "
      "discharge.superficial_velocity, or column.outlet = \"lid\" without inlet.at",
      [](const Scene& s, const Discharge& d) { return d.pressure && s.inlet.at == ColumnEnd::top; });
  rules.push_back(
      {{"column.outlet", "discharge.pressure", "discharge.at", "fluid.name"},
       "column.outlet = \"lid\" needs a [[discharge]] with discharge.pressure, through which leaves what enters",
       [](const Scene& s) {
         const auto open = [](const Discharge& d) { return d.pressure.has_value(); };
         return broken_if(s.column.outlet == Outlet::lid && !s.column.closed && s.fluid.present() &&
                          std::none_of(s.discharges.begin(), s.discharges.end(), open));
       }});
  rules.push_back({{"discharge.pressure", "fluid.outlet_pressure", "fluid.equation_of_state"},
                   "discharge.pressure = {} Pa of [[discharge]] number {} is below vacuum: it is relative to "
                   "fluid.outlet_pressure = {} Pa; raise one of them",
                   discharges_below_vacuum});
  rules.push_back({{"discharge.from", "discharge.to", "discharge.at", "column.size"},
                   "two discharges overlap: [[discharge]] number {} and {}",
                   [](const Scene& scene) { return overlap_each_other(scene.discharges); }});
  rules.push_back({{"discharge.from", "discharge.to", "discharge.at", "jet.", "feed.", "column.size"},
                   "[[discharge]] number {} overlaps [[{}]] number {}",
                   discharges_overlap_inflows});
  return rules;
}

std::vector<Rule> layer_corner_rules() {
  return {{{"layer.from", "layer.to", "column.size"},
           "layer.from and layer.to have {} and {} numbers: {} here",
           [](const Scene& scene) { return corners_miscounted(scene, scene.layers); },
           true},
          {{"layer.from", "layer.to", "column.size"},
           "a layer from {} to {} m {}",
           [](const Scene& scene) { return beside_the_end(scene, scene.layers); },
           true}};
}

std::vector<Rule> feed_rules() {
  std::vector<Rule> rules = place_rules("feed", &Scene::feeds);
  const std::vector<Rule> own{
      {{"feed.species", "species.name"}, "feed.species = \"{}\": no such species", feeds_of_no_species},
      {{"feed.superficial_velocity", "feed.velocity", "bed.solids_fraction"},
       "a feed of {} of {} m/s at a velocity of {} m/s would be denser than the settled bed: raise feed.velocity "
       "above {} m/s",
       feeds_denser_than_the_bed},
      {{"feed.from", "feed.to", "feed.species", "feed.at", "column.size"},
       "two feeds of {} overlap: [[feed]] number {} and {}",
       feeds_overlap}};
  rules.insert(rules.end(), own.begin(), own.end());
  return rules;
}

/// A rule for the opening that particles fall through. \param broken  words after "the width of the opening"
Rule opening_rule(std::vector<std::string> rests_on, const std::string& message,
                  std::function<Broken(const Scene&)> broken) {
  rests_on.insert(rests_on.begin(), "dem.opening");
  return {std::move(rests_on), "dem.opening = {} m: " + message, [broken = std::move(broken)](const Scene& scene) {
            Broken all;
            if (!scene.dem.opening) return all;
            const Broken found = broken(scene);
            for (const Broken::Fault& fault : found.faults()) {
              Broken::Words words = fault.words;
              words.insert(words.begin(), fmt::format("{:g}", *scene.dem.opening));
              all.add(std::move(words));
            }
            return all;
          }};
}

Broken wider_than_the_bottom(const Scene& scene) {
  Broken broken;
  const double width = *scene.dem.opening;
  const Column& column = scene.column;
  if (width >= column.size[0]) broken.add({fmt::format("{:g}", column.size[0]), "wide"});
  if (column.dimensions == 3 && width >= column.size[2]) broken.add({fmt::format("{:g}", column.size[2]), "deep"});
  return broken;
}

std::vector<Rule> bottom_rules() {
  return {
      opening_rule({"fluid.name"},
                   "a fluid enters there, and particles leave through the top alone (column.outlet = \"open\"); set "
                   "fluid.name = \"none\"",
                   [](const Scene& scene) { return broken_if(scene.fluid.present()); }),
      opening_rule({"discharge.at"}, "a [[discharge]] opens the bottom, too: leave one of them out",
                   [](const Scene& scene) {
                     return broken_if(std::any_of(scene.discharges.begin(), scene.discharges.end(),
                                                  [](const auto& d) { return d.at == ColumnFace::bottom; }));
                   }),
      opening_rule({"column.ends"}, "column.ends = \"periodic\" leaves no bottom to open",
                   [](const Scene& scene) { return broken_if(scene.column.ends == Boundary::periodic); }),
      opening_rule({"column.size"}, "it must be narrower than the bottom, which is {} m {}", wider_than_the_bottom),
      opening_rule({"species.diameter"}, "the largest particle, of {} m, must fit through", [](const Scene& scene) {
        const double largest = largest_diameter(scene);
        return *scene.dem.opening < largest ? Broken({fmt::format("{:g}", largest)}) : Broken();
      })};
}

}  // namespace

std::vector<Rule> opening_rules() {
  std::vector<Rule> rules;
  for (const auto& part : {jet_rules(), layer_corner_rules(), feed_rules(), discharge_rules(), bottom_rules()})
    rules.insert(rules.end(), part.begin(), part.end());
  return rules;
}

}  // namespace polybed::core
