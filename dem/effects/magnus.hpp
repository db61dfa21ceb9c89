// Spin of spheres in a fluid, closures/magnus_rubinow_keller.hpp: the side force, and the torque that ends the spin.
#pragma once

#include <vector>

#include "dem/effects/side_forces.hpp"

namespace polybed::dem {

/// The force is explicit; it turns the slip at the rate (3/4) rho_f |Omega - omega/2|/rho_p and less. The torque is
/// taken exactly in a frozen fluid, Omega - omega/2 falling as exp(-60 mu t/(rho_p d^2)): no step is too long for it.
/// The averaged fluid has no spin of its own: the torque's reaction stays with it as heat.
class Magnus final : public SideForce {
 public:
  /// \param density, viscosity  of the fluid, kg/m3, Pa s  \param dt  step of the particles, s
  Magnus(const Materials& materials, double density, double viscosity, double dt);
  [[nodiscard]] bool needs_vorticity() const override { return true; }
  void add(const SideView& view, SideRows& rows) override;
  void turn(std::span<const Vector> vorticity, Particles& particles, FluidMotion& motion) override;

 private:
  struct Constants {
    double diameter;  ///< m
    double turned;    ///< 1 - exp(-60 mu dt/(rho_p d^2)): share of the spin's way to the fluid's in a step
  };
  std::vector<Constants> constants_;  ///< of each species
  double density_, viscosity_;
};

}  // namespace polybed::dem
