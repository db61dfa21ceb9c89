#include "dem/coupling/fluid_motion.hpp"

namespace polybed::dem {

FluidMotion::FluidMotion(const Materials& materials, double fluid_density, Vector gravity, FixedPoint force,
                         FixedPoint energy, bool counts_work)
    : gravity_(gravity), force_(force), energy_(energy), counts_work_(counts_work) {
  for (const Species& species : materials.species()) {
    mass_.push_back(species.mass);
    Vector net = gravity;
    for (double& g : net) g *= 1 - fluid_density / species.density;
    net_gravity_.push_back(net);
  }
}

}  // namespace polybed::dem
