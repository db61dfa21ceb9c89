#include "multiscale/scene_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "closures/terminal_velocity.hpp"
#include "core/case/resolve.hpp"
#include "multiscale/scene_rules.hpp"
#include "relevance/drag_file.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using Table = std::vector<std::pair<double, double>>;  ///< (time, velocity)
using Lines = std::vector<std::string>;

/// Inflows through the bottom, or through the bottom and both ways through the sides, each with its name.
std::vector<std::pair<std::string, Table>> inflows_of(const core::Scene& scene, bool sides = false) {
  std::vector<std::pair<std::string, Table>> inflows{{"inlet.superficial_velocity", scene.inlet.superficial_velocity}};
  for (std::size_t n = 0; n < scene.jets.size(); ++n)
    if (sides || !is_side(scene.jets[n].at))
      inflows.emplace_back(fmt::format("superficial_velocity of [[jet]] number {}", n + 1),
                           scene.jets[n].superficial_velocity);
  for (std::size_t n = 0; sides && n < scene.discharges.size(); ++n)
    inflows.emplace_back(fmt::format("superficial_velocity of [[discharge]] number {}", n + 1),
                         scene.discharges[n].superficial_velocity);
  return inflows;
}

/// Least value, m/s; 0 if none is negative. Likewise the greatest.
double least_of(const Table& table) {
  double least = 0;
  for (const auto& [time, velocity] : table) least = std::min(least, velocity);
  return least;
}
double greatest_of(const Table& table) {
  double greatest = 0;
  for (const auto& [time, velocity] : table) greatest = std::max(greatest, velocity);
  return greatest;
}

bool has_shares(const core::Scene& scene) { return scene.bed.volume_share.size() == scene.species.size(); }

/// Whether the bed as a whole is lighter than the fluid.
bool floats(const core::Scene& scene, double fluid_density) {
  double excess = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    excess += (has_shares(scene) ? scene.bed.volume_share[j] : 1) * (scene.species[j].density - fluid_density);
  return excess < 0;
}

/// Speed, m/s, of a lone particle of the species that rises fastest.
double fastest_rise(const core::Scene& scene, const relevance::FluidConstants& fluid) {
  double rise = 0;
  for (const core::Species& s : scene.species)
    if (s.density < fluid.density)
      rise = std::max(rise,
                      closures::settling_velocity(s.diameter, fluid.density - s.density, fluid.density, fluid.viscosity,
                                                  scene.column.gravity, relevance::shape_of(scene, s)));
  return rise;
}

/// Warns of fluid drawn out at the bottom.
void warn_of_downflow(const core::Scene& scene, const relevance::FluidConstants& fluid, Lines& warnings) {
  const bool hangs = scene.column.gravity > 0 && floats(scene, fluid.density) &&
                     -least_of(scene.inlet.superficial_velocity) < fastest_rise(scene, fluid);
  for (const auto& [name, table] : inflows_of(scene)) {
    const double velocity = least_of(table);
    if (!(velocity < 0)) continue;
    warnings.push_back(fmt::format("{} = {:.4g} m/s is negative: fluid leaves at the bottom and enters at the top, {}",
                                   name, velocity,
                                   hangs ? "and the bed hangs from the top" : "and the bed is pressed down"));
  }
  if (hangs && least_of(scene.inlet.superficial_velocity) < 0 && scene.inlet.at == core::ColumnEnd::bottom &&
      scene.column.cells[0] * scene.column.cells[2] > 1)
    warnings.emplace_back(
        "a bed that hangs has no prescribed velocity above it: the fluid enters where the bed is thin, so that "
        "a channel forms and the rest of the bed is up to a third too dense: use inlet.at = \"top\", which spreads the "
        "flow evenly there too");
}

void warn_of_floating_species(const core::Scene& scene, double density, Lines& warnings) {
  const auto inflows = inflows_of(scene);
  if (std::none_of(inflows.begin(), inflows.end(), [](const auto& inflow) { return greatest_of(inflow.second) > 0; }))
    return;
  for (const core::Species& species : scene.species)
    if (species.density < density)
      warnings.push_back(
          fmt::format("species \"{}\" ({:.4g} kg/m3) is lighter than the fluid ({:.4g} kg/m3), which flows in "
                      "from below: it floats up and {}",
                      species.name, species.density, density,
                      scene.column.outlet == core::Outlet::open ? "leaves at the top" : "gathers under the screen"));
}

