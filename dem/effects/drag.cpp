// Drag and what is part of it: a partition shares it, shapes raise it, the slip of a gas lowers it,
// dem/coupling/particle_forces.cpp.
#include "relevance/effects/drag.hpp"

#include "dem/effects/maker.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/effects/gas_slip.hpp"
#include "relevance/effects/partition.hpp"
#include "relevance/effects/shape.hpp"

namespace polybed::dem::makers {

extern const Maker drag, partition, shape, gas_slip;
const Maker drag{&relevance::effects::drag, "Exchange",
                 MakeLoad([](const core::Scene& scene, const std::string&, LoadLaws& laws) {
                   laws.drag = relevance::drag_law_of(scene);
                 })};
const Maker partition{&relevance::effects::partition, "Exchange"};
const Maker shape{&relevance::effects::shape, "Exchange"};
const Maker gas_slip{&relevance::effects::gas_slip, "Exchange"};

}  // namespace polybed::dem::makers
