// Friction with partial slip, Mindlin and Deresiewicz's law in steps, in three dimensions.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

/// The rule of mindlin_deresiewicz.hpp along a direction e that a contact keeps: that of its force, from which it
/// unloads and to which it reloads. e turns with the pair. A displacement is split: its part along e goes through the
/// rule; the part across meets the whole stiffness 8 G* a and turns the force, and e with it; mu F_n bounds the sum. A
/// contact without force on its loading branch takes the direction in which it moves. Along a line there is no part
/// across, and the rule is left. Around a
/// circle that does not slide as a whole it loses almost nothing after the first turn. No dashpot: what slips loses
/// energy by itself.
class PartialSlipFriction final : public TangentialLaw {
 public:
  PartialSlipFriction(const Materials& materials, int place);
  void act(ContactBatch& batch, double dt) const override;
  /// e, the force along it, the force at both reversals, the branch and the last normal force.
  [[nodiscard]] int memory_size() const override { return 8; }
  /// Of the force held by 8 G* a: what a contact that has slipped in part gives back at least.
  void energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;

 private:
  struct Constants {
    double friction, per_radius;  ///< mu, 8 G*
  };
  std::vector<Constants> constants_;
  int place_;
};

}  // namespace polybed::dem
