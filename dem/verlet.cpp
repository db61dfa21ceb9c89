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

/// Motion of particles under their loads and their weight alone.
struct Free {
  struct Kick {
    FourVectors dv;
  };
  using Pull = Kick;
  Vector gravity;
  double unit;  ///< of forces, N

  template <class Group>
  [[gnu::always_inline, nodiscard]] Pull pull(const Particles&, const Group&, const FourMotions& s, double time) const {
    const FourVectors pushed = s.load.force * (s.inverse_mass * unit * time);
    return {{pushed.x + gravity[0] * time, pushed.y + gravity[1] * time, pushed.z + gravity[2] * time}};
  }
  template <class Group>
  [[gnu::always_inline, nodiscard]] Pull take(const Particles& particles, const Group& group, const FourMotions& s,
                                              double time) const {
    return pull(particles, group, s, time);
  }
  [[gnu::always_inline, nodiscard]] static Kick kick(const Pull& pull, const FourVectors&) { return pull; }
  template <class Group>
  void account(const Group&, const Kick&, const FourMotions&, double, WorkShare) const {}
  void sum_work() const {}
};

/// Motion in a fluid whose work is not counted.
struct Uncounted {
  FluidMotion& fluid;

  template <class... Of>
  [[gnu::always_inline, nodiscard]] auto pull(const Of&... of) const {
    return fluid.pull(of...);
  }
  template <class... Of>
  [[gnu::always_inline, nodiscard]] auto take(const Of&... of) const {
    return fluid.take(of...);
  }
  [[gnu::always_inline, nodiscard]] static auto kick(const FluidMotion::Pull& pull, const FourVectors& v) {
    return FluidMotion::kick(pull, v);
  }
  template <class Group>
  [[gnu::always_inline]] void account(const Group& group, const FluidMotion::Kick& kick, const FourMotions&, double,
                                      WorkShare) const {
    fluid.account_impulse(group, kick);
  }
  void sum_work() const {}
};

template <class Group>
[[gnu::always_inline]] inline FourMotions get_motions(const Particles& particles, const Group& group, const Four& y) {
  const FourRecords v = get_records(group, [&](std::size_t i) { return particles.motion[i].v.data(); });
  const FourRecords w = get_records(group, [&](std::size_t i) { return particles.motion[i].w.data(); });
  return {v.of, v.next, w.of, w.next, y, get_loads(group, particles.load.data())};
}

template <class Group>
[[gnu::always_inline]] inline void put_motions(Particles& particles, const Group& group, const FourMotions& s) {
  put_records(group, {s.v, s.inverse_mass}, [&](std::size_t i) { return particles.motion[i].v.data(); });
  put_records(group, {s.w, s.inverse_inertia}, [&](std::size_t i) { return particles.motion[i].w.data(); });
}

template <class Group>
[[gnu::always_inline]] inline FourRecords get_places(const Particles& particles, const Group& group) {
  return get_records(group, [&](std::size_t i) { return particles.place[i].x.data(); });
}

}  // namespace

/// Applies load, weight and fluid to particles over half a step.
template <class Group, class Push, class Pull>
[[gnu::always_inline]] inline void Verlet::kick(const Group& group, const Pull& pull, FourMotions& s, Push& push,
                                                WorkShare share) const {
  const auto given = push.kick(pull, s.v);
  push.account(group, given, s, 0.5 * dt_, share);
  s.v = given.dv + s.v;
  turn(s);
}

[[gnu::always_inline]] inline void Verlet::turn(FourMotions& s) const {
  s.w = s.load.torque * (s.inverse_inertia * torque_.unit * (0.5 * dt_)) + s.w;
}

template <class Push>
void Verlet::begin_with(Verlet& verlet, Particles& particles, Push& push) {
  const bool synchronised = verlet.synchronised_;
  const double half = 0.5 * verlet.dt_;
  if (synchronised) verlet.half_.resize((particles.owned + 3) / 4);
  for_each_group(particles.owned, [&](const auto& group) {
    FourRecords place = get_places(particles, group);
    FourMotions s = get_motions(particles, group, place.of.y);
    verlet.kick(group, push.pull(particles, group, s, half), s, push, WorkShare::before_drift(synchronised));
    place.of = s.v * verlet.dt_ + place.of;
    put_records(group, place, [&](std::size_t i) { return particles.place[i].x.data(); });
    if (synchronised) {
      verlet.half_[group.first / 4] = {s.v, s.w};
      s.y = place.of.y;
      s.v = push.kick(push.pull(particles, group, s, half), s.v).dv + s.v;  // a prediction: not applied
      verlet.turn(s);
    }
    put_motions(particles, group, s);
    std::fill_n(&particles.load[group.first], group.count, Load{});
  });
  push.sum_work();
  std::fill(particles.load.begin() + std::ptrdiff_t(particles.owned), particles.load.end(), Load{});
  if (verlet.ledger_ != nullptr) verlet.ledger_->begin_step(particles.load.size());
}

/// Work of torque and films in a step beyond their work at the predicted velocities.
template <class Group>
void Verlet::correct(const Group& group, const FourMotions& s, const Velocities& foreseen) {
  const Four power = sum_of(each([&](const Four& torque, const Four& dw) { return torque * dw * torque_.unit; },
                                 s.load.torque, s.w - foreseen.w));
  const FourVectors missed = s.v - foreseen.v;
  for (std::size_t n = 0; n < group.count; ++n)
    ledger_->correct((power[n] + ledger_->work_of_films(group[n], {missed.x[n], missed.y[n], missed.z[n]})) * dt_);
}

