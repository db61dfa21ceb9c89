#include "relevance/effects/fluid_stress.hpp"

#include "tfm/effects/fluid_stress_newtonian.hpp"
#include "tfm/effects/maker.hpp"

namespace polybed::tfm::makers {

extern const Maker fluid_stress;
const Maker fluid_stress{
    &relevance::effects::fluid_stress,
    "Stress",
    [](const Making& m) { m.effects.fluid_stress = std::make_unique<NewtonianStress>(m.constants, m.boundaries); },
    {"newtonian"}};

}  // namespace polybed::tfm::makers
