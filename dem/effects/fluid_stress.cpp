// The averaged fluid includes it: fluid/flow.hpp.
#include "relevance/effects/fluid_stress.hpp"

#include "dem/effects/maker.hpp"

namespace polybed::dem::makers {

extern const Maker fluid_stress;
const Maker fluid_stress{&relevance::effects::fluid_stress, "Stress"};

}  // namespace polybed::dem::makers
