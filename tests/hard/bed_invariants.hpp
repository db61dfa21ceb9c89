// What a bed of the continuum is held to by the hard cases: its fastest phase, the forces that carry it, and whether
// all of it are numbers.
#pragma once

#include "tfm/model.hpp"

namespace polybed::hard {

/// The greatest speed of any phase, m/s: the mixture's on all faces, that of solids on faces with more than a fraction
/// of
/// them. \param above  that fraction, 0 to 1
[[nodiscard]] double fastest(const core::Grid& grid, const tfm::Fields& fields, double above);

/// What a step is held against, s: a cell over the fastest speed, or the time in which slip relaxes if that is shorter.
[[nodiscard]] double characteristic_time(const tfm::Model& model, const tfm::Fields& fields);

/// What carries the bed, pressure drop, thrust and solids pressure on the distributor, over buoyant weight per area,
/// less 1.
[[nodiscard]] double force_balance(const tfm::Model& model, const tfm::Fields& fields);

/// Of all that a run goes on from or is judged by: no number if one of them is none. Comparisons let such ones pass.
[[nodiscard]] double sum_of(const tfm::Fields& fields);

}  // namespace polybed::hard
