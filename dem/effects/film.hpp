// Lubrication as the force of the film, closures/lubrication.hpp.
#pragma once

#include <vector>

#include "dem/effects.hpp"

namespace polybed::dem {

/// -c v_n with c = 6 pi mu R*^2/h from a gap of 0.1 R* until the surfaces touch, h at least the roughness. It takes
/// energy both on approach and on the way apart; friction and rolling do not feel it.
///
/// Implicit in v_n: c/(1 + 6 c dt/m*). The 6 is for particles with many films: with it the greatest rate of a close
/// packing, 8 c/m with films along all its bonds, is at most (2/3)/dt however thin they are, where 2/dt is stable and
/// 1/dt with the synchronised integrator. It is as if h were greater by 36 pi mu R*^2 dt/m*: steps that shall tell
/// thinner films must be so much shorter.
class Film final : public FilmLaw {
 public:
  /// \param viscosity  Pa s  \param roughness  m
  Film(const Materials& materials, double viscosity, double roughness);
  void set_step(double dt) override;
  void act(const ContactBatch& batch, ContactBatch::Row& force) const override;
  [[nodiscard]] double reach() const override;

 private:
  struct Constants {
    double radius, mass;  ///< R*, m*
    double per_mass;      ///< 6 dt/m*, s/kg
  };
  std::vector<Constants> constants_;
  double viscosity_, roughness_;
};

}  // namespace polybed::dem
