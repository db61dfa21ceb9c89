#include "dem/verlet.hpp"

#include <algorithm>
#include <cmath>

namespace polybed::dem {

Verlet::Verlet(bool synchronised, double dt, Vector gravity, FixedPoint force, FixedPoint torque, double shear_rate)
    : synchronised_(synchronised),
      dt_(dt),
      gravity_(gravity),
      force_(force),
      torque_(torque),
      shear_rate_(shear_rate) {}

/// Adds what a load and the weight do to a particle in a time, s; a negative one takes it back.
void Verlet::kick(Particles& particles, std::size_t i, const Load& load, double time) const {
  Motion& m = particles.motion[i];
  const double linear = m.inverse_mass * force_.unit * time, angular = m.inverse_inertia * torque_.unit * time;
  for (std::size_t k = 0; k < 3; ++k) {
    m.v[k] += double(load.force[k]) * linear + gravity_[k] * time;
    m.w[k] += double(load.torque[k]) * angular;
  }
}

/// The velocity of a particle after a kick by its present load.
Vector Verlet::kicked(const Particles& particles, std::size_t i, double time) const {
  const Motion& m = particles.motion[i];
  const double linear = m.inverse_mass * force_.unit * time;
  const Load& load = particles.load[i];
  Vector v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = m.v[k] + (double(load.force[k]) * linear + gravity_[k] * time);
  return v;
}

void Verlet::begin(Particles& particles) {
  const double half = 0.5 * dt_;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    kick(particles, i, particles.load[i], half);
    for (std::size_t k = 0; k < 3; ++k) particles.place[i].x[k] += particles.motion[i].v[k] * dt_;
  }
  if (synchronised_) {
    before_.assign(particles.load.begin(), particles.load.begin() + std::ptrdiff_t(particles.owned));
    for (std::size_t i = 0; i < particles.owned; ++i) kick(particles, i, before_[i], half);
  }
  std::fill(particles.load.begin(), particles.load.end(), Load{});
}

void Verlet::end(Particles& particles) {
  const double half = 0.5 * dt_;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    if (synchronised_) kick(particles, i, before_[i], -half);
    kick(particles, i, particles.load[i], half);
  }
}

void Verlet::mark(const Particles& particles) {
  marked_.resize(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) marked_[i] = particles.place[i].x;
}

Verlet::Drift Verlet::next_drift(const Particles& particles, double time) const {
  // Beyond a tenth of a diameter in a step contacts are no longer resolved; far beyond, walls are jumped over.
  constexpr double share_of_diameter = 0.1;
  double most = 0;
  Drift drift;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const Vector &x = particles.place[i].x, &from = marked_[i], v = kicked(particles, i, 0.5 * dt_);
    const double sx = v[0] * dt_, sy = v[1] * dt_, sz = v[2] * dt_;
    const double dx = x[0] - from[0] + sx - shear_rate_ * from[1] * time;
    const double dy = x[1] - from[1] + sy, dz = x[2] - from[2] + sz;
    const double square = dx * dx + dy * dy + dz * dz;
    // Turned round, so that what is not a number counts as too far, and stays.
    most = square <= most || std::isnan(most) ? most : square;
    const double against = sx - shear_rate_ * x[1] * dt_, allowed = 2 * share_of_diameter * particles.place[i].radius;
    if (!(against * against + sy * sy + sz * sz <= allowed * allowed)) drift.hasty = particles.id[i];
  }
  drift.distance = std::sqrt(most);
  return drift;
}

}  // namespace polybed::dem
