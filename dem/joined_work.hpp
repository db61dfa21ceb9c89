// Work of joined faces on the particles between them.
#pragma once

#include <cstdint>
#include <utility>

#include "dem/box.hpp"
#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/kept_part.hpp"
#include "dem/kept_sums.hpp"

namespace polybed::dem {

/// Whether a particle that leaves through a joined face returns higher or lower.
[[nodiscard]] inline bool falls_through_joined_faces(const Box& box, const Vector& gravity) {
  for (std::size_t k = 0; k < 3; ++k)
    if (box.periodic[k] && gravity[k] != 0) return true;
  return false;
}

/// If gravity has a component along a joined direction, a particle that leaves through a face returns higher or lower
/// through the other one, and its potential energy changes by m g . (x - x_back). Energies in a sheared box are in the
/// frame of its bottom, and the faces work as follows.
///
/// A contact across the faces acts on a particle and on the image of another, b boxes higher and faster by b U than the
/// other itself. Its force F on the first does the work F . (v_i - v_j) = F . (v_i - v_image) + F_x b U on the two: the
/// ledger of contacts has the first part, the faces the second. A force acts for half a step before and half a step
/// after its evaluation, so the parts of two successive forces add up to the work over a drift, and the half step of a
/// separating contact is not lost. A particle that leaves through a face and returns through the other changes its
/// speed by U: its change of energy is work of the faces too.
class JoinedWork final : public KeptPart {
 public:
  /// \param force  unit of a batch's forces  \param energy  unit of the sum, J  \param dt  s
  JoinedWork(FixedPoint force, FixedPoint energy, double dt)
      : per_force_(0.5 * dt * force.unit * energy.per_unit), per_energy_(energy.per_unit) {}

  /// Call it after the forces of a batch. \param counted  1, or 0 for pairs that another rank counts
  void act(const ContactBatch& batch, const ContactBatch::Row& counted, const Contacts& contacts,
           const Images& images) {
    for (int c = 0; c < batch.count; ++c) {
      const double speed = images.speed[std::size_t(contacts.pairs[std::size_t(batch.pair[c])].image)];
      now_.add(counted[c] * batch.force[0][c] * speed * per_force_);
    }
  }
  /// Call it after the first forces.
  void begin() { pass_on(); }
  /// Between two drifts: half of the last forces, and half of the new ones.
  void add_forces() {
    sum_.add(before_);
    sum_.add(now_);
    pass_on();
  }
  /// Call it when a particle is back between the joined faces. \param gained  energy, J; 0 if it has not left
  void wrapped(double gained) {
    if (gained < 0 || gained > 0) sum_.add(gained * per_energy_);  // skips NaN
  }
  /// Clears the count of another run; the forces of this start are due.
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
  EnergySum sum_;     ///< on this rank since the start, in the given unit
  EnergySum before_;  ///< half of the last forces, due in the next step
  EnergySum now_;
};

}  // namespace polybed::dem
