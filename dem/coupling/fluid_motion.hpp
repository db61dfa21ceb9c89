// Effect of the fluid on the particles, and their motion: drag in a frozen fluid is integrated exactly, so that no step
// is too long for it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/energy_sum.hpp"
#include "dem/particles.hpp"
#include "dem/several.hpp"

namespace polybed::dem {

/// Loads of the fluid on a particle until its place or the fluid changes, and their reaction meanwhile.
struct FluidLoad {
  Vector velocity{};  ///< U_f at its place, m/s
  double drag = 0;    ///< k: pure drag over the slip U_f - U_p, kg/s
  Vector force{};     ///< other force from the fluid: -V grad p, N
  Vector impulse{};   ///< from drag and added mass since the fluid's last step, kg m/s
  double added = 0;   ///< added mass, kg; last, as a vector is read with the next number
};

/// Velocity for the work of other forces in a kick: v + share dv, with v before the kick and dv its change. A weight
/// works along the drift beside the kick. A contact's force does too in the thesis scheme; in the synchronised one it
/// uses the velocity at the time of the force (see Ledger). The fluid's work is the change of kinetic energy minus that
/// work: if the slip relaxes far within a step, the mean of v and v + dv gives neither.
struct WorkShare {
  double weight, load;

  static constexpr WorkShare before_drift(bool synchronised) { return {1, synchronised ? 0.0 : 1.0}; }
  static constexpr WorkShare after_drift(bool synchronised) { return {0, synchronised ? 1.0 : 0.0}; }
};

/// (1 - exp(-x))/x, 1 at 0; x >= 0.
[[nodiscard]] inline double mean_decay(double x) {
  constexpr double small = 0.02;  // below it the next term of the series is under 1e-16
  if (x < small) {                // in pairs, as each product waits for the previous one
    const double xx = x * x;
    return ((1 - x * (1.0 / 2)) + xx * (1.0 / 6 - x * (1.0 / 24))) +
           xx * xx * ((1.0 / 120 - x * (1.0 / 720)) + xx * (1.0 / 5040));
  }
  return -std::expm1(-x) / x;
}

/// Correction of a particle at the end of a fluid step, for a load that was constant during the step.
struct LoadChange {
  Vector dv{}, impulse{};               ///< change of velocity, m/s; impulse from drag, kg m/s
  double square = 0, force_square = 0;  ///< squares of the change of the force and of the force at the end, N2
};

/// Half the change of the force, applied over the fluid step with the same relaxation by drag as in a kick. It makes
/// the error of constant loads second order in the fluid step, instead of first order.
/// \param before, after  loads at the start and at the end of the step  \param dt  fluid step, s
[[nodiscard]] inline LoadChange change_of(const FluidLoad& before, const FluidLoad& after, const Motion& m, double dt) {
  LoadChange change;
  const double inertia = 1 / m.inverse_mass + before.added, s = mean_decay(after.drag * dt / inertia);
  for (std::size_t k = 0; k < 3; ++k) {
    const double drag = after.drag * (after.velocity[k] - m.v[k]), other = after.force[k] - before.force[k];
    const double all = drag - before.drag * (before.velocity[k] - m.v[k]) + other;
    change.dv[k] = 0.5 * s * dt * all / inertia;
    change.impulse[k] = change.dv[k] / m.inverse_mass - 0.5 * dt * other;
    change.square += all * all;
    change.force_square += (drag + after.force[k]) * (drag + after.force[k]);
  }
  return change;
}

class FluidMotion {
 public:
  /// \param fluid_density  kg/m3  \param gravity  m/s2  \param force, energy  units for loads and work
  /// \param counts_work  whether the fluid's work is summed
  FluidMotion(const Materials& materials, double fluid_density, Vector gravity, FixedPoint force, FixedPoint energy,
              bool counts_work = true)
      : gravity_(gravity), force_(force), energy_(energy), counts_work_(counts_work) {
    for (const Species& species : materials.species()) {
      mass_.push_back(species.mass);
      const double share = 1 - fluid_density / species.density;
      net_gravity_.push_back({share * gravity[0], share * gravity[1], share * gravity[2]});
    }
  }

  /// Motion of four particles over a time h under their loads, the fluid, and their buoyant weight.
  struct Kick {
    FourVectors dv, free;  ///< change of the velocity, and the change without drag, m/s
  };

  /// What acts on four particles until their loads change.
  struct Pull {
    FourVectors free, fluid;  ///< change without drag; U_f, m/s
    Four x, mean;             ///< kappa h, and the mean of exp(-kappa t) over it
  };
  template <class Group>
  [[gnu::always_inline, nodiscard]] Pull pull(const Particles&, const Group& group, const FourMotions&, double) const {
    const Row& row = rows_[group.first / 4];
    return {{row.free.x, row.free.y, row.free.z},
            get_records(group, [&](std::size_t i) { return load[i].velocity.data(); }).of,
            row.x,
            row.mean};
  }
  /// The same for the loads that act from now on.
  template <class Group>
  [[gnu::always_inline, nodiscard]] Pull take(const Particles& particles, const Group& group, const FourMotions& s,
                                              double h) {
    Row& row = rows_[group.first / 4];
    const FourVectors others = get_records(group, [&](std::size_t i) { return load[i].force.data(); }).of;
    Pull pull = this->pull(particles, group, s, h);
    pull.free = each([&](const Four& load, const Four& other,
                         const Four& weight) { return free_change(load, other, row.per_inertia, weight, h); },
                     s.load.force, others, row.weight);
    row.free = pull.free;
    return pull;
  }
  /// U_f is frozen: U <- U_f + (U - U_f) exp(-kappa h) + (1 - exp(-kappa h)) a/kappa, kappa = k/M, M the mass plus the
  /// added mass, a the acceleration from all forces but drag. h is that of the last relax().
  [[gnu::always_inline, nodiscard]] static Kick kick(const Pull& pull, const FourVectors& v) {
    const auto change = [&](const Four& free, const Four& u, const Four& v) {
      return pull.mean * (free + pull.x * (u - v));
    };
    return {each(change, pull.free, pull.fluid, v), pull.free};
  }
  /// Computes the coefficients common to all kicks over a time h while drag and added mass are constant. Call it when
  /// these, h, the loads or the particles have changed other than by take(), and before the first kick. \param h  s
  void relax(const Particles& particles, double h) {
    rows_.resize((load.size() + 3) / 4);
    if (counts_work_) work_of_kick_.resize(4 * rows_.size());
    for (std::size_t i = 0; i < load.size(); ++i) relax(particles, i, h, rows_[i / 4]);
  }

