#include "relevance/effects/lubrication.hpp"
#include "dem/effects.hpp"
#include "dem/effects/film.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/wet_contact.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem::makers {

namespace {

void make_film(const PairMaking& m) {
  const double viscosity = relevance::fluid_constants(m.scene.fluid).viscosity;
  m.laws.film = std::make_unique<Film>(m.materials, viscosity, m.scene.material.roughness);
}

void make_wet_restitution(const PairMaking& m) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(m.scene.fluid);
  // Its memory is the first in a contact's. The law within has a damping ratio of 1, and its tail kept.
  m.around_normal = [&materials = m.materials, fluid, tail = m.scene.dem.tail](const MakeNormal& make) {
    return std::make_unique<WetContact>(make(materials.with_restitution(0), core::Tail::keep), materials,
                                        WetContact::Fluid{fluid.density, fluid.viscosity}, tail, 0);
  };
}

const PairMakers films{{"wet_restitution", make_wet_restitution}, {"film", make_film}};

}  // namespace

extern const Maker lubrication;
const Maker lubrication{&relevance::effects::lubrication,
                        "Pair",
                        MakePair([](const PairMaking& m) { films.at(m.law)(m); }),
                        {"wet_restitution", "film"}};

}  // namespace polybed::dem::makers
