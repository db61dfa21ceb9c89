// The energy of the particles, where it is and where it went: it must add up.
#pragma once

#include "dem/box.hpp"
#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/effects.hpp"
#include "dem/kept_part.hpp"
#include "dem/kept_sums.hpp"

namespace polybed::dem {

/// What contacts have taken from motion for good, step by step.
///
/// A force acts for half a step before the drift that follows it and for half a step after the one that leads to it.
/// The thesis scheme knows the velocity of a drift, v_h: the work over it is (F_old + F_new)/2 . v_h dt, exactly that
/// of the kicks. The synchronised scheme knows the velocity at the time of the force, and the work is F . v dt, half of
/// it now and half in the next step, whose length may be another; with v_h in place of v, or the other way round, the
/// account errs by first order in dt. Its contacts see the velocity and spin foreseen with the loads of the last step.
/// Where those jump, as a constant moment against rolling that flickers at rest, or the force of a film that stops a
/// particle within a few steps, the work of torque and film on what was missed is first order too, and counted.
///
/// Of the normal force only the dashpot's part counts, found from its own law and not as what is missing, so that an
/// error of the integration does not hide in it. Of the tangential force: the work less what the spring has stored; of
/// rolling friction likewise, with the relative spin. An attraction that is a function of the distance loses nothing;
/// what a contact loses that jumps together is counted at the jump.
///
/// A contact that parts is counted once more: for the half step that its last force still acts, and for what its
/// springs held. Where a clipped tail has ended the force early, that is the elastic energy left in the overlap.
class Ledger final : public KeptPart {
 public:
  /// The dashpot's force of the last step, or the synchronised scheme's power; what is lost if the contact
  /// parts; with friction F_t of the last step and its energy; with rolling the moment and its energy; with a film as
  /// of the dashpot.
  [[nodiscard]] static int memory_size(const PairLaws& laws) { return before_film(laws) + (laws.film ? 2 : 0); }

  /// \param place  of its memory in a batch   \param synchronised  velocities of the batch are those at the time of the
  /// force   \param unit  of the sum, J   \param force  unit of forces, N
  Ledger(const PairLaws& laws, int place, bool synchronised, FixedPoint unit, FixedPoint force);

  /// Before the forces of a step are found. \param particles  of this rank, with ghosts
  void begin_step(std::size_t particles);

  /// After the contact's laws and before cohesion. \param counted  1, or 0 for pairs that another rank counts
  void act(ContactBatch& batch, const ContactBatch::Row& counted, double dt);
  /// The film's part, beside act().
  /// \param wall  batches of walls, whose second is no particle
  void act_film(ContactBatch& batch, const ContactBatch::Row& force, const ContactBatch::Row& counted, double dt,
                bool wall);
  /// What a particle's films do at the velocity that they did not foresee, W. \param missed  v less the one foreseen
  [[nodiscard]] double work_of_films(std::size_t particle, const Vector& missed) const;
  /// What has been done to a particle of this rank beyond the work at the velocity that contacts foresaw, J.
  void correct(double work) { lost_.add(-work * unit_.per_unit); }
  /// Before the memory of contacts that have parted is forgotten.
  /// \param owned  pairs whose first particle is below it are counted here
  void part(const Contacts& contacts, std::size_t owned);

  /// In the unit given, of this rank's contacts since the start.
  [[nodiscard]] const EnergySum& lost() const { return lost_; }

  void require(const core::Checkpoint& checkpoint) const override { require_sum(checkpoint, "dissipated"); }
  /// What was lost before the run began is not of it.
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
  double elastic_share_;  ///< energy of the normal spring over force and overlap
  FixedPoint unit_, force_;
  std::vector<std::array<std::int64_t, 3>> of_films_;  ///< their forces by particle; none without foreseen velocities
  EnergySum lost_;
};

}  // namespace polybed::dem
