#include "multiscale/resolve/free_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "closures/contact_pair.hpp"
#include "closures/sphere.hpp"
#include "core/error.hpp"
#include "dem/step_limits.hpp"
#include "multiscale/resolve/timed_box.hpp"
#include "relevance/effects/lubrication.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

using std::numbers::pi;

/// The spheres of a packing with their contacts and films; their drag is resolved.
core::Scene suspension(const core::Scene& scene, const SpherePacking& packing, double greatest_speed) {
  core::Scene box = packing.scene;
  box.fluid = scene.fluid;
  box.material = scene.material;
  box.effects = scene.effects;
  using namespace relevance::effects;
  if (lubrication.has(box, of_unresolved_flow)) box.effects.erase(lubrication.role);  // chosen; flow is resolved
  box.contact_pairs = scene.contact_pairs;
  box.dem = scene.dem;
  box.dem.opening.reset();
  box.dem.start_speed = 0;
  box.dem.ledger = false;
  box.dem.greatest_speed = greatest_speed;
  return box;
}

/// Steps of the spheres in a time, each no longer than contacts allow.
int substeps_in(double time, const core::Scene& box) {
  const dem::Materials materials(box);
  const dem::PairLaws laws = dem::make_pair_laws(box, materials);
  return int(std::ceil(time / dem::step_limits(box, materials, laws, *box.dem.greatest_speed).dt));
}

core::Scene with_step(core::Scene box, double step) {
  box.dem.fixed_step = step;
  return box;
}

std::vector<lattice::Sphere> spheres_at(const dem::Particles& particles, double scale) {
  std::vector<lattice::Sphere> spheres(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    lattice::Sphere& sphere = spheres[std::size_t(particles.id[i])];
    for (std::size_t k = 0; k < 3; ++k) sphere.centre[k] = particles.place[i].x[k] * scale;
    sphere.radius = particles.place[i].radius * scale;
  }
  return spheres;
}

/// Four times the fall speed of the fastest species alone: contacts push some spheres faster.
double greatest_speed(const BoxPlan& plan) { return 4 * plan.units.speed / plan.scale / plan.step; }

}  // namespace

template <class Real>
FreeBox<Real>::FreeBox(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing)
    : voidage_(point.voidage),
      plan_(plan_of(scene, point)),
      count_(scene.species.size(), 0),
      substeps_(substeps_in(2 * plan_.step, suspension(scene, packing, greatest_speed(plan_)))),
      spheres_(with_step(suspension(scene, packing, greatest_speed(plan_)), 2 * plan_.step / substeps_), timers_,
               nullptr, dem::FluidBy::caller, resolved_gap / plan_.scale),
      flow_(flow_setup(plan_, true),
            lattice::Spheres(spheres_at(spheres_.particles(), plan_.scale), flow_setup(plan_, true).box)),
      sums_(scene.species.size()),
      pairs_(pair_distribution(scene, point.voidage)) {
  const double density = relevance::fluid_constants(scene.fluid).density;
  for (const core::Species& s : scene.species) {
    Body body;
    body.radius = 0.5 * s.diameter * plan_.scale;
    body.volume = closures::sphere_volume(body.radius);
    body.mass = s.density / density * body.volume;
    body.inertia = closures::moment_of_inertia(body.mass, body.radius);
    body.weight = (body.mass - body.volume) * scene.column.gravity * plan_.step * plan_.step * plan_.scale;
    bodies_.push_back(body);
  }
  for (const std::int32_t species : spheres_.particles().species) ++count_[std::size_t(species)];
  let_walls_follow();
}

template <class Real>
void FreeBox<Real>::step() {
  const double force = push();
  flow_.advance({force, 0, 0});
  kick_spheres();
  move_spheres();
  let_walls_follow();
}

/// Force on a site of the fluid, minus the gradient of the mean pressure: it balances the buoyant weight of the
/// spheres, so that the total force on the box is zero.
template <class Real>
double FreeBox<Real>::push() const {
  double weight = 0, volume = 0;
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    weight += count_[j] * bodies_[j].weight;
    volume += count_[j] * bodies_[j].volume;
  }
  return weight / (flow_.fluid_sites() + volume);
}

/// Impulses from the fluid, the weight and the mean pressure.
template <class Real>
void FreeBox<Real>::kick_spheres() {
  const double speed = 1 / plan_.scale / plan_.step, spin = 1 / plan_.step;  // lattice units, m/s and 1/s
  const dem::Particles& particles = spheres_.particles();
  const std::vector<lattice::Impulse> impulse = flow_.impulses();
  std::vector<dem::Kick> kick(particles.owned);
  const double force = flow_.last_force()[0];
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const auto id = std::size_t(particles.id[i]);
    const Body& b = body(i);
    for (std::size_t k = 0; k < 3; ++k) {
      kick[id].dv[k] = impulse[id].force[k] / b.mass * speed;
      kick[id].dw[k] = impulse[id].torque[k] / b.inertia * spin;
    }
    kick[id].dv[0] += 2 * (b.volume * force - b.weight) / b.mass * speed;
    sums_.of[std::size_t(particles.species[i])].force += impulse[id].force[0];
  }
  sums_.steps += 2;
  sums_.push += 2 * force;
  spheres_.kick(kick);
}

template <class Real>
void FreeBox<Real>::move_spheres() {
  for (int n = 0; n < substeps_; ++n) spheres_.step(1e300);
}

