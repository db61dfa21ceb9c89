// The least time until a bed can be steady after the fluid is switched on.
#pragma once

#include "multiscale/card/bed_of_case.hpp"
#include "multiscale/card/slices.hpp"

namespace polybed::multiscale {

/// A liquid bed's top moves at u - u_1 (closures/bed_expansion.hpp), in a column whose cross-section changes slice by
/// slice with the velocity there. A gas bed's height swings with its bubbles: no time is foreseen.
/// \param bed  with its expected state and height  \param start  height at the start, m
/// \param carried  u_1, the superficial velocity, m/s, that carries the bed at the voidage of its start
[[nodiscard]] FirstSteady first_steady(const core::Scene& scene, const Slices& slices, const BedOfCase& bed,
                                       double start, double carried);

}  // namespace polybed::multiscale