/// The greatest drifts so far in each place of a row.
struct Verlet::FourDrifts {
  using Places = std::int64_t __attribute__((vector_size(32)));
  static constexpr double share_of_diameter = 0.1;  // Contacts are not resolved if a step exceeds it, and far larger
                                                    // steps jump over walls.
  double dt, time, shear_rate;
  Four most{}, longest{};
  Places hasty{-1, -1, -1, -1};

  /// \param v  of the drift  \param radius  m
  template <class Group>
  [[gnu::always_inline]] void see(const Group& group, const FourVectors& v, const FourVectors& x, const Four& radius,
                                  const FourVectors& from) {
    const FourVectors step = v * dt;
    FourVectors away = x - from + step;
    away.x -= shear_rate * from.y * time;
    const Four square = away.x * away.x + away.y * away.y + away.z * away.z;
    // Written so that NaN counts as too far, and stays.
    most = (square <= most) | (most != most) ? most : square;
    const Four against = step.x - shear_rate * x.y * dt, allowed = 2 * share_of_diameter * radius;
    const Four length = against * against + step.y * step.y + step.z * step.z;
    hasty = length <= allowed * allowed ? hasty : Places{} + std::int64_t(group.first);
    longest = longest < length ? length : longest;
  }

  [[nodiscard]] Drift result(const Particles& particles) const {
    double greatest = 0, fastest = 0;
    Drift drift;
    std::int64_t last = -1;
    for (int n = 0; n < 4; ++n) {
      greatest = most[n] <= greatest || std::isnan(greatest) ? greatest : most[n];
      fastest = std::max(fastest, longest[n]);
      if (hasty[n] >= 0) last = std::max(last, std::min(hasty[n] + n, std::int64_t(particles.owned) - 1));
    }
    if (last >= 0) drift.hasty = particles.id[std::size_t(last)];
    drift.distance = std::sqrt(greatest);
    drift.speed = std::sqrt(fastest) / dt;
    return drift;
  }
};

template <class Push>
Verlet::Drift Verlet::end_with(Verlet& verlet, Particles& particles, Push& push, double time) {
  const bool synchronised = verlet.synchronised_;
  const double half = 0.5 * verlet.dt_;
  FourDrifts drifts{verlet.dt_, time, verlet.shear_rate_};
  for_each_group(particles.owned, [&](const auto& group) {
    const FourRecords place = get_places(particles, group);
    FourMotions s = get_motions(particles, group, place.of.y);
    const Velocities foreseen{s.v, s.w};
    if (synchronised) {
      s.v = verlet.half_[group.first / 4].v;
      s.w = verlet.half_[group.first / 4].w;
    }
    const auto pull = push.take(particles, group, s, half);
    verlet.kick(group, pull, s, push, WorkShare::after_drift(synchronised));
    if (synchronised && verlet.ledger_ != nullptr) verlet.correct(group, s, foreseen);
    drifts.see(group, s.v + push.kick(pull, s.v).dv, place.of, place.next, verlet.marked_[group.first / 4]);
    put_motions(particles, group, s);
  });
  push.sum_work();
  return drifts.result(particles);
}

template <class Act>
auto Verlet::with(Around around, Act&& act) const {
  if (around.fluid != nullptr && around.fluid->counts_work()) return act(*around.fluid);
  if (around.fluid != nullptr) {
    Uncounted fluid{*around.fluid};
    return act(fluid);
  }
  if (around.flow != nullptr) return act(*around.flow);
  Free free{gravity_, force_.unit};
  return act(free);
}

void Verlet::begin(Particles& particles, Around around) {
  with(around, [&]<class Push>(Push& push) { core::in_vectors<&begin_with<Push>>(*this, particles, push); });
}

Verlet::Drift Verlet::end(Particles& particles, Around around, double time) {
  return with(around,
              [&]<class Push>(Push& push) { return core::in_vectors<&end_with<Push>>(*this, particles, push, time); });
}

void Verlet::mark(const Particles& particles) {
  marked_.resize((particles.owned + 3) / 4);
  for_each_group(particles.owned,
                 [&](const auto& group) { marked_[group.first / 4] = get_places(particles, group).of; });
}

Verlet::Drift Verlet::next_drift(const Particles& particles, double time, Around around) const {
  return with(around, [&]<class Push>(const Push& push) {
    return core::in_vectors<&next_drift_with<Push>>(*this, particles, time, push);
  });
}

template <class Push>
Verlet::Drift Verlet::next_drift_with(const Verlet& verlet, const Particles& particles, double time, const Push& push) {
  FourDrifts drifts{verlet.dt_, time, verlet.shear_rate_};
  for_each_group(particles.owned, [&](const auto& group) {
    const FourRecords place = get_places(particles, group);
    const FourMotions s = get_motions(particles, group, place.of.y);
    const auto pull = push.pull(particles, group, s, 0.5 * verlet.dt_);
    drifts.see(group, s.v + push.kick(pull, s.v).dv, place.of, place.next, verlet.marked_[group.first / 4]);
  });
  return drifts.result(particles);
}

}  // namespace polybed::dem
