#include "multiscale/resolve/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "closures/mixture.hpp"
#include "closures/terminal_velocity.hpp"
#include "multiscale/resolve/lattice/lattice.hpp"
#include "multiscale/resolve/packing.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

/// Mean velocity in the pores, cells per step: a Mach number of 0.05, so that the fluid remains nearly incompressible
/// even where it is faster.
constexpr double pore_speed = 0.03;
/// The same for a sphere that falls alone: a Mach number of 0.09, half of that for hindered spheres.
constexpr double fall_speed = 0.05;
/// For Stokes flow: the drag does not depend on the viscosity, and a greater one makes the flow steady sooner.
constexpr double stokes_viscosity = 0.5, stokes_speed = 1e-3;
/// Windows of most boxes: 9 to 15, and 8 to 28 for flows with inertia, up to a Reynolds number of 40.
constexpr double usual_stokes = 10, usual_inertia = 20;
/// The limit at a Reynolds number above 0.
constexpr double most_viscosity = 1.0 / 6;
/// Box lengths that the fastest species falls while free spheres are simulated, hindered as voidage^3: the exponent of
/// Richardson and Zaki is 2.4 to 4.65.
constexpr double crossings = 10, hindrance = 3;
/// Box lengths that species of given velocity travel. Beyond, spheres meet the images of those that they have met and
/// pushed aside: contacts become rare, and each species has lanes of its own (record of resolved flow).
constexpr double travelled = 2.0 / 3;
/// Memory times of a pore before they start to travel.
constexpr double still_windows = 4;
/// Steps of spheres that travel between two resets of the mean density, at which a run can stop.
constexpr double travel_window = 200;
/// With fewer there is no sample after the first third.
constexpr std::int64_t least_steps = 100;

double sauter(const core::Scene& scene, const std::vector<double>& share) {
  std::vector<double> diameter;
  for (const core::Species& s : scene.species) diameter.push_back(s.diameter);
  return closures::sauter_diameter(share, diameter);
}

/// The fastest species alone in the fluid.
struct Fall {
  double speed = 0, viscosity = 0;  ///< m/s; kinematic, m2/s
};

Fall fall_of(const core::Scene& scene) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  Fall fall{0, fluid.viscosity / fluid.density};
  for (const core::Species& s : scene.species)
    fall.speed = std::max(fall.speed, closures::settling_velocity(s.diameter, s.density - fluid.density, fluid.density,
                                                                  fluid.viscosity, scene.column.gravity));
  return fall;
}

}  // namespace

std::vector<std::vector<int>> passed(const core::Scene& scene, double reynolds) {
  if (scene.resolve.motion != core::SphereMotion::moving) return {{}};
  std::vector<std::vector<int>> sets;
  for (std::size_t set = 1; set < std::size_t(1) << scene.species.size(); ++set) {
    std::vector<int> species;
    for (std::size_t j = 0; j < scene.species.size(); ++j)
      if ((set >> j & 1) != 0) species.push_back(int(j));
    if (reynolds > 0 || species.size() == 1) sets.push_back(std::move(species));
  }
  return sets;
}

bool is_passed(const ResolvePoint& point, std::size_t species) {
  return point.past.empty() || std::find(point.past.begin(), point.past.end(), int(species)) != point.past.end();
}

double factor_of(const std::vector<int>& past, int species, const core::Scene& scene, double reynolds) {
  const bool among = std::find(past.begin(), past.end(), species) != past.end();
  if (reynolds == 0) return among ? 1 : 0;
  const double all = double(scene.species.size()), size = double(past.size());
  return among ? std::tgamma(size) * std::tgamma(all - size + 1) / std::tgamma(all + 1)
               : -std::tgamma(size + 1) * std::tgamma(all - size) / std::tgamma(all + 1);
}

bool places_move(const core::Scene& scene, const ResolvePoint& point) {
  return scene.resolve.motion == core::SphereMotion::moving && point.reynolds > 0 && !point.past.empty() &&
         point.past.size() < scene.species.size();
}

double cells_of(const core::Resolve& resolve, int grid) { return resolve.cells_per_diameter / std::pow(1.5, grid); }

double least_diameter(const core::Scene& scene) {
  double least = scene.species.front().diameter;
  for (const core::Species& s : scene.species) least = std::min(least, s.diameter);
  return least;
}

double pore_of(double voidage) { return 2.0 / 3 * voidage / (1 - voidage); }

