// Slot Stress of the fluid: viscous stress of a Newtonian fluid.
#pragma once

#include "fluid/viscous_stress.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

class NewtonianStress : public FluidStress {
 public:
  NewtonianStress(const Constants& constants, const fluid::Boundaries& boundaries)
      : constants_(constants), boundaries_(boundaries) {}
  void add(Fields& fields) override {
    fluid::add_viscous_stress(constants_.grid, boundaries_, fields.fluid, constants_.fluid, fields.fluid_acceleration);
  }
  [[nodiscard]] double kinematic_viscosity() const override {
    return constants_.fluid.viscosity / constants_.fluid.density;
  }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
};

}  // namespace polybed::tfm
