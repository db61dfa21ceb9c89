// Partial slip of the solids along walls, after Johnson and Jackson.
#pragma once

#include "tfm/effects.hpp"

namespace polybed::tfm {

/// mu_s dU_t/dn = -B U_t with B = pi sqrt(3 theta) s rho phi g0/(6 phi_max) + p_f tan(delta_w)/|U_t|, n outward: sets
/// the ghosts of the velocities so that the wall's shear stress is that of U_t half way between ghost and cell. The
/// collisional part stands in stress.wall and is absent without kinetic theory.
class JohnsonJacksonWall : public SolidsWall {
 public:
  JohnsonJacksonWall(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                     Fields& fields);
  void fill_ghosts(Fields& fields) override;

 private:
  void fill(Fields& fields, std::size_t species, int along, int wall, int side) const;

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  double tangent_, least_shear_rate_;
};

}  // namespace polybed::tfm
