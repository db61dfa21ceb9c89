// Friction with partial slip, Mindlin and Deresiewicz's law in steps, in three dimensions.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

/// The rule of mindlin_deresiewicz.hpp along a direction e stored with a contact: the direction of its force, from
/// which it unloads and to which it reloads. e rotates with the pair. A displacement is split: the rule applies to its
/// part along e; the transverse part meets the whole stiffness 8 G* a and rotates the force, and e with it; mu F_n
/// limits the sum. A contact without force on its loading branch takes the direction of motion. Along a line there is
/// no transverse part, which leaves the plain rule. Around a circle that does not slide as a whole it loses almost
/// nothing after the first turn. No dashpot: partial slip dissipates energy.
class PartialSlipFriction final : public TangentialLaw {
 public:
  PartialSlipFriction(const Materials& materials, int place);
  void act(ContactBatch& batch, double dt) const override;
  /// e, the force along it, the force at both reversals, the branch and the last normal force.
  [[nodiscard]] int memory_size() const override { return 8; }
  /// For the force at stiffness 8 G* a: the least that a partly slipped contact returns.
  void energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;

 private:
  struct Constants {
    double friction, per_radius;  ///< mu, 8 G*
  };
  std::vector<Constants> constants_;
  int place_;
};

}  // namespace polybed::dem
