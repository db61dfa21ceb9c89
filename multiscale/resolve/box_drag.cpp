#include "multiscale/resolve/box_drag.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <type_traits>

#include "closures/lubrication.hpp"
#include "core/error.hpp"
#include "multiscale/resolve/free_box.hpp"
#include "multiscale/resolve/lattice/steady.hpp"
#include "multiscale/resolve/moving_box.hpp"

namespace polybed::multiscale {

std::vector<lattice::Sphere> spheres_of(const core::Scene& scene, const SpherePacking& packing, double scale) {
  std::vector<lattice::Sphere> spheres;
  for (std::size_t n = 0; n < packing.centre.size(); ++n) {
    lattice::Point centre = packing.centre[n];
    for (double& x : centre) x *= scale;
    spheres.push_back({centre, 0.5 * scene.species[packing.species[n]].diameter * scale});
  }
  return spheres;
}

lattice::FlowSetup flow_setup(const BoxPlan& box, bool inertia) {
  return {{box.edge, box.edge, box.edge}, box.units.viscosity, inertia, lattice::Wall::interpolated};
}

namespace {

using std::numbers::pi;

/// Number of windows after which a flow that is still changing ends.
constexpr double most_windows = 200;
/// Change of the drag from one window to the next at which a flow is steady: in single precision round-off alone can
/// keep it above 1e-5 forever (1.3e-5 in 80 windows of one box of 88 spheres at Re 10).
template <class Real>
constexpr double steady_change = std::is_same_v<Real, float> ? 1e-4 : 1e-5;

/// Fluid and all other species move past one species, at fixed positions: for Stokes flow.
template <class Real>
void set_relative_motion(lattice::Flow<Real>& flow, const ResolvePoint& point, const SpherePacking& packing,
                         const std::vector<lattice::Sphere>& spheres, const lattice::Point& velocity) {
  std::vector<lattice::Motion> motion;
  for (std::size_t n = 0; n < spheres.size(); ++n)
    motion.push_back({spheres[n].centre, is_passed(point, packing.species[n]) ? lattice::Point{} : velocity, {}});
  flow.set_motion(motion);
  flow.set_velocity(velocity);
}

/// Force along x on each sphere from the unresolved films between the passed species and the others, in lattice units.
std::vector<double> film_forces(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                                const std::vector<lattice::Sphere>& spheres, const BoxPlan& box, double velocity) {
  std::vector<double> force(spheres.size(), 0);
  for (std::size_t m = 0; m < spheres.size(); ++m)
    for (std::size_t n = 0; n < m; ++n) {
      const bool moving = !is_passed(point, packing.species[m]);
      if (moving != is_passed(point, packing.species[n])) continue;
      lattice::Point d;
      for (std::size_t k = 0; k < 3; ++k) {
        d[k] = spheres[m].centre[k] - spheres[n].centre[k];
        d[k] -= box.edge * std::round(d[k] / box.edge);
      }
      const double distance = std::hypot(d[0], d[1], d[2]), a = spheres[m].radius, b = spheres[n].radius;
      const double resistance = closures::unresolved_film_resistance(
          box.units.viscosity, a * b / (a + b), distance - a - b, resolved_gap, scene.material.roughness * box.scale);
      const double on_m = (moving ? -1 : 1) * resistance * velocity * std::pow(d[0] / distance, 2);
      force[m] += on_m;
      force[n] -= on_m;
    }
  return force;
}

template <class Real>
double rate_of(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing) {
  const BoxPlan box = plan_of(scene, point);
  const auto rate = [&](auto&& two_steps) {
    const auto begin = std::chrono::steady_clock::now();
    double steps = 0, seconds = 0;
    for (; seconds < 1; steps += 2) {
      two_steps();
      seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    return steps * std::pow(box.edge, 3) / seconds;
  };
  if (scene.resolve.motion == core::SphereMotion::free) {
    FreeBox<Real> free(scene, point, packing);
    return rate([&] { free.step(); });
  }
  if (places_move(scene, point)) {
    MovingBox<Real> moving(scene, point, packing);
    return rate([&] { moving.step(); });
  }
  const lattice::FlowSetup setup = flow_setup(box, point.reynolds > 0);
  lattice::Flow<Real> flow(setup, lattice::Spheres(spheres_of(scene, packing, box.scale), setup.box));
  return rate([&] { flow.advance({0, 0, 0}); });
}

/// Progress of a flow.
struct Stand {
  lattice::SteadyProgress progress;
  double seconds = 0;  ///< computing time
};

core::Checkpoint kept_stand(const Stand& stand) {
  core::Checkpoint state;
  state.integers["steps"] = stand.progress.steps;
  state.numbers["drag"] = stand.progress.drag;
  state.numbers["mean_drag"] = stand.progress.mean_drag;
  state.numbers["change"] = stand.progress.change;
  state.numbers["seconds"] = stand.seconds;
  return state;
}

Stand stand_of(const core::Checkpoint& state) {
  return {{state.count("steps"), state.number("drag"), state.number("mean_drag"), state.number("change")},
          state.time("seconds")};
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
  const lattice::FlowSetup setup = flow_setup(box, point.reynolds > 0);
  lattice::Flow<Real> flow(setup, lattice::Spheres(spheres, setup.box));
  std::vector<double> films(spheres.size(), 0);
  if (point.reynolds == 0 && !point.past.empty()) {
    const double velocity = units.speed / flow.fluid_sites() * std::pow(box.edge, 3);
    set_relative_motion(flow, point, packing, spheres, {velocity, 0, 0});
    films = film_forces(scene, point, packing, spheres, box, velocity);
  }
  bool stopped = false;
  Stand stand;
  if (const auto state = kept != nullptr ? kept->read() : std::nullopt) {
    core::name_checkpoint(kept->path, [&] {
      stand = stand_of(*state);
      kept->restore(flow, *state);
    });
    (void)wanted(double(stand.progress.steps), stand.progress.change);
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return stand.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  double last_kept = stand.seconds;
  const auto after_window = [&](const lattice::SteadyProgress& progress) {
    stopped = !wanted(double(progress.steps), progress.change);
    if (kept != nullptr && (stopped || seconds() - last_kept > kept->every)) {
      last_kept = seconds();
      kept->write(flow, kept_stand({progress, last_kept}));
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
    drag.pure[j] += (steady.forces[n][0] + films[n]) / (6 * pi * units.viscosity * spheres[n].radius * speed);
    ++count[j];
  }
  for (std::size_t j = 0; j < count.size(); ++j) {
    drag.pure[j] /= count[j];
    // The pressure that drives the flow also acts on the spheres, as buoyancy does.
    const double diameter = scene.species[j].diameter * box.scale;
    drag.net.push_back(drag.pure[j] + steady.driving[0] * diameter * diameter / (18 * units.viscosity * speed));
  }
  return drag;
}

}  // namespace

double measured_rate(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing) {
  return scene.resolve.precision == core::Precision::one ? rate_of<float>(scene, point, packing)
                                                         : rate_of<double>(scene, point, packing);
}

BoxDrag box_drag(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                 const StillWanted& wanted, const KeptBox* kept) {
  if (scene.resolve.motion == core::SphereMotion::free) return free_box(scene, point, packing, wanted, kept);
  if (places_move(scene, point)) return moving_box(scene, point, packing, wanted, kept);
  return scene.resolve.precision == core::Precision::one ? resolved<float>(scene, point, packing, wanted, kept)
                                                         : resolved<double>(scene, point, packing, wanted, kept);
}

}  // namespace polybed::multiscale
