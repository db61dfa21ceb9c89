// The flow between joined ends: the mean gradient of the net pressure that drives it, and its mean velocities.
#pragma once

#include "measures/box_flow.hpp"
#include "tfm/fields.hpp"

namespace polybed::fluid {
class Boundaries;
}

namespace polybed::tfm {

/// The mean gradient, Pa/m: as given, or the one that carries the weight of all solids; 0 without joined ends.
/// Collective.
[[nodiscard]] double mean_gradient(const Constants& constants, const fluid::Interphase& solids);

/// Adds its accelerations: -G/rho_j and -G/rho_f, or in form B -G/(eps rho_f) of the fluid alone.
void subtract_mean_gradient(const Constants& constants, const fluid::Boundaries& boundaries, double gradient,
                            Fields& fields);

/// Mean velocities of the fields last evaluated. Collective.
[[nodiscard]] measures::BoxFlow box_flow(const Constants& constants, double gradient, const Fields& fields);

}  // namespace polybed::tfm
