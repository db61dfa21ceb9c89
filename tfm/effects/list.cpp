// The list of effects of the continuum model.
#include "tfm/effects/maker.hpp"

namespace polybed::tfm {

namespace makers {

extern const Maker drag, partition, shape, fluid_stress, gas_slip, solids_stress, granular_temperature,
    solids_viscosity, species_exchange, added_mass, lift;

}  // namespace makers

const std::vector<const Maker*>& effects() {
  using namespace makers;
  static const std::vector<const Maker*> all{
      &drag,
      &partition,
      &shape,
      &fluid_stress,
      &gas_slip,
      &solids_stress,
      &granular_temperature,
      &solids_viscosity,
      &species_exchange,
      &added_mass,
      &lift,
  };
  return all;
}

}  // namespace polybed::tfm
