// Motion of the particles: velocity Verlet, T(2.11)-(2.13), in two variants.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/box.hpp"
#include "dem/coupling/affine_drag.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/ledger.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// The surroundings of the particles: a fluid, the flow of a sheared box, or neither.
struct Around {
  FluidMotion* fluid = nullptr;
  AffineDrag* flow = nullptr;
};

/// U' = U + F dt/(2 m); x += U' dt; F = F(x, U'); U = U' + F dt/(2 m), and the same for spins.
///
/// With friction and very unequal particles, a force from positions at a full step and velocities at a half step is
/// unphysical (Vyas et al., Comput. Phys. Commun. 310 (2025) 109524). The synchronised variant passes the force U'' =
/// U' + F_old dt/(2 m) instead, at the time of the positions.
class Verlet {
 public:
  Verlet(bool synchronised, double dt, Vector gravity, FixedPoint force, FixedPoint torque, double shear_rate);

  /// First half: afterwards positions and the velocities for the force are ready, and loads are zero.
  /// \param around  surroundings of the particles, here and below
  void begin(Particles& particles, Around around);

  /// The ledger for work at velocities that the contacts did not predict; it must outlive this object.
  void keep(Ledger& ledger) { ledger_ = &ledger; }

  [[nodiscard]] bool synchronised() const { return synchronised_; }
  [[nodiscard]] double dt() const { return dt_; }
  /// For the following steps, s.
  void set_dt(double dt) { dt_ = dt; }

  /// Stores the places of the owned particles, as the origin of next_drift().
  void mark(const Particles& particles);
  /// Result of the next begin().
  struct Drift {
    double distance = 0;      ///< greatest from the marked place, relative to a sheared box's own flow, m
    double speed = 0;         ///< greatest for an owned particle, likewise, m/s
    std::int64_t hasty = -1;  ///< id of an owned particle that will move by more than a tenth of its diameter
  };
  /// \param time  from the mark to then, s
  [[nodiscard]] Drift next_drift(const Particles& particles, double time, Around around) const;
  /// Second half: the velocities of the full step. Returns next_drift() as long as nothing else changes them.
  Drift end(Particles& particles, Around around, double time);

 private:
  // Push moves particles apart from their spin: FluidMotion, AffineDrag or neither. pull() is what acts on four
  // particles, take() the same for new loads, kick() its effect in a time; account() records the fluid's part of it.
  template <class Act>
  auto with(Around around, Act&& act) const;
  template <class Push>
  static void begin_with(Verlet& verlet, Particles& particles, Push& push);
  template <class Push>
  static Drift end_with(Verlet& verlet, Particles& particles, Push& push, double time);
  template <class Push>
  static Drift next_drift_with(const Verlet& verlet, const Particles& particles, double time, const Push& push);
  template <class Group, class Push, class Pull>
  void kick(const Group& group, const Pull& pull, FourMotions& s, Push& push, WorkShare share) const;
  void turn(FourMotions& s) const;

  struct Velocities {
    FourVectors v, w;
  };
  struct FourDrifts;
  template <class Group>
  void correct(const Group& group, const FourMotions& s, const Velocities& foreseen);

  bool synchronised_;
  double dt_;
  Vector gravity_;
  FixedPoint force_, torque_;
  double shear_rate_;
  Ledger* ledger_ = nullptr;      ///< null: nothing is counted
  std::vector<Velocities> half_;  ///< at the half step, for the synchronised variant
  std::vector<FourVectors> marked_;
};

}  // namespace polybed::dem
