#include "tfm/conservative_convection.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/vectors.hpp"
#include "fluid/convection.hpp"

namespace polybed::tfm {

using core::Field;
using core::Index;

ConservativeConvection::ConservativeConvection(const Constants& constants, const fluid::Boundaries& boundaries,
                                               bool limited)
    : constants_(constants),
      boundaries_(boundaries),
      limited_(limited),
      fluid_flux_(core::make_face_field(constants.grid)) {}

void ConservativeConvection::begin(const Fields& fields) { fluid_flux_ = fields.fluid.flux; }

void ConservativeConvection::carry_species(std::size_t j, core::FaceField& flux, Fields& fields) {
  const auto dimensions = std::size_t(constants_.grid.dimensions);
  std::array<fluid::Ghosts, 3> ghosts{};
  for (std::size_t a = 0; a < dimensions; ++a) ghosts[a] = {fluid::Ghosts::Kind::joined, &flux[a]};
  boundaries_.fill(std::span(ghosts).first(dimensions));
  for (std::size_t a = 0; a < dimensions; ++a)
    for (std::size_t f = 0; f < flux[a].size(); ++f) fluid_flux_[a][f] -= flux[a][f];
  core::in_vectors<carry>(*this, flux, fields.solids.velocity[j], fields.solids.fraction[j],
                          momentum_floor(constants_.bed_share[j]), false, fields.solids.acceleration[j]);
}

void ConservativeConvection::carry_fluid(Fields& fields) {
  core::in_vectors<carry>(*this, fluid_flux_, fields.fluid.velocity, fields.fluid.voidage, fluid::voidage_floor, true,
                          fields.fluid_acceleration);
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
