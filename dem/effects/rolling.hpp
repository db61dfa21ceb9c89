// Moments that resist rolling, rolling_friction.hpp, with the part of w_i - w_j that lies in the plane of contact:
// twisting about n is not rolling and is free.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

/// A constant moment mu_r R* F_n against the rolling. No memory; at rest it flickers with the sign of the spin.
class ConstantRolling final : public RollingLaw {
 public:
  ConstantRolling(const Materials& materials, double rolling_friction);
  void act(ContactBatch& batch, double dt) const override;
  [[nodiscard]] int memory_size() const override { return 0; }
  void add_energy(const ContactBatch&, ContactBatch::Row&) const override {}
  [[nodiscard]] double stiffness(int, double) const override { return 0; }

 private:
  std::vector<double> arm_;  ///< mu_r R*, m
};

/// A spring of rotation k_r = 2.25 k_n mu_r^2 R*^2 with a dashpot, capped at mu_r R* F_n; k_n is the elastic force over
/// the overlap. The memory is the spring's moment, which turns with the pair.
class SpringRolling final : public RollingLaw {
 public:
  /// \param damping  share of the critical damping  \param place  of its memory in a batch
  SpringRolling(const Materials& materials, double rolling_friction, double damping, int place);
  void act(ContactBatch& batch, double dt) const override;
  [[nodiscard]] int memory_size() const override { return 3; }
  void add_energy(const ContactBatch& batch, ContactBatch::Row& stored) const override;
  [[nodiscard]] double stiffness(int kind, double normal_stiffness) const override;

 private:
  struct Constants {
    double arm, inertia;  ///< mu_r R*, m; I_r, kg m2
  };
  std::vector<Constants> constants_;
  double damping_;
  int place_;
};

}  // namespace polybed::dem
