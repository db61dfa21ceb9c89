#include "dem/coupling/affine_drag.hpp"

#include "closures/drag.hpp"
#include "closures/relevance.hpp"
#include "relevance/drag_law.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::dem {

AffineDrag::AffineDrag(const core::Scene& scene, const Materials& materials, const SolidsVolume& solids,
                       const Vector& box, FixedPoint force, FixedPoint energy)
    : shear_rate_(scene.column.shear_rate), force_(force), energy_(energy) {
  const double voidage = 1 - solids.all / (box[0] * box[1] * box[2]);
  std::vector<double> share = solids.of;
  for (double& x : share) x /= solids.all;
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  const closures::DragLaw law = relevance::drag_law_of(scene);
  std::vector<double> diameter;
  for (const Species& s : materials.species()) diameter.push_back(2 * s.radius);
  const std::vector<double> slip(diameter.size(), 0.0);
  std::vector<double> f(diameter.size()), slope(diameter.size());
  closures::drag_of_mixture(law, voidage, share, diameter, slip, fluid.density, fluid.viscosity, f, slope);
  for (std::size_t j = 0; j < diameter.size(); ++j)
    drag_.push_back(closures::drag_per_slip(diameter[j], fluid.viscosity, voidage, f[j]));
}

}  // namespace polybed::dem
