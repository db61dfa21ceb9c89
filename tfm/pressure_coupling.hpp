// Contribution of the net pressure to the rates: the last terms of (2) and (4).
#pragma once

#include <span>

#include "fluid/pressure.hpp"
#include "tfm/fields.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

/// Converts a_j into dU_j/dt and the free rate of J into dJ/dt: subtracts grad p / rho_j (form A) and B grad p, in
/// place; with added mass its responses times grad p. Reads fields.fluid.pressure and sets its ghosts.
void subtract_pressure_gradient(const Constants& constants, const fluid::Boundaries& boundaries, Fields& fields);

/// Writes the rates of all fields to their places in dydt; entries of the pressure stay unchanged, unless the fluid is
/// compressible.
void pack_rates(const StateLayout& layout, const Fields& fields, std::span<double> dydt);

}  // namespace polybed::tfm
