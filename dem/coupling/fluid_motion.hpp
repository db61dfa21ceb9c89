// Effect of the fluid on the particles, and their motion: drag in a frozen fluid is integrated exactly, so that no step
// is too long for it.
#pragma once

#include <cmath>
#include <cstdint>
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
      : gravity_{gravity[0], gravity[1], gravity[2], 0}, force_(force), energy_(energy), counts_work_(counts_work) {
    for (const Species& species : materials.species()) {
      mass_.push_back(species.mass);
      const double share = 1 - fluid_density / species.density;
      net_gravity_.push_back({share * gravity[0], share * gravity[1], share * gravity[2], 0});
    }
  }

  /// Motion of a particle over a time h under a load, the fluid, and its buoyant weight. The first three numbers of
  /// each count.
  struct Kick {
    Four dv;    ///< change of its velocity, m/s
    Four free;  ///< the change without drag, m/s
  };
  /// U_f is frozen: U <- U_f + (U - U_f) exp(-kappa h) + (1 - exp(-kappa h)) a/kappa, kappa = k/M, M the mass plus the
  /// added mass, a the acceleration from all forces but drag. \param h  s, as in the last relax()
  [[nodiscard]] Kick kick(const Particles& particles, std::size_t i, double h) const {
    const FluidLoad& f = load[i];
    const Relaxation& r = relaxation_[i];
    Four weight;
    get_four(net_gravity_[std::size_t(particles.species[i])].data(), weight);
    Kick kick;
    kick.free =
        h * ((to_four(particles.load[i].force) * force_.unit + four_at(f.force)) * r.per_inertia + weight * r.share);
    kick.dv = r.mean * (kick.free + r.x * (four_at(f.velocity) - four_at(particles.motion[i].v)));
    return kick;
  }
  /// Computes the coefficients common to all kicks over a time h while drag and added mass are constant. Call it when
  /// these, h or the particles have changed, and before the first kick. \param h  s
  void relax(const Particles& particles, double h) {
    relaxation_.resize(load.size());
    if (counts_work_) work_of_kick_.resize(load.size());
    for (std::size_t i = 0; i < load.size(); ++i) relax(particles, i, h);
  }
  /// The same for one particle. \pre relax() has been called for all
  void relax(const Particles& particles, std::size_t i, double h) {
    const double inverse_mass = particles.motion[i].inverse_mass, share = 1 / (1 + load[i].added * inverse_mass);
    const double per_inertia = inverse_mass * share, x = load[i].drag * per_inertia * h;
    relaxation_[i] = {per_inertia, share, x, mean_decay(x)};
  }

  /// Sums a kick's effect on the fluid, before the velocity changes: the impulse alone, or also its work.
  void account_impulse(const Particles& particles, std::size_t i, const Kick& kick) {
    FluidLoad& f = load[i];
    const double inertia = mass_[std::size_t(particles.species[i])] + f.added;
    add_three(inertia * (kick.dv - kick.free) - f.added * kick.dv, f.impulse);
  }
  void account(const Particles& particles, std::size_t i, const Kick& kick, double h, WorkShare share) {
    account_impulse(particles, i, kick);
    const double mass = mass_[std::size_t(particles.species[i])], unit = force_.unit * h;
    Four gravity;
    get_four(gravity_.data(), gravity);
    const Four v = four_at(particles.motion[i].v), &dv = kick.dv, contacts = to_four(particles.load[i].force) * unit;
    const Four work =
        (v + 0.5 * dv) * mass * dv - (v + share.weight * dv) * mass * (gravity * h) - (v + share.load * dv) * contacts;
    work_of_kick_[i] = work[0] + work[1] + work[2];
  }
  /// Adds the work of all particles' kicks: afterwards, so that no kick waits for the sum.
  void sum_work() { work_.add(work_of_kick_, energy_.per_unit); }
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
  /// Buoyant weight per mass of a species, m/s2; three numbers count.
  [[nodiscard]] const std::array<double, 4>& net_gravity(std::int32_t species) const {
    return net_gravity_[std::size_t(species)];
  }

  std::vector<FluidLoad> load;  ///< for the owned particles

 private:
  /// For a kick: 1/M, m/M, kappa h and the mean of exp(-kappa t) over it.
  struct Relaxation {
    double per_inertia, share, x, mean;
  };

  std::array<double, 4> gravity_;                   ///< m/s2; three numbers count
  std::vector<double> mass_;                        ///< of each species, kg
  std::vector<std::array<double, 4>> net_gravity_;  ///< g (1 - rho_f/rho_p) of each species
  FixedPoint force_, energy_;
  bool counts_work_;
  std::vector<Relaxation> relaxation_;
  std::vector<double> work_of_kick_;  ///< of the fluid on each particle, J; empty if not counted
  EnergySum work_;
};

}  // namespace polybed::dem
