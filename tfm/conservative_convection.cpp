#include "tfm/conservative_convection.hpp"

#include <algorithm>

#include "core/vectors.hpp"
#include "fluid/convection.hpp"

namespace polybed::tfm {

using core::Field;
using core::Index;

ConservativeConvection::ConservativeConvection(const Constants& constants, const fluid::Boundaries& boundaries,
                                               bool limited, Fields& fields)
    : constants_(constants),
      boundaries_(boundaries),
      limited_(limited),
      fields_(fields),
      fluid_flux_(core::make_face_field(constants.grid)) {
  for (core::FaceField& flux : fields.solids_flux)
    for (int axis = 0; axis < constants.grid.dimensions; ++axis)
      flux_ghosts_.push_back({fluid::Ghosts::Kind::joined, &flux[std::size_t(axis)]});
}

void ConservativeConvection::set() {
  boundaries_.fill(flux_ghosts_);
  fluid_flux_ = fields_.fluid.flux;
  for (std::size_t j = 0; j < constants_.species(); ++j) {
    const core::FaceField& flux = fields_.solids_flux[j];
    for (std::size_t a = 0; a < flux.size(); ++a)
      for (std::size_t f = 0; f < flux[a].size(); ++f) fluid_flux_[a][f] -= flux[a][f];
    core::in_vectors<carry>(*this, flux, fields_.solids.velocity[j], fields_.solids.fraction[j],
                            momentum_floor(constants_.bed_share[j]), false, fields_.solids.acceleration[j]);
  }
  core::in_vectors<carry>(*this, fluid_flux_, fields_.fluid.velocity, fields_.fluid.voidage, fluid::voidage_floor, true,
                          fields_.fluid_acceleration);
}

void ConservativeConvection::carry(const ConservativeConvection& by, const core::FaceField& flux,
                                   const core::FaceField& velocity, const Field& fraction, double floor, bool of_fluid,
                                   core::FaceField& acceleration) {
  const auto on_face = [phi = fraction.data(), floor](std::size_t, Index c, Index s) {
    return std::max(core::face_mean(phi, c, s), floor);
  };
  fluid::convection(by.constants_.grid, by.boundaries_, by.limited_, of_fluid, flux, velocity, on_face, acceleration);
}

}  // namespace polybed::tfm
