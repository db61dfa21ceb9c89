// Drag and what is part of it: the slip of a gas lowers it, dem/coupling/particle_forces.cpp.
#include "relevance/effects/drag.hpp"

#include "dem/effects/maker.hpp"
#include "relevance/effects/gas_slip.hpp"

namespace polybed::dem::makers {

extern const Maker drag, gas_slip;
const Maker drag{
    &relevance::effects::drag,
    "Exchange",
    MakeLoad([](const std::string& law, LoadLaws& laws) { laws.drag = closures::drag_law(law, closures::Guard::on); }),
    {"none"}};
const Maker gas_slip{&relevance::effects::gas_slip, "Exchange"};

}  // namespace polybed::dem::makers