/// Warns of a law in a file that was not fitted to the settled bed or to the greatest velocity of the inlet.
void warn_of_fitted_range(const core::Scene& scene, const relevance::FluidConstants& fluid, Lines& warnings) {
  const std::string name = scene.drag().name;
  if (!relevance::drag_file(name)) return;
  const closures::DragLaw law = relevance::drag_law_of(scene);
  const std::string range = relevance::fitted_range(law);
  if (!range.empty() && !law.fitted_to)
    warnings.push_back(
        fmt::format("effects.drag = \"{}\": range unknown; the file does not contain that of its rows", name));
  if (!law.fitted_to) return;
  double shares = 0, per_mean = 0;
  for (std::size_t j = 0; j < scene.species.size(); ++j) {
    const double share = has_shares(scene) ? scene.bed.volume_share[j] : 1;
    shares += share;
    per_mean += share / scene.species[j].diameter;
  }
  const double velocity = greatest_of(scene.inlet.superficial_velocity), settled = 1 - scene.bed.solids_fraction,
               reynolds = fluid.density * velocity * shares / per_mean / fluid.viscosity;
  if (!law.fitted_to->contains(settled, reynolds))
    warnings.push_back(
        fmt::format("effects.drag = \"{}\" was fitted to {}, and the case has voidage {:.3g} as it settles and Re "
                    "{:.3g} of the Sauter "
                    "diameter at {:.3g} mm/s: outside, the law is extrapolated",
                    name, range, settled, reynolds, 1e3 * velocity));
}

/// Warns of a fast gas without compressibility: its density changes by M^2/2 where it stops.
void warn_of_fast_gas(const core::Scene& scene, double density, Lines& warnings) {
  constexpr double adiabatic_exponent = 1.4, fast = 0.3;  // 5 % of the density
  if (scene.fluid.compressible() || density >= relevance::lightest_liquid) return;
  const double sound = std::sqrt(adiabatic_exponent * scene.fluid.outlet_pressure / density);
  for (const auto& [name, table] : inflows_of(scene, true)) {
    const double mach = std::max(greatest_of(table), -least_of(table)) / sound;
    if (mach > fast)
      warnings.push_back(fmt::format(
          "{} reaches {:.2g} times the speed of sound, {:.3g} m/s, in a gas that is incompressible here: its density "
          "would change by about {:.0f} %; use fluid.equation_of_state = \"ideal_gas\", or a slower flow",
          name, mach, sound, 100 * std::min(0.5 * mach * mach, 1.0)));
  }
}

/// Warns of a pressure outside a discharge beyond the weight of the whole column, filled with its densest material.
void warn_of_absolute_pressure(const core::Scene& scene, double density, Lines& warnings) {
  constexpr double half_an_atmosphere = 0.5 * 101325;
  double densest = density;
  for (const core::Species& species : scene.species) densest = std::max(densest, species.density);
  const double weight = densest * scene.column.gravity * scene.column.size[1];
  const double most = weight > 0 ? weight : half_an_atmosphere;
  for (std::size_t n = 0; n < scene.discharges.size(); ++n)
    if (const double pressure = scene.discharges[n].pressure.value_or(0); std::abs(pressure) > most)
      warnings.push_back(fmt::format(
          "discharge.pressure = {:g} Pa of [[discharge]] number {} exceeds {:.3g} Pa, the weight of the full column "
          "over its area, and drives the fluid {} with up to {:.3g} m/s: it is relative to the fluid at rest, 0 for an "
          "overflow; from an absolute pressure subtract the pressure at the top and that of the fluid below it",
          pressure, n + 1, most, pressure > 0 ? "in" : "out", std::sqrt(2 * std::abs(pressure) / density)));
}

/// Warns of spheres denser than random packing.
void warn_of_dense_packing(const core::Scene& scene, Lines& warnings) {
  constexpr double random_packing = 0.64, margin = 0.01;
  if (!has_shares(scene) || scene.species.empty()) return;
  const double densest = packing_of_sizes(scene, random_packing), given = scene.bed.solids_fraction;
  if (given > densest + margin)
    warnings.push_back(fmt::format(
        "bed.solids_fraction = {:g}: spheres of these sizes pack at random to {:.2g} at most, only a crystal "
        "is denser; such a bed is {:.0f} % higher when it has settled at random, and its drag lower",
        given, densest, 100 * (given / densest - 1)));
}

constexpr double least_rows = 4, least_diameters = 1.5;  // of cells in a bed; of the largest particles in a cell

/// Whether no grid can have both: the bed is a few particles high.
bool is_thin(const core::Scene& scene) {
  return scene.bed.static_height < least_rows * least_diameters * core::largest_diameter(scene);
}

