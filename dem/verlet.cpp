#include "dem/verlet.hpp"

#include <algorithm>
#include <cmath>

#include "core/vectors.hpp"
#include "dem/several.hpp"

namespace polybed::dem {

Verlet::Verlet(bool synchronised, double dt, Vector gravity, FixedPoint force, FixedPoint torque, double shear_rate)
    : synchronised_(synchronised),
      dt_(dt),
      gravity_(gravity),
      force_(force),
      torque_(torque),
      shear_rate_(shear_rate) {}

namespace {

/// Motion of a particle under its load and its weight alone.
struct Free {
  struct Kick {
    Four dv;
  };
  Four gravity;
  double unit;  ///< of forces, N

  [[nodiscard]] Kick kick(const Particles& particles, std::size_t i, double time) const {
    const double linear = particles.motion[i].inverse_mass * unit * time;
    return {to_four(particles.load[i].force) * linear + gravity * time};
  }
  void account(const Particles&, std::size_t, const Kick&, double, WorkShare) const {}
  void sum_work() const {}
};

/// Motion in a fluid whose work is not counted.
struct Uncounted {
  FluidMotion& fluid;

  [[nodiscard]] FluidMotion::Kick kick(const Particles& particles, std::size_t i, double time) const {
    return fluid.kick(particles, i, time);
  }
  void account(const Particles& particles, std::size_t i, const FluidMotion::Kick& kick, double, WorkShare) {
    fluid.account_impulse(particles, i, kick);
  }
  void sum_work() const {}
};

void turn(Particles& particles, std::size_t i, double unit, double time) {
  Motion& m = particles.motion[i];
  const double angular = m.inverse_inertia * unit * time;
  add_three(to_four(particles.load[i].torque) * angular, m.w);
}

}  // namespace

/// Applies load, weight and fluid to a particle over half a step.
template <class Push>
void Verlet::kick(Particles& particles, std::size_t i, Push& push, WorkShare share) const {
  const double time = 0.5 * dt_;
  const auto given = push.kick(particles, i, time);
  push.account(particles, i, given, time, share);
  add_three(given.dv, particles.motion[i].v);
  turn(particles, i, torque_.unit, time);
}

template <class Push>
void Verlet::begin_with(Verlet& verlet, Particles& particles, Push& push) {
  const double half = 0.5 * verlet.dt_;
  const bool synchronised = verlet.synchronised_;
  const auto drift = [&](std::size_t i) {
    verlet.kick(particles, i, push, WorkShare::before_drift(synchronised));
    add_three(four_at(particles.motion[i].v) * verlet.dt_, particles.place[i].x);
  };
  if (synchronised) {
    verlet.half_.resize(particles.owned);
    for (std::size_t i = 0; i < particles.owned; ++i) {
      drift(i);
      Motion& m = particles.motion[i];
      verlet.half_[i] = {m.v, m.w};
      add_three(push.kick(particles, i, half).dv, m.v);  // a prediction: not applied
      turn(particles, i, verlet.torque_.unit, half);
      particles.load[i] = {};
    }
  } else {
    for (std::size_t i = 0; i < particles.owned; ++i) {
      drift(i);
      particles.load[i] = {};
    }
  }
  push.sum_work();
  std::fill(particles.load.begin() + std::ptrdiff_t(particles.owned), particles.load.end(), Load{});
  if (verlet.ledger_ != nullptr) verlet.ledger_->begin_step(particles.load.size());
}

/// Work of torque and films in a step beyond their work at the predicted velocities, J.
double Verlet::work_missed(const Particles& particles, std::size_t i, const Velocities& foreseen) const {
  const Motion& now = particles.motion[i];
  double power = 0;
  Vector missed;
  for (std::size_t k = 0; k < 3; ++k) {
    power += double(particles.load[i].torque[k]) * (now.w[k] - foreseen.w[k]) * torque_.unit;
    missed[k] = now.v[k] - foreseen.v[k];
  }
  return (power + ledger_->work_of_films(i, missed)) * dt_;
}

template <class Push>
void Verlet::end_with(Verlet& verlet, Particles& particles, Push& push) {
  const bool synchronised = verlet.synchronised_;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const Velocities foreseen{particles.motion[i].v, particles.motion[i].w};
    if (synchronised) {
      particles.motion[i].v = verlet.half_[i].v;
      particles.motion[i].w = verlet.half_[i].w;
    }
    verlet.kick(particles, i, push, WorkShare::after_drift(synchronised));
    if (synchronised && verlet.ledger_ != nullptr) verlet.ledger_->correct(verlet.work_missed(particles, i, foreseen));
  }
  push.sum_work();
}

template <class Act>
auto Verlet::with(Around around, Act&& act) const {
  if (around.fluid != nullptr && around.fluid->counts_work()) return act(*around.fluid);
  if (around.fluid != nullptr) {
    Uncounted fluid{*around.fluid};
    return act(fluid);
  }
  if (around.flow != nullptr) return act(*around.flow);
  Free free{{gravity_[0], gravity_[1], gravity_[2], 0}, force_.unit};
  return act(free);
}

void Verlet::begin(Particles& particles, Around around) {
  with(around, [&]<class Push>(Push& push) { core::in_vectors<&begin_with<Push>>(*this, particles, push); });
}

void Verlet::end(Particles& particles, Around around) {
  with(around, [&]<class Push>(Push& push) { core::in_vectors<&end_with<Push>>(*this, particles, push); });
}

void Verlet::mark(const Particles& particles) {
  marked_.resize(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) marked_[i] = particles.place[i].x;
}

Verlet::Drift Verlet::next_drift(const Particles& particles, double time, Around around) const {
  return with(around, [&]<class Push>(const Push& push) {
    return core::in_vectors<&next_drift_with<Push>>(*this, particles, time, push);
  });
}

template <class Push>
Verlet::Drift Verlet::next_drift_with(const Verlet& verlet, const Particles& particles, double time, const Push& push) {
  // Contacts are not resolved if a step exceeds a tenth of a diameter; far larger steps jump over walls.
  constexpr double share_of_diameter = 0.1;
  double most = 0, longest = 0;
  Drift drift;
  const double dt = verlet.dt_, shear_rate = verlet.shear_rate_;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const Vector &x = particles.place[i].x, &from = verlet.marked_[i];
    const Four step = (four_at(particles.motion[i].v) + push.kick(particles, i, 0.5 * dt).dv) * dt;
    const double sx = step[0], sy = step[1], sz = step[2];
    const double dx = x[0] - from[0] + sx - shear_rate * from[1] * time;
    const double dy = x[1] - from[1] + sy, dz = x[2] - from[2] + sz;
    const double square = dx * dx + dy * dy + dz * dz;
    // Written so that NaN counts as too far, and stays.
    most = square <= most || std::isnan(most) ? most : square;
    const double against = sx - shear_rate * x[1] * dt, allowed = 2 * share_of_diameter * particles.place[i].radius;
    const double length = against * against + sy * sy + sz * sz;
    if (!(length <= allowed * allowed)) drift.hasty = particles.id[i];
    longest = std::max(longest, length);
  }
  drift.distance = std::sqrt(most);
  drift.speed = std::sqrt(longest) / dt;
  return drift;
}

}  // namespace polybed::dem
