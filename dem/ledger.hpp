// The energy of the particles, where it is and where it went: it must add up.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/box.hpp"
#include "dem/contact_batch.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

/// What contacts have taken from motion for good, step by step.
///
/// Over a drift the work of a contact force is, to second order, (F_old + F_new)/2 . v_c dt with the half-step
/// velocity. Of the normal force only the dashpot's part counts, found from its own law and not as what is missing, so
/// that an error of the integration does not hide in it. Of the tangential force: the work less what the spring has
/// stored; of rolling friction likewise, with the relative spin. An attraction that is a function of the distance loses
/// nothing; what a contact loses that jumps together is counted at the jump.
class Ledger {
 public:
  /// Of the last step: the dashpot's force; with friction F_t and its energy; with rolling the moment and its energy.
  [[nodiscard]] static int memory_size(const PairLaws& laws) {
    return 1 + (laws.tangential ? 4 : 0) + (laws.rolling ? 4 : 0);
  }

  /// \param place  of its memory in a batch   \param unit  of the sum, J
  Ledger(const PairLaws& laws, int place, FixedPoint unit) : laws_(laws), place_(place), unit_(unit) {}

  /// After the contact's laws and before cohesion. \param counted  1, or 0 for pairs that another rank counts
  void act(ContactBatch& batch, const ContactBatch::Row& counted, double dt);

  /// J, of this rank's contacts since the start.
  [[nodiscard]] std::int64_t units() const { return units_; }
  void set_units(std::int64_t units) { units_ = units; }

 private:
  const PairLaws& laws_;
  int place_;
  FixedPoint unit_;
  std::int64_t units_ = 0;
};

}  // namespace polybed::dem
