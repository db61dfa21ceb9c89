// Ways to halve the time of a run, with their known loss.
#include "multiscale/estimate/estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/case/case_rules.hpp"

namespace polybed::multiscale {

namespace {

constexpr std::size_t most_ways = 3;

Way more_ranks(int ranks, double time, const char* where) {
  return {fmt::format("polybed -n {}", 2 * ranks), time,
          fmt::format("costs no accuracy; shortens the wall time only{}", where), "measured"};
}

Way shorter(const core::Scene& scene) {
  return {fmt::format("run.until = \"{:.4g} s\"", scene.run.until / 2), 0.5,
          "intervals of means 1.4 times as wide; too short if the bed still drifts then", "extrapolated"};
}

/// Whether a round column can have these cells across: a narrow one needs enough open cells.
bool takes_wider_cells(core::Scene scene, double ratio) {
  for (const std::size_t axis : {0, 2}) scene.column.cells[axis] = std::max(int(scene.column.cells[axis] / ratio), 1);
  return core::problems_of(core::wall_rules(), scene).empty();
}

void add_coarser(std::vector<Way>& ways, const core::Scene& scene, bool implicit) {
  // An explicit step scales with the cells; an implicit one does not if free fall through a cell limits it.
  const int powers = scene.column.dimensions + (implicit ? 0 : 1);
  const double ratio = std::pow(2.0, 1.0 / powers);
  if (!takes_wider_cells(scene, ratio)) return;
  ways.push_back({fmt::format("column.cells divided by {:.2f}", ratio), 0.5,
                  fmt::format("error of the cell size {:.2f} times as large, if it is of first order as at a sharp "
                              "interface",
                              ratio),
                  "extrapolated"});
}

/// A box becomes two-dimensional, a round column rings; rings and two dimensions become one column of cells.
void add_fewer_dimensions(std::vector<Way>& ways, const core::Scene& scene) {
  const core::Column& column = scene.column;
  const int across = column.cells[0], deep = column.cells[2];
  const auto all = [](const auto& parts, auto&& is) { return std::all_of(parts.begin(), parts.end(), is); };
  const auto whole = [](const auto& part) { return part.from.empty(); };
  const bool all_across = scene.jets.empty() && all(scene.feeds, whole) && all(scene.discharges, whole);
  const auto at_an_end = [](const auto& part) { return !is_side(part.at); };
  if (!all(scene.jets, at_an_end) || !all(scene.feeds, at_an_end) || !all(scene.discharges, at_an_end)) return;
  if (column.is_round() && all_across)
    ways.push_back({fmt::format("column.shape = \"axisymmetric\", column.size = [radius, height], column.cells = "
                                "[{}, {}]",
                                (across + 1) / 2, column.even_layers()),
                    0.5 / deep, "all is alike around the axis: bubbles and eddies are rings", "literature"});
  else if (column.dimensions == 3 && !column.is_round())
    ways.push_back({"two dimensions: column.size = [width, height]", 1.0 / deep,
                    "bubbles and eddies are larger in two dimensions than in three", "literature"});
  else if (column.dimensions == 2 && across > 1 && takes_wider_cells(scene, across))
    ways.push_back({"column.cells = [1, ...]", 1.0 / across,
                    "no motion across the bed: layers stay sharper than they are", "literature"});
}

std::vector<Way> first_ways(std::vector<Way> ways) {
  if (ways.size() > most_ways) ways.resize(most_ways);
  return ways;
}

}  // namespace

std::vector<Way> tfm_ways(const core::Scene& scene, bool implicit, int ranks, int cores) {
  std::vector<Way> ways;
  const double cells = double(scene.column.cells[0]) * scene.column.cells[1] * scene.column.cells[2];
  constexpr double enough_cells = 20000;  // below it waiting costs as much as sharing saves
  if (2 * ranks <= cores && cells / ranks >= enough_cells)
    ways.push_back(more_ranks(ranks, 0.58, ", 1.7 times as fast"));
  constexpr double loosest = 1e-2, factor = 8;  // steps of a second-order method scale with the third root of rtol
  if (implicit && scene.tfm.rtol * factor <= loosest)
    ways.push_back({fmt::format("relative tolerance tfm.rtol = {:.2g}", factor * scene.tfm.rtol), 0.5,
                    "error of the time integration 8 times as large", "extrapolated"});
  add_coarser(ways, scene, implicit);
  ways.push_back(shorter(scene));
  add_fewer_dimensions(ways, scene);
  return first_ways(std::move(ways));
}

std::vector<Way> dem_ways(const core::Scene& scene, const std::string& limited_by, int ranks, int cores) {
  std::vector<Way> ways;
  if (2 * ranks <= cores) ways.push_back(more_ranks(ranks, 0.55, ""));
  const double steps = scene.dem.steps_per_contact;
  const bool contact = limited_by.starts_with("contact") || limited_by.starts_with("oscillation");
  if (contact && !scene.dem.fixed_step) {
    if (steps >= 20)
      ways.push_back({fmt::format("dem.steps_per_contact = {:.3g}", steps / 2), 0.5,
                      fmt::format("collisions less exact: a restitution of 0.9 is off by up to {}",
                                  steps >= 40 ? "0.002" : "0.01"),
                      "measured"});
    // The duration of a contact scales with E^(-2/5), Hertz.
    const double softer = std::pow(2.0, 2.5);
    ways.push_back({fmt::format("Young's moduli divided by {:.2g}", softer), 0.5,
                    "larger overlaps; contacts four times as long changed the pressure of collisions by 2 % at most",
                    "measured"});
  }
  ways.push_back(shorter(scene));
  return first_ways(std::move(ways));
}

}  // namespace polybed::multiscale
