#include "relevance/effects/solids_viscosity.hpp"

#include "tfm/effects/maker.hpp"
#include "tfm/effects/solids_viscosity_frictional.hpp"

namespace polybed::tfm::makers {

extern const Maker solids_viscosity;
const Maker solids_viscosity{&relevance::effects::solids_viscosity,
                             "Stress",
                             [](const Making& m) {
                               m.effects.solids_viscosity =
                                   std::make_unique<FrictionalViscosity>(m.scene, m.constants, m.law, m.fields);
                             },
                             {"schaeffer"}};

}  // namespace polybed::tfm::makers