double sauter_cells(const core::Scene& scene, int grid) {
  return cells_of(scene.resolve, grid) * sauter(scene, scene.bed.volume_share) / least_diameter(scene);
}

Units units_of(double voidage, double reynolds, double sauter_in_cells) {
  if (reynolds == 0) return {stokes_viscosity, stokes_speed};
  const double speed = pore_speed * voidage, viscosity = speed * sauter_in_cells / reynolds;
  if (viscosity <= most_viscosity) return {viscosity, speed};
  return {most_viscosity, most_viscosity * reynolds / sauter_in_cells};
}

Units units_of_fall(const core::Scene& scene, double cells) {
  const Fall fall = fall_of(scene);
  const double reynolds_of_cell = fall.speed * least_diameter(scene) / cells / fall.viscosity;
  const double viscosity = std::min(fall_speed / reynolds_of_cell, most_viscosity);
  return {viscosity, viscosity * reynolds_of_cell};
}

/// Needs a higher viscosity for narrower pores. Fitted above all failed cases in 200 boxes of 12 spheres,
/// docs/record/resolved-flow.md.
double least_viscosity(double pore_cells) {
  constexpr double of_wide = 0.004, wide = 6, power = 8;
  return of_wide * std::max(1.0, std::pow(wide / pore_cells, power));
}

BoxPlan plan_of(const core::Scene& scene, const ResolvePoint& point) {
  const double length = box_length(scene, point.voidage);
  BoxPlan plan;
  plan.edge = std::max(int(std::llround(length * cells_of(scene.resolve, point.grid) / least_diameter(scene))), 3);
  plan.scale = plan.edge / length;
  plan.sauter = sauter(scene, shares_of(scene, sphere_numbers(scene))) * plan.scale;
  const bool free = scene.resolve.motion == core::SphereMotion::free;
  plan.units = free ? units_of_fall(scene, least_diameter(scene) * plan.scale)
                    : units_of(point.voidage, point.reynolds, plan.sauter);
  const double pore = std::min(1.0, pore_of(point.voidage)) * plan.sauter;
  // A pore loses its memory by friction, or by flow over two diameters, whichever is sooner.
  plan.window = std::max(100.0, pore * pore / (3 * plan.units.viscosity));
  if (point.reynolds > 0)
    plan.window = std::max(100.0, std::min(plan.window, 2 * plan.sauter * point.voidage / plan.units.speed));
  if (free) {
    plan.window = travel_window;
    const Fall fall = fall_of(scene);
    plan.step = plan.units.speed / plan.scale / fall.speed;
    const double until =
        scene.resolve.until.value_or(crossings * length / (fall.speed * std::pow(point.voidage, hindrance)));
    plan.steps = std::max<std::int64_t>(2 * std::llround(until / plan.step / 2), least_steps);
    plan.dropped = plan.steps / 6 * 2;
  }
  if (places_move(scene, point)) {
    plan.still = 2 * std::llround(still_windows * plan.window / 2);
    plan.window = travel_window;
    const std::int64_t travel = 2 * std::llround(travelled * plan.edge * point.voidage / plan.units.speed / 2);
    plan.steps = plan.still + travel;
    plan.dropped = plan.still + travel / 6 * 2;
  }
  return plan;
}

BoxNeed box_need(const core::Scene& scene, const ResolvePoint& point) {
  // Links of a lattice with 18 ways through a plane, mean over its directions: a quarter of the sum of their lengths.
  constexpr double links_of_area = (6 + 12 * std::numbers::sqrt2) / 4;
  constexpr double site_bytes = 4, link_bytes = 52, moving_bytes = 16;  // owner of a site; a link and its list entry
  const BoxPlan box = plan_of(scene, point);
  const double real = scene.resolve.precision == core::Precision::one ? sizeof(float) : sizeof(double);
  BoxNeed need;
  need.sites = std::pow(box.edge, 3);
  need.steps =
      box.steps > 0 ? double(box.steps) : std::ceil((point.reynolds > 0 ? usual_inertia : usual_stokes) * box.window);
  const double links = links_of_area * 6 * (1 - point.voidage) / box.sauter * need.sites;
  need.bytes = std::pow(box.edge + 2, 3) * (lattice::directions * real + site_bytes) +
               links * (link_bytes + (scene.resolve.motion == core::SphereMotion::held ? 0 : moving_bytes));
  return need;
}

}  // namespace polybed::multiscale
