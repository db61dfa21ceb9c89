#include "multiscale/resolve/box_drag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "closures/mixture.hpp"
#include "core/error.hpp"
#include "multiscale/resolve/lattice/steady.hpp"

namespace polybed::multiscale {

namespace {

using core::Broken;
using std::numbers::pi;

/// Cells that a pore needs at least: chosen, not measured.
constexpr double least_pore = 3;
/// Mean velocity in the pores, cells per step: a Mach number of 0.05, so that the fluid stays nearly incompressible
/// where it is faster.
constexpr double pore_speed = 0.03;
/// Of Stokes flow: the drag does not depend on it, and the greater it is the sooner the flow is steady.
constexpr double stokes_viscosity = 0.5, stokes_speed = 1e-3;
/// Windows after which a flow that is still changing ends, and those that most boxes took: 9 to 15, and 8 to 28 of
/// flows with inertia, up to a Reynolds number of 40.
constexpr double most_windows = 200, usual_stokes = 10, usual_inertia = 20;
/// Change of the drag from one window to the next at which a flow is steady: in single precision round-off alone can
/// keep it above 1e-5 for ever (1.3e-5 in 80 windows of one box of 88 spheres at Re 10).
template <class Real>
constexpr double steady_change = std::is_same_v<Real, float> ? 1e-4 : 1e-5;
/// Most at a Reynolds number above 0.
constexpr double most_viscosity = 1.0 / 6;

double least_diameter(const core::Scene& scene) {
  double least = scene.species.front().diameter;
  for (const core::Species& s : scene.species) least = std::min(least, s.diameter);
  return least;
}

double sauter(const core::Scene& scene, const std::vector<double>& share) {
  std::vector<double> diameter;
  for (const core::Species& s : scene.species) diameter.push_back(s.diameter);
  return closures::sauter_diameter(share, diameter);
}

/// Of the case, as its rules see it.
double sauter_cells(const core::Scene& scene, int grid) {
  return cells_of(scene.resolve, grid) * sauter(scene, scene.bed.volume_share) / least_diameter(scene);
}

/// Hydraulic diameter of the pores over the Sauter diameter.
double pore_of(double voidage) { return 2.0 / 3 * voidage / (1 - voidage); }

bool asks(const core::Scene& scene) {
  return !scene.resolve.voidage.empty() && !scene.species.empty() &&
         scene.bed.volume_share.size() == scene.species.size();
}

Broken pores_too_coarse(const core::Scene& scene) {
  Broken broken;
  if (!asks(scene)) return broken;
  const int grid = scene.resolve.grids - 1;
  for (const double eps : scene.resolve.voidage) {
    const double cells = pore_of(eps) * sauter_cells(scene, grid);
    if (cells >= least_pore) continue;
    broken.add({fmt::format("{}", scene.resolve.cells_per_diameter), fmt::format("{:.2g}", cells),
                fmt::format("{:g}", eps), fmt::format("{:g}", least_pore),
                fmt::format("{:.0f}", std::ceil(scene.resolve.cells_per_diameter * least_pore / cells))});
  }
  return broken;
}

/// Viscosity in cells and steps at a Reynolds number, and the superficial velocity.
struct Units {
  double viscosity = stokes_viscosity, speed = stokes_speed;
};

Units units_of(double voidage, double reynolds, double sauter_in_cells) {
  if (reynolds == 0) return {};
  const double speed = pore_speed * voidage, viscosity = speed * sauter_in_cells / reynolds;
  if (viscosity <= most_viscosity) return {viscosity, speed};
  return {most_viscosity, most_viscosity * reynolds / sauter_in_cells};
}

/// In cells and steps: below it the collision barely damps what the grid cannot resolve, the sooner the narrower the
/// pores are. Fitted above all that failed of 200 boxes of 12 spheres, docs/record/resolved-flow.md.
double least_viscosity(double pore_cells) {
  constexpr double of_wide = 0.004, wide = 6, power = 8;
  return of_wide * std::max(1.0, std::pow(wide / pore_cells, power));
}

bool is_stable(double eps, double re, double sauter_in_cells) {
  return re == 0 || units_of(eps, re, sauter_in_cells).viscosity >= least_viscosity(pore_of(eps) * sauter_in_cells);
}

Broken reynolds_beyond_grid(const core::Scene& scene) {
  Broken broken;
  if (!asks(scene)) return broken;
  const double cells = sauter_cells(scene, scene.resolve.grids - 1);
  for (const double eps : scene.resolve.voidage)
    for (const double re : scene.resolve.reynolds) {
      if (is_stable(eps, re, cells)) continue;
      double more = 1;
      while (!is_stable(eps, re, more * cells)) more += 0.01;
      broken.add({fmt::format("{:g}", re), fmt::format("{:g}", eps),
                  fmt::format("{:.2g}", units_of(eps, re, cells).viscosity),
                  fmt::format("{:.2g}", least_viscosity(pore_of(eps) * cells)),
                  fmt::format("{:.0f}", std::ceil(scene.resolve.cells_per_diameter * more))});
    }
  return broken;
}

Broken species_without_spheres(const core::Scene& scene) {
  Broken broken;
  if (!asks(scene)) return broken;
  const std::vector<std::int64_t> numbers = sphere_numbers(scene);
  for (std::size_t j = 0; j < numbers.size(); ++j)
    if (numbers[j] == 0) broken.add({fmt::format("{}", scene.resolve.spheres), scene.species[j].name});
  return broken;
}

/// Lengths in cells, times in steps.
struct BoxPlan {
  int edge = 0;
  double scale = 0;  ///< cells per m
  double sauter = 0;
  Units units;
  double window = 0;
};

BoxPlan plan_of(const core::Scene& scene, const ResolvePoint& point) {
  const double length = box_length(scene, point.voidage);
  BoxPlan plan;
  plan.edge = std::max(int(std::llround(length * cells_of(scene.resolve, point.grid) / least_diameter(scene))), 3);
  plan.scale = plan.edge / length;
  plan.sauter = sauter(scene, shares_of(scene, sphere_numbers(scene))) * plan.scale;
  plan.units = units_of(point.voidage, point.reynolds, plan.sauter);
  const double pore = std::min(1.0, pore_of(point.voidage)) * plan.sauter;
  // By friction a pore forgets its past, or by the fluid that passes two diameters, whichever is sooner.
  plan.window = std::max(100.0, pore * pore / (3 * plan.units.viscosity));
  if (point.reynolds > 0)
    plan.window = std::max(100.0, std::min(plan.window, 2 * plan.sauter * point.voidage / plan.units.speed));
  return plan;
}

std::vector<lattice::Sphere> spheres_of(const core::Scene& scene, const SpherePacking& packing, double scale) {
  std::vector<lattice::Sphere> spheres;
  for (std::size_t n = 0; n < packing.centre.size(); ++n) {
    lattice::Point centre = packing.centre[n];
    for (double& x : centre) x *= scale;
    spheres.push_back({centre, 0.5 * scene.species[packing.species[n]].diameter * scale});
  }
  return spheres;
}

lattice::FlowSetup setup_of(const BoxPlan& box, double reynolds) {
  return {{box.edge, box.edge, box.edge}, box.units.viscosity, reynolds > 0, lattice::Wall::interpolated};
}

template <class Real>
double rate_of(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing) {
  const BoxPlan box = plan_of(scene, point);
  const lattice::FlowSetup setup = setup_of(box, point.reynolds);
  lattice::Flow<Real> flow(setup, lattice::Spheres(spheres_of(scene, packing, box.scale), setup.box));
  const auto begin = std::chrono::steady_clock::now();
  double steps = 0, seconds = 0;
  for (; seconds < 1; steps += 2) {
    flow.advance({0, 0, 0});
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  return steps * std::pow(box.edge, 3) / seconds;
}

template <class Real>
BoxDrag resolved(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                 const StillWanted& wanted, const KeptBox* kept) {
  const BoxPlan box = plan_of(scene, point);
  const Units& units = box.units;
  const std::vector<lattice::Sphere> spheres = spheres_of(scene, packing, box.scale);
  lattice::SteadyPlan plan;
  plan.velocity = {units.speed, 0, 0};
  plan.window = box.window;
  plan.tolerance = steady_change<Real>;
  plan.most_steps = std::llround(most_windows * plan.window);
  const lattice::FlowSetup setup = setup_of(box, point.reynolds);
  lattice::Flow<Real> flow(setup, lattice::Spheres(spheres, setup.box));
  bool stopped = false;
  KeptBox::Stand stand;
  if (kept != nullptr && kept->restore(flow, stand)) (void)wanted(double(stand.progress.steps), stand.progress.change);
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return stand.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  double last_kept = stand.seconds;
  const auto after_window = [&](const lattice::SteadyProgress& progress) {
    stopped = !wanted(double(progress.steps), progress.change);
    if (kept != nullptr && (stopped || seconds() - last_kept > kept->every)) {
      last_kept = seconds();
      kept->write(flow, {progress, last_kept});
    }
    return !stopped;
  };
  const lattice::SteadyFlow steady = run_until_steady(flow, plan, after_window, stand.progress);
  if (stopped) throw core::Stopped("stopped by the user");
  if (kept != nullptr) kept->remove();
  BoxDrag drag;
  drag.seconds = seconds();
  drag.steps = double(steady.steps);
  drag.sites = std::pow(box.edge, 3);
  drag.cells = least_diameter(scene) * box.scale;
  drag.change = steady.change;
  drag.imbalance = steady.imbalance;
  const double speed = steady.velocity[0];
  std::vector<double> count(scene.species.size(), 0);
  drag.pure.assign(scene.species.size(), 0);
  for (std::size_t n = 0; n < spheres.size(); ++n) {
    const std::size_t j = packing.species[n];
    drag.pure[j] += steady.forces[n][0] / (6 * pi * units.viscosity * spheres[n].radius * speed);
    ++count[j];
  }
  for (std::size_t j = 0; j < count.size(); ++j) {
    drag.pure[j] /= count[j];
    // The pressure that drives the flow acts on the spheres as well, as buoyancy does.
    const double diameter = scene.species[j].diameter * box.scale;
    drag.net.push_back(drag.pure[j] + steady.driving[0] * diameter * diameter / (18 * units.viscosity * speed));
  }
  return drag;
}

}  // namespace

std::vector<core::Rule> resolve_rules() {
  return {
      {{"resolve.cells_per_diameter", "resolve.voidage", "resolve.grids", "species.diameter", "bed.volume_share"},
       "resolve.cells_per_diameter = {}: the pores are {} cells wide on the coarsest grid at a voidage of {}, they "
       "need {}; take {} or more, or fewer resolve.grids",
       pores_too_coarse},
      {{"resolve.reynolds", "resolve.cells_per_diameter", "resolve.voidage", "resolve.grids", "species.diameter",
        "bed.volume_share"},
       "resolve.reynolds = {} at a voidage of {}: the viscosity would be {} in cells and steps, stable from {}; take "
       "resolve.cells_per_diameter = {} or more, or fewer resolve.grids",
       reynolds_beyond_grid},
      {{"resolve.spheres", "resolve.voidage", "species.diameter", "bed.volume_share"},
       "resolve.spheres = {} leaves none of species '{}': take more",
       species_without_spheres}};
}

double cells_of(const core::Resolve& resolve, int grid) { return resolve.cells_per_diameter / std::pow(1.5, grid); }

BoxNeed box_need(const core::Scene& scene, const ResolvePoint& point) {
  // Links of a lattice of 18 ways to a plane, mean over its directions: a quarter of the sum of their lengths.
  constexpr double links_of_area = (6 + 12 * std::numbers::sqrt2) / 4;
  constexpr double site_bytes = 4, link_bytes = 44;  // whose a site is; a link, and what it was found from
  const BoxPlan box = plan_of(scene, point);
  const double real = scene.resolve.precision == core::Precision::one ? sizeof(float) : sizeof(double);
  BoxNeed need;
  need.sites = std::pow(box.edge, 3);
  need.steps = std::ceil((point.reynolds > 0 ? usual_inertia : usual_stokes) * box.window);
  const double links = links_of_area * 6 * (1 - point.voidage) / box.sauter * need.sites;
  need.bytes = std::pow(box.edge + 2, 3) * (lattice::directions * real + site_bytes) + links * link_bytes;
  return need;
}

double measured_rate(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing) {
  return scene.resolve.precision == core::Precision::one ? rate_of<float>(scene, point, packing)
                                                         : rate_of<double>(scene, point, packing);
}

BoxDrag box_drag(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                 const StillWanted& wanted, const KeptBox* kept) {
  return scene.resolve.precision == core::Precision::one ? resolved<float>(scene, point, packing, wanted, kept)
                                                         : resolved<double>(scene, point, packing, wanted, kept);
}

}  // namespace polybed::multiscale