template <class Real>
void FreeBox<Real>::let_walls_follow() {
  const dem::Particles& particles = spheres_.particles();
  const std::vector<lattice::Sphere> spheres = spheres_at(particles, plan_.scale);
  std::vector<lattice::Motion> motion(spheres.size());
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const auto id = std::size_t(particles.id[i]);
    motion[id].centre = spheres[id].centre;
    for (std::size_t k = 0; k < 3; ++k) {
      motion[id].velocity[k] = particles.motion[i].v[k] * plan_.scale * plan_.step;
      motion[id].spin[k] = particles.motion[i].w[k] * plan_.step;
    }
  }
  flow_.forget_forces();
  flow_.move_to(lattice::Spheres(spheres, flow_setup(plan_, true).box), motion);
}

template <class Real>
void FreeBox<Real>::begin_window() {
  flow_.level_density();
  spheres_.restart();
}

template <class Real>
auto FreeBox<Real>::momentum() const -> Momentum {
  Momentum momentum;
  const double sites = std::pow(plan_.edge, 3), speed = plan_.scale * plan_.step;
  momentum.all = flow_.velocity()[0] * sites - 0.5 * flow_.last_force()[0] * flow_.fluid_sites();
  const dem::Particles& particles = spheres_.particles();
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const double own = body(i).mass * particles.motion[i].v[0] * speed;
    momentum.all += own;
    momentum.of_spheres += std::abs(own);
  }
  for (const lattice::Impulse& impulse : flow_.impulses()) momentum.all += impulse.force[0];
  return momentum;
}

template <class Real>
void FreeBox<Real>::sample() {
  const double speed = 1 / plan_.scale / plan_.step;
  const double fluid = flow_.velocity()[0] * std::pow(plan_.edge, 3) / flow_.fluid_sites() * speed;
  const dem::Particles& particles = spheres_.particles();
  std::vector<dem::Vector> mean(bodies_.size());
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const auto j = std::size_t(particles.species[i]);
    for (std::size_t k = 0; k < 3; ++k) mean[j][k] += particles.motion[i].v[k] / count_[j];
  }
  for (std::size_t j = 0; j < mean.size(); ++j) sums_.of[j].slip += voidage_ * (fluid - mean[j][0]);
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const auto j = std::size_t(particles.species[i]);
    const dem::Vector& v = particles.motion[i].v;
    sums_.of[j].along += std::pow(v[0] - mean[j][0], 2) / count_[j];
    sums_.of[j].across += 0.5 * (std::pow(v[1] - mean[j][1], 2) + std::pow(v[2] - mean[j][2], 2)) / count_[j];
  }
  ++sums_.samples;
  std::vector<std::size_t> species(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i)
    species[std::size_t(particles.id[i])] = std::size_t(particles.species[i]);
  pairs_.add(spheres_at(particles, 1), species);
}

template <class Real>
BoxDrag FreeBox<Real>::means() const {
  BoxDrag drag;
  const Momentum left = momentum();
  drag.imbalance = std::abs(left.all) / left.of_spheres;
  const double speed = plan_.scale * plan_.step, push = sums_.push / sums_.steps;
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    const OfSpecies& of = sums_.of[j];
    const double slip = of.slip / sums_.samples;
    const double stokes = 6 * pi * plan_.units.viscosity * bodies_[j].radius * slip * speed;
    const double pure = of.force / sums_.steps / count_[j];
    drag.pure.push_back(pure / stokes);
    drag.net.push_back((pure + bodies_[j].volume * push) / stokes);
    drag.slip.push_back(slip);
    drag.along.push_back(std::sqrt(of.along / sums_.samples));
    drag.across.push_back(std::sqrt(of.across / sums_.samples));
  }
  drag.pairs = pairs_.mean();
  return drag;
}

template <class Real>
core::Checkpoint FreeBox<Real>::state() const {
  core::Checkpoint state = spheres_.checkpoint();
  keep_impulses(flow_.impulses(), state);
  std::vector<double>& sums = state.arrays["sums"];
  sums = {sums_.samples, sums_.steps, sums_.push};
  for (const OfSpecies& of : sums_.of) sums.insert(sums.end(), {of.slip, of.force, of.along, of.across});
  state.arrays["pairs"] = pairs_.sums();
  return state;
}

/// The walls first: KeptBox::restore() then restores their flow.
template <class Real>
void FreeBox<Real>::restore(const core::Checkpoint& state) {
  spheres_.resume(state);
  let_walls_follow();
  const std::vector<double>& sums = state.array("sums");
  flow_.restore_impulses(kept_impulses(state));
  sums_.samples = sums.at(0);
  sums_.steps = sums.at(1);
  sums_.push = sums.at(2);
  pairs_.restore(state.array("pairs"));
  for (std::size_t j = 0; j < sums_.of.size(); ++j)
    sums_.of[j] = {sums.at(3 + 4 * j), sums.at(4 + 4 * j), sums.at(5 + 4 * j), sums.at(6 + 4 * j)};
}

template class FreeBox<float>;
template class FreeBox<double>;

BoxDrag free_box(const core::Scene& scene, const ResolvePoint& point, const SpherePacking& packing,
                 const StillWanted& wanted, const KeptBox* kept) {
  return run_box<FreeBox>(scene, point, packing, wanted, kept);
}

}  // namespace polybed::multiscale
