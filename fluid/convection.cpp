#include "fluid/convection.hpp"

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "core/vectors.hpp"

namespace polybed::fluid {

namespace {

template <class Difference>
void convect(const core::Grid& grid, const Boundaries& boundaries, bool of_fluid, const core::FaceField& velocity,
             core::FaceField& acceleration) {
  for (int axis = 0; axis < grid.dimensions; ++axis) {
    core::Field& rate = acceleration[std::size_t(axis)];
    std::fill(rate.begin(), rate.end(), 0.0);
    // A limited slope on the outlet's faces would ask for a second layer of faces beyond it, which there is not.
    core::Box inside = core::interior_faces(grid, axis), at_outlet = boundaries.moving_faces(axis, of_fluid);
    at_outlet.lo[std::size_t(axis)] = inside.hi[std::size_t(axis)];
    if (!of_fluid) inside = boundaries.with_solids(inside);
    core::subtract_convection<Difference>(grid, velocity, axis, inside, rate);
    core::subtract_convection<core::UpwindDifference>(grid, velocity, axis, at_outlet, rate);
  }
}

}  // namespace

void convection(const core::Grid& grid, const Boundaries& boundaries, bool limited, bool of_fluid,
                const core::FaceField& velocity, core::FaceField& acceleration) {
  if (limited)
    core::in_vectors<convect<core::LimitedDifference>>(grid, boundaries, of_fluid, velocity, acceleration);
  else
    core::in_vectors<convect<core::UpwindDifference>>(grid, boundaries, of_fluid, velocity, acceleration);
}

}  // namespace polybed::fluid
