// The list of effects of the particle model.
#include "dem/effects/maker.hpp"

namespace polybed::dem {

namespace makers {

extern const Maker drag, partition, shape, fluid_stress, gas_slip, added_mass, lift, magnus, history, brownian,
    lubrication, contact, rolling, cohesion, liquid_bridge;

}  // namespace makers

const std::vector<const Maker*>& effects() {
  using namespace makers;
  // A law that wraps the normal force comes before the normal force.
  static const std::vector<const Maker*> all{
      &drag,    &partition, &shape,       &fluid_stress, &gas_slip, &added_mass, &lift,          &magnus,
      &history, &brownian,  &lubrication, &contact,      &rolling,  &cohesion,   &liquid_bridge,
  };
  return all;
}

}  // namespace polybed::dem
