// Lift of spheres in a sheared fluid, closures/lift_saffman_mei.hpp.
#pragma once

#include <vector>

#include "dem/effects/side_forces.hpp"

namespace polybed::dem {

/// Saffman's lift with the share of Mei, from the slip U_f - U_p between the particles and the vorticity of the
/// averaged fluid: that of one sphere, at any voidage. Explicit: it turns the slip at a rate r of that at which Stokes'
/// drag brings it to rest, r = 0.17 sqrt(rho_f d^2 |omega|/mu), and no step of an exact drag is too long for r below 1.
class Lift final : public SideForce {
 public:
  /// \param density, viscosity  of the fluid, kg/m3, Pa s
  Lift(const Materials& materials, double density, double viscosity);
  [[nodiscard]] bool needs_vorticity() const override { return true; }
  void add(const SideView& view, SideRows& rows) override;

 private:
  std::vector<double> diameter_;  ///< of each species, m
  double density_, viscosity_;
};

}  // namespace polybed::dem
