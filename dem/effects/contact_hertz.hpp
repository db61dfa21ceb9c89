// Hertz's normal force with a dashpot that gives the restitution asked for.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

class HertzContact final : public NormalLaw {
 public:
  /// \param tail  clip: no force pulls the particles together; keep: the dashpot may
  HertzContact(const Materials& materials, core::Tail tail);
  void act(ContactBatch& batch) const override;
  [[nodiscard]] double energy(int kind, double overlap) const override;
  [[nodiscard]] double force_at(int kind, double overlap) const override;
  [[nodiscard]] double contact_time(int kind, double speed) const override;
  [[nodiscard]] double overlap_of_impact(int kind, double speed) const override;
  [[nodiscard]] double stiffness_at(int kind, double overlap) const override;
  [[nodiscard]] double damping_ratio(int kind) const override;

 private:
  struct Constants {
    double mass, radius, modulus;  ///< m*, R*, E*
    double dashpot;                ///< c_n/sqrt(a)
    double coefficient;            ///< K of F = K overlap^1.5, N/m^1.5
    double beta;
  };
  std::vector<Constants> constants_;
  double least_force_;  ///< N: 0, or none
};

}  // namespace polybed::dem
