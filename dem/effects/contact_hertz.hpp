// Hertz's normal force with a dashpot for the required restitution.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

class HertzContact final : public NormalLaw {
 public:
  /// \param tail  clip: the force never attracts the particles; keep: the dashpot can
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
    double coefficient;            ///< K in F = K overlap^1.5, N/m^1.5
    double beta;
  };
  std::vector<Constants> constants_;
  double least_force_;  ///< N: 0, or no limit
};

}  // namespace polybed::dem
