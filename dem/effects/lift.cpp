#include "dem/effects/lift.hpp"

#include "closures/lift_saffman_mei.hpp"
#include "dem/effects/maker.hpp"
#include "dem/effects/side_vectors.hpp"
#include "relevance/effects/lift.hpp"

namespace polybed::dem {

Lift::Lift(const Materials& materials, double density, double viscosity) : density_(density), viscosity_(viscosity) {
  for (const Species& s : materials.species()) diameter_.push_back(2 * s.radius);
}

void Lift::add(const SideView& view, SideRows& rows) {
  for (std::size_t i = 0; i < view.loads.size(); ++i)
    add_to(rows.of(i),
           closures::lift_saffman_mei(slip_of(view, i), to_vec3(view.vorticity[i]),
                                      diameter_[std::size_t(view.particles.species[i])], density_, viscosity_));
}

namespace makers {

extern const Maker lift;
const Maker lift{&relevance::effects::lift,
                 "Force",
                 MakeForce([](const ForceMaking& m) -> std::unique_ptr<SideForce> {
                   return std::make_unique<Lift>(m.materials, m.density, m.viscosity);
                 }),
                 {"saffman_mei"}};

}  // namespace makers

}  // namespace polybed::dem
