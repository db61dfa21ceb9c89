#include "tfm/conservative_convection.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/operators.hpp"

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
  carry(flux, fields.solids.velocity[j], fields.solids.fraction[j], momentum_floor(constants_.bed_share[j]), false,
        fields.solids.acceleration[j]);
}

void ConservativeConvection::carry_fluid(Fields& fields) {
  carry(fluid_flux_, fields.fluid.velocity, fields.fluid.voidage, fluid::voidage_floor, true,
        fields.fluid_acceleration);
}

void ConservativeConvection::carry(const core::FaceField& flux, const core::FaceField& velocity, const Field& fraction,
                                   double floor, bool of_fluid, core::FaceField& acceleration) const {
  const core::Grid& grid = constants_.grid;
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const Index s = grid.stride(axis);
    Field& rate = acceleration[a];
    std::fill(rate.begin(), rate.end(), 0.0);
    const core::Box inside = core::interior_faces(grid, axis);
    if (limited_)
      core::subtract_carried<core::LimitedFace>(grid, flux, velocity[a], axis, inside, rate);
    else
      core::subtract_carried<core::UpwindFace>(grid, flux, velocity[a], axis, inside, rate);
    const double* phi = fraction.data();
    core::for_each_row(grid, inside, [&](Index begin, Index end) {
      for (Index c = begin; c < end; ++c) rate[std::size_t(c)] /= std::max(core::face_mean(phi, c, s), floor);
    });
    // Half the momentum of a face on the outlet would lie beyond it: there the row stays (U.grad)U.
    core::Box at_outlet = boundaries_.moving_faces(axis, of_fluid);
    at_outlet.lo[a] = inside.hi[a];
    core::subtract_convection<core::UpwindDifference>(grid, velocity, axis, at_outlet, rate);
  }
}

}  // namespace polybed::tfm
