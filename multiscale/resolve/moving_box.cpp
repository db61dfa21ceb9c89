#include "multiscale/resolve/moving_box.hpp"

#include <cmath>
#include <numbers>

#include "closures/sphere.hpp"
#include "core/error.hpp"
#include "multiscale/resolve/timed_box.hpp"

namespace polybed::multiscale {

namespace {

/// Steps in which the force corrects a deviation from the mean velocity, as for held spheres.
constexpr double correction = 50;

std::vector<lattice::Point> velocities(const core::Scene& scene, const ResolvePoint& point, double passed,
                                       double fluid) {
  std::vector<lattice::Point> velocity;
  for (std::size_t j = 0; j < scene.species.size(); ++j)
    velocity.push_back({is_passed(point, j) ? passed : fluid, 0, 0});
  return velocity;
}

}  // namespace

template <class Real>
MovingBox<Real>::MovingBox(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                           double common)
    : common_(common),
      plan_(plan_of(scene, point)),
      species_(packing.species),
      count_(scene.species.size(), 0),
      spheres_(spheres_of(scene, packing, plan_.scale), species_,
               velocities(scene, point, common, common + plan_.units.speed / point.voidage), plan_.edge),
      flow_(flow_setup(plan_, true), lattice::Spheres(spheres_.spheres(), flow_setup(plan_, true).box)),
      still_(plan_.still),
      sums_(scene.species.size()) {
  fluid_velocity_ = common + plan_.units.speed / point.voidage;
  roughness_ = scene.material.roughness * plan_.scale;
  for (const core::Species& s : scene.species) radius_.push_back(0.5 * s.diameter * plan_.scale);
  for (const std::size_t j : species_) ++count_[j];
  flow_.set_velocity({fluid_velocity_, 0, 0});
  let_walls_follow();
  momentum_ = measured_momentum();
}

/// The momentum of the fluid follows from the forces, measured only once per window.
template <class Real>
void MovingBox<Real>::step() {
  const double fluid = flow_.fluid_sites();
  const double lacks = (fluid_velocity_ - 0.5 * flow_.last_force()[0]) * fluid - momentum_;
  const double push = (drag_ + lacks / correction) / fluid;
  flow_.advance({push, 0, 0});
  drag_ = flow_.force()[0];
  momentum_ += 2 * push * fluid;
  const std::vector<lattice::Impulse> impulse = flow_.impulses();
  const std::vector<double> film = spheres_.film_impulses(plan_.units.viscosity, resolved_gap, roughness_);
  for (std::size_t n = 0; n < impulse.size(); ++n) {
    momentum_ -= impulse[n].force[0];
    sums_.drag += impulse[n].force[0];
    sums_.force[species_[n]] += impulse[n].force[0] + film[n];
  }
  sums_.steps += 2;
  sums_.push += 2 * push * fluid;
  sums_.gradient += 2 * push;
  sums_.slip += 2 * (momentum_ + (0.5 * push - common_) * fluid) / std::pow(plan_.edge, 3);
  if (still_ > 0) {
    still_ -= 2;
    return flow_.forget_forces();
  }
  spheres_.move();
  let_walls_follow();
}

template <class Real>
void MovingBox<Real>::let_walls_follow() {
  flow_.forget_forces();
  flow_.move_to(lattice::Spheres(spheres_.spheres(), flow_setup(plan_, true).box), spheres_.motion());
}

/// What sites that have just been covered and uncovered gave and took is in the impulses of the next step.
template <class Real>
double MovingBox<Real>::measured_momentum() const {
  double momentum = flow_.velocity()[0] * std::pow(plan_.edge, 3) - 0.5 * flow_.last_force()[0] * flow_.fluid_sites();
  for (const lattice::Impulse& impulse : flow_.impulses()) momentum += impulse.force[0];
  return momentum;
}

template <class Real>
void MovingBox<Real>::begin_window() {
  flow_.level_density();
  momentum_ = measured_momentum();
  if (!std::isfinite(momentum_))
    throw core::NumericsError(
        "the flow past moving spheres is no number any more: finer cells, or a smaller Reynolds number");
}

template <class Real>
BoxDrag MovingBox<Real>::means() const {
  BoxDrag drag;
  const double slip = sums_.slip / sums_.steps;
  for (std::size_t j = 0; j < radius_.size(); ++j) {
    const double stokes = 6 * std::numbers::pi * plan_.units.viscosity * radius_[j] * slip;
    drag.pure.push_back(sums_.force[j] / sums_.steps / count_[j] / stokes);
    drag.net.push_back(drag.pure[j] + closures::sphere_volume(radius_[j]) * sums_.gradient / sums_.steps / stokes);
  }
  drag.imbalance = std::abs(sums_.drag / sums_.push - 1);
  return drag;
}

template <class Real>
core::Checkpoint MovingBox<Real>::state() const {
  core::Checkpoint state;
  for (const lattice::Sphere& sphere : spheres_.spheres())
    for (const double x : sphere.centre) state.arrays["centres"].push_back(x);
  keep_impulses(flow_.impulses(), state);
  std::vector<double>& sums = state.arrays["sums"];
  state.integers["still"] = still_;
  sums = {momentum_, drag_, sums_.steps, sums_.push, sums_.gradient, sums_.drag, sums_.slip};
  sums.insert(sums.end(), sums_.force.begin(), sums_.force.end());
  return state;
}

/// The walls first: KeptBox::restore() then restores their flow.
template <class Real>
void MovingBox<Real>::restore(const core::Checkpoint& state) {
  const std::vector<double>& centres = state.array("centres");
  std::vector<lattice::Point> places(species_.size());
  for (std::size_t n = 0; n < 3 * places.size(); ++n) places[n / 3][n % 3] = centres.at(n);
  spheres_.restore(places);
  let_walls_follow();
  flow_.restore_impulses(kept_impulses(state));
  const std::vector<double>& sums = state.array("sums");
  still_ = state.count("still");
  momentum_ = sums.at(0);
  drag_ = sums.at(1);
  sums_.steps = sums.at(2);
  sums_.push = sums.at(3);
  sums_.gradient = sums.at(4);
  sums_.drag = sums.at(5);
  sums_.slip = sums.at(6);
  for (std::size_t j = 0; j < sums_.force.size(); ++j) sums_.force[j] = sums.at(7 + j);
}

template class MovingBox<float>;
template class MovingBox<double>;

BoxDrag moving_box(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                   const StillWanted& wanted, const KeptBox* kept) {
  return run_box<MovingBox>(scene, point, packing, wanted, kept);
}

}  // namespace polybed::multiscale
