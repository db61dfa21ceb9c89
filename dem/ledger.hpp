// The energy balance of the particles, which must close.
#pragma once

#include "dem/box.hpp"
#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/effects.hpp"
#include "dem/kept_part.hpp"
#include "dem/kept_sums.hpp"

namespace polybed::dem {

/// Energy that contacts have dissipated, step by step.
///
/// A force acts for half a step before the next drift and half a step after the previous one. The thesis scheme uses
/// the velocity of a drift, v_h: the work over it is (F_old + F_new)/2 . v_h dt, exactly as in the kicks. The
/// synchronised scheme uses the velocity at the time of the force: the work is F . v dt, half of it now and half in the
/// next step, whose length can differ. With v_h instead of v, or the other way round, the balance has an error of first
/// order in dt. Its contacts use velocity and spin predicted with the loads of the last step. Where those jump (a
/// constant rolling moment that oscillates at rest, or a film's force that stops a particle within a few steps), the
/// work of torque and film on the prediction error is also of first order, and is counted.
///
/// Only the dashpot's part of the normal force counts, computed from its own law instead of as the remainder, so that
/// it cannot hide an integration error. Of the tangential force: the work minus the stored energy of the spring;
/// likewise for rolling friction, with the relative spin. An attraction that is a function of the distance loses
/// nothing; the loss of a contact that jumps together is counted at the jump.
///
/// A contact that separates is counted once more: for the half step in which its last force still acts, and for its
/// springs' energy. If a clipped tail has ended the force early, that is the elastic energy left in the overlap.
class Ledger final : public KeptPart {
 public:
  /// The dashpot's force in the last step, or the synchronised scheme's power; the loss if the contact separates; with
  /// friction F_t in the last step and its energy; with rolling the moment and its energy; with a film as for the
  /// dashpot.
  [[nodiscard]] static int memory_size(const PairLaws& laws) { return before_film(laws) + (laws.film ? 2 : 0); }

  /// \param place  index of its memory in a batch   \param synchronised  velocities of the batch are at the time of the
  /// force   \param unit  of the sum, J   \param force  unit of forces, N
  Ledger(const PairLaws& laws, int place, bool synchronised, FixedPoint unit, FixedPoint force);

  /// Call it before the forces of a step. \param particles  on this rank, with ghosts
  void begin_step(std::size_t particles);

  /// Call it after the contact's laws and before cohesion. \param counted  1, or 0 for pairs that another rank counts
  void act(ContactBatch& batch, const ContactBatch::Row& counted, double dt);
  /// The film's part, in addition to act().
  /// \param wall  for batches of walls, whose second is not a particle
  void act_film(ContactBatch& batch, const ContactBatch::Row& force, const ContactBatch::Row& counted, double dt,
                bool wall);
  /// Power of a particle's films at the prediction error of its velocity, W. \param missed  v minus the prediction
  [[nodiscard]] double work_of_films(std::size_t particle, const Vector& missed) const;
  /// Adds work on a particle of this rank beyond the work at the predicted velocity, J.
  void correct(double work) { lost_.add(-work * unit_.per_unit); }
  /// Call it before the memory of separated contacts is cleared.
  /// \param owned  counts pairs whose first particle is below it
  void part(const Contacts& contacts, std::size_t owned);

  /// In the given unit, for this rank's contacts since the start.
  [[nodiscard]] const EnergySum& lost() const { return lost_; }

  void require(const core::Checkpoint& checkpoint) const override { require_sum(checkpoint, "dissipated"); }
  /// Excludes losses before the run began.
  void begin_from_other() { lost_ = EnergySum(); }
  void read(const Restored& from) override { lost_ = sum_on_first(from.ranks, from.checkpoint, "dissipated"); }

 private:
  [[nodiscard]] static int before_film(const PairLaws& laws) {
    return 2 + (laws.tangential ? 4 : 0) + (laws.rolling ? 4 : 0);
  }

  void add_films(const ContactBatch& batch, const ContactBatch::Row& force, bool wall);

  const PairLaws& laws_;
  int place_;
  bool synchronised_;
  double elastic_share_;  ///< energy of the normal spring over force times overlap
  FixedPoint unit_, force_;
  std::vector<std::array<std::int64_t, 3>> of_films_;  ///< their forces by particle; empty without predicted velocities
  EnergySum lost_;
};

}  // namespace polybed::dem
