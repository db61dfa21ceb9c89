// Work that joined faces do on the particles between them.
#pragma once

#include <cstdint>
#include <utility>

#include "dem/box.hpp"
#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/kept_part.hpp"
#include "dem/kept_sums.hpp"

namespace polybed::dem {

/// Whether a particle that leaves through a joined face comes back higher or lower.
[[nodiscard]] inline bool falls_through_joined_faces(const Box& box, const Vector& gravity) {
  for (std::size_t k = 0; k < 3; ++k)
    if (box.periodic[k] && gravity[k] != 0) return true;
  return false;
}

/// Where gravity has a part along a joined direction, a particle that leaves through a face comes back higher or lower
/// through the other one, and its potential energy changes by m g . (x - x_back). In a sheared box energies are those
/// at rest with its bottom, and the faces work as follows.
///
/// A contact across the faces acts on a particle and on the image of another, which is faster by b U than the other
/// itself, b boxes up. Its force F on the first works F . (v_i - v_j) = F . (v_i - v_image) + F_x b U on the two: the
/// ledger of contacts has the first part, the second is the faces'. A force acts for half a step before and for half a
/// step after the time it is found for, so the parts of two successive forces add up to the work over a drift, and the
/// half step of a contact that parts is not lost. A particle that leaves through a face and comes back through the
/// other changes its speed by U: what its energy changes by is the faces' work too.
class JoinedWork final : public KeptPart {
 public:
  /// \param force  unit of the forces of a batch  \param energy  unit of the sum, J  \param dt  s
  JoinedWork(FixedPoint force, FixedPoint energy, double dt)
      : per_force_(0.5 * dt * force.unit * energy.per_unit), per_energy_(energy.per_unit) {}

  /// After the forces of a batch are found. \param counted  1, or 0 for pairs that another rank counts
  void act(const ContactBatch& batch, const ContactBatch::Row& counted, const Contacts& contacts,
           const Images& images) {
    for (int c = 0; c < batch.count; ++c) {
      const double speed = images.speed[std::size_t(contacts.pairs[std::size_t(batch.pair[c])].image)];
      now_.add(counted[c] * batch.force[0][c] * speed * per_force_);
    }
  }
  /// Once the first forces are found.
  void begin() { pass_on(); }
  /// Between two drifts: half of the last forces, and half of those just found.
  void add_forces() {
    sum_.add(before_);
    sum_.add(now_);
    pass_on();
  }
  /// A particle is back between the joined faces. \param gained  energy, J; 0 if it has not left
  void wrapped(double gained) {
    if (gained < 0 || gained > 0) sum_.add(gained * per_energy_);  // not what is no number
  }
  /// What another run has counted is not of this one; the forces of its start are due.
  void begin_from_other() {
    sum_ = EnergySum();
    pass_on();
  }

  [[nodiscard]] const EnergySum& sum() const { return sum_; }
  void write(core::Checkpoint& checkpoint, const Particles&, const core::Ranks* ranks) const override {
    write_sum(checkpoint, ranks, "flow_work", sum_);
    write_sum(checkpoint, ranks, "flow_work_due", before_);
  }
  void read(const Restored& from) override {
    sum_ = sum_on_first(from.ranks, from.checkpoint, "flow_work");
    before_ = sum_on_first(from.ranks, from.checkpoint, "flow_work_due");
  }

 private:
  void pass_on() { before_ = std::exchange(now_, EnergySum()); }

  double per_force_, per_energy_;
  EnergySum sum_;     ///< of this rank since the start, in the unit given
  EnergySum before_;  ///< half of the last forces, due in the next step
  EnergySum now_;
};

}  // namespace polybed::dem
