// Slot Stress of the fluid: viscous stress of a Newtonian fluid.
#include "relevance/effects/fluid_stress.hpp"

#include "fluid/viscous_stress.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::tfm {

namespace {

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

}  // namespace

namespace makers {

extern const Maker fluid_stress;
const Maker fluid_stress{&relevance::effects::fluid_stress, "Stress", [](const Making& m) {
                           m.effects.fluid_stress = std::make_unique<NewtonianStress>(m.constants, m.boundaries);
                         }};

}  // namespace makers

}  // namespace polybed::tfm
