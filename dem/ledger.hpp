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
/// it now and half in the next step; with v_h in place of v, or the other way round, the account errs by first order in
/// dt. Its contacts see the spin foreseen with the torque of the last step: where torques jump, as of a constant moment
/// against rolling that flickers at rest, the work of each particle's torque on the spin missed is first order too, and
/// counted.
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
  /// The dashpot's force of the last step, or the synchronised scheme's work still due; what is lost if the contact
  /// parts; with friction F_t of the last step and its energy; with rolling the moment and its energy; with a film as
  /// of the dashpot.
  [[nodiscard]] static int memory_size(const PairLaws& laws) { return before_film(laws) + (laws.film ? 2 : 0); }

  /// \param place  of its memory in a batch   \param synchronised  velocities of the batch are those at the time of the
  /// force   \param unit  of the sum, J
  Ledger(const PairLaws& laws, int place, bool synchronised, FixedPoint unit);

  /// After the contact's laws and before cohesion. \param counted  1, or 0 for pairs that another rank counts
  void act(ContactBatch& batch, const ContactBatch::Row& counted, double dt);
  /// The film's part, beside act().
  void act_film(ContactBatch& batch, const ContactBatch::Row& force, const ContactBatch::Row& counted, double dt);
  /// What torques have done to a particle of this rank beyond their work at the spin that contacts foresaw, J.
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

  const PairLaws& laws_;
  int place_;
  bool synchronised_;
  double elastic_share_;  ///< energy of the normal spring over force and overlap
  FixedPoint unit_;
  EnergySum lost_;
};

}  // namespace polybed::dem