  /// Sums a kick's effect on the fluid, before the velocity changes: the impulse alone, or also its work.
  template <class Group>
  [[gnu::always_inline]] void account_impulse(const Group& group, const Kick& kick) {
    const auto at = [&](std::size_t i) { return load[i].impulse.data(); };
    FourRecords impulse = get_records(group, at);
    const Four added = impulse.next, inertia = rows_[group.first / 4].mass + added;
    const auto given = [&](const Four& dv, const Four& free) { return inertia * (dv - free) - added * dv; };
    impulse.of = each(given, kick.dv, kick.free) + impulse.of;
    put_records(group, impulse, at);
  }
  template <class Group>
  [[gnu::always_inline]] void account(const Group& group, const Kick& kick, const FourMotions& s, double h,
                                      WorkShare share) {
    account_impulse(group, kick);
    const Four mass = rows_[group.first / 4].mass;
    const auto work = [&](const Four& v, const Four& dv, const Four& load, double gravity) {
      return (v + 0.5 * dv) * mass * dv - (v + share.weight * dv) * mass * (gravity * h) -
             (v + share.load * dv) * (load * (force_.unit * h));
    };
    const FourVectors &v = s.v, &dv = kick.dv, &load = s.load.force;
    put_four(work(v.x, dv.x, load.x, gravity_[0]) + work(v.y, dv.y, load.y, gravity_[1]) +
                 work(v.z, dv.z, load.z, gravity_[2]),
             work_of_kick_.data() + group.first);
  }
  /// Adds the work of all particles' kicks: afterwards, so that no kick waits for the sum.
  void sum_work() { work_.add(std::span(work_of_kick_).first(load.size()), energy_.per_unit); }
  /// Adds a change of velocity that the fluid alone has caused.
  void account_coupling(const Motion& m, const Vector& dv) {
    if (!counts_work_) return;
    double work = 0;
    for (std::size_t k = 0; k < 3; ++k) work += (m.v[k] + 0.5 * dv[k]) * dv[k];
    work_.add(work / m.inverse_mass * energy_.per_unit);
  }

  /// Other work of the fluid, J.
  void account_work(double work) { work_.add(work * energy_.per_unit); }

  /// Work of the fluid on this rank's particles since the start, including buoyancy; 0 if it is not counted.
  [[nodiscard]] EnergySum work() const { return counts_work_ ? work_ : EnergySum(); }
  [[nodiscard]] bool counts_work() const { return counts_work_; }
  void set_work(const EnergySum& work) { work_ = work; }
  /// Buoyant weight per mass of a species, m/s2.
  [[nodiscard]] const Vector& net_gravity(std::int32_t species) const { return net_gravity_[std::size_t(species)]; }

  std::vector<FluidLoad> load;  ///< for the owned particles

 private:
  /// For the kicks of four particles: change without drag and net weight, m/M in it; kappa h and the mean of exp(-kappa
  /// t) over it; 1/M and m.
  struct Row {
    FourVectors free, weight;
    Four x{}, mean{}, per_inertia{}, mass{};
  };

  void relax(const Particles& particles, std::size_t i, double h, Row& row) const {
    const std::size_t n = i % 4, species = std::size_t(particles.species[i]);
    const double inverse_mass = particles.motion[i].inverse_mass, share = 1 / (1 + load[i].added * inverse_mass);
    row.per_inertia[n] = inverse_mass * share;
    row.x[n] = load[i].drag * row.per_inertia[n] * h;
    row.mean[n] = mean_decay(row.x[n]);
    row.mass[n] = mass_[species];
    const auto set = [&](Four& weight, Four& free, std::size_t k) {
      weight[n] = net_gravity_[species][k] * share;
      free[n] = free_change(double(particles.load[i].force[k]), load[i].force[k], row.per_inertia[n], weight[n], h);
    };
    set(row.weight.x, row.free.x, 0);
    set(row.weight.y, row.free.y, 1);
    set(row.weight.z, row.free.z, 2);
  }
  template <class Numbers>
  [[gnu::always_inline, nodiscard]] Numbers free_change(const Numbers& load, const Numbers& other,
                                                        const Numbers& per_inertia, const Numbers& weight,
                                                        double h) const {
    return h * ((load * force_.unit + other) * per_inertia + weight);
  }

  Vector gravity_;                   ///< m/s2
  std::vector<double> mass_;         ///< of each species, kg
  std::vector<Vector> net_gravity_;  ///< g (1 - rho_f/rho_p) of each species
  FixedPoint force_, energy_;
  bool counts_work_;
  std::vector<Row> rows_;
  std::vector<double> work_of_kick_;  ///< of the fluid on each particle, J, in whole rows; empty if not counted
  EnergySum work_;
};

}  // namespace polybed::dem