/// Warns if the settled bed or the whole column has too few rows of cells.
void warn_of_coarse_grid(const core::Scene& scene, Lines& warnings) {
  const double row = scene.column.cell(1), bed = scene.bed.static_height;
  if (scene.bed.held || !scene.feeds.empty() || scene.flows_around() || !(bed > 0)) return;
  if (const double rows = bed / row; rows < least_rows || scene.column.cells[1] < least_rows)
    warnings.push_back(fmt::format(
        "column.cells: the settled bed of {:.3g} mm is {:.2g} rows of cells high, {:.3g} mm each: heights are "
        "off by up to a row, the pressure drop by up to 60 %; {}",
        1e3 * bed, rows, 1e3 * row,
        is_thin(scene) ? fmt::format("no grid suits a bed of {:.2g} of the largest diameters: use polybed dem",
                                     bed / core::largest_diameter(scene))
                       : fmt::format("take rows of {:.2g} mm",
                                     1e3 * std::max(bed / 10, least_diameters * core::largest_diameter(scene)))));
}

void warn_of_graded_bed(const core::Scene& scene, Lines& warnings) {
  const core::Column& column = scene.column;
  if (column.layers.empty() || !(scene.bed.static_height > *column.graded_above)) return;
  warnings.push_back(fmt::format(
      "column.graded_above = {:.3g} m is below the top of the settled bed, {:.3g} m: the bed is computed in "
      "growing cells there; give at least the height of the expanded bed",
      *column.graded_above, scene.bed.static_height));
}

void warn_of_fine_grid(const core::Scene& scene, Lines& warnings) {
  double least = scene.column.cell(1);
  for (const std::size_t axis : {0, 2})
    if (scene.column.cells[axis] > 1) least = std::min(least, scene.column.cell(axis));
  const double largest = core::largest_diameter(scene);
  const bool thin = is_thin(scene) && !scene.bed.held && scene.feeds.empty() && !scene.flows_around();
  if (thin && scene.bed.static_height >= least_rows * least)
    warnings.push_back(fmt::format(
        "column.cells: the settled bed of {:.3g} mm is {:.2g} of the largest diameters high: no grid has both rows of "
        "some diameters and {:g} rows in the bed, so that the continuum has no meaning there: use polybed dem",
        1e3 * scene.bed.static_height, scene.bed.static_height / largest, least_rows));
  else if (least < largest && !thin)
    warnings.push_back(fmt::format(
        "column.cells: cells of {:.3g} mm are {:.2g} of the largest diameters wide: the equations average over "
        "many particles, so that what differs over less than some diameters has no meaning, and a finer grid "
        "shows more of it and does not converge; take cells of {:g} diameters or more",
        1e3 * least, least / largest, least_diameters));
}

/// Not rejected: cases in a chain are checked before the run whose checkpoint the next one needs.
void warn_of_missing_start(const core::Scene& scene, Lines& warnings) {
  const std::filesystem::path& path = scene.bed.start.file;
  std::error_code error;
  if (scene.bed.start.kind == core::StartKind::checkpoint && !std::filesystem::is_regular_file(path, error))
    warnings.push_back(
        fmt::format("bed.start = \"checkpoint:{}\": no such file yet, and a run begins from it", path.string()));
}

/// Warns of walls inside that too few cells resolve.
void warn_of_small_obstacles(const core::Scene& scene, Lines& warnings) {
  constexpr double least = 3;
  const core::Column& column = scene.column;
  const double cell = std::max(column.size[0] / column.cells[0], column.size[1] / column.cells[1]);
  for (std::size_t n = 0; n < scene.walls.size() && scene.fluid.present(); ++n)
    if (const double cells = scene.walls[n].thickness / cell; cells < least * (1 - 1e-9))
      warnings.push_back(fmt::format(
          "[[wall]] number {} is {:.2g} cells thick: its flow is that around a thicker, rougher one; {} cells or more "
          "resolve it",
          n + 1, cells, least));
}

}  // namespace

std::vector<std::string> scene_warnings(const core::Scene& scene) {
  Lines warnings;
  warn_of_missing_start(scene, warnings);
  if (!scene.fluid.present()) return warnings;
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const double density = fluid.density;
  warn_of_downflow(scene, fluid, warnings);
  if (scene.column.gravity > 0) warn_of_floating_species(scene, density, warnings);
  warn_of_fitted_range(scene, fluid, warnings);
  warn_of_fast_gas(scene, density, warnings);
  warn_of_absolute_pressure(scene, density, warnings);
  if (scene.column.around_axis() && density < relevance::lightest_liquid)
    warnings.push_back(
        "column.shape = \"axisymmetric\": a bubble in the gas is a ring about the axis there, and height and swings "
        "of a bubbling bed differ from those in a tube; \"cylinder\" resolves bubbles");
  if (scene.bed.start.kind != core::StartKind::list) warn_of_dense_packing(scene, warnings);
  return warnings;
}

std::vector<std::string> grid_warnings(const core::Scene& scene) {
  Lines warnings;
  warn_of_small_obstacles(scene, warnings);
  warn_of_coarse_grid(scene, warnings);
  warn_of_graded_bed(scene, warnings);
  warn_of_fine_grid(scene, warnings);
  return warnings;
}

}  // namespace polybed::multiscale
