// Absolute tolerances of the unknowns, from the one relative tolerance of a case.
#pragma once

#include <vector>

#include "core/numerics/error_weights.hpp"
#include "tfm/right_hand_side.hpp"

namespace polybed::tfm {

struct Tolerances {
  std::vector<double> absolute;  ///< by entry of the state
  core::TolerancesAt at;         ///< in their place where nothing flows in at times; empty elsewhere
};

/// Absolute tolerance of the fractions.
[[nodiscard]] inline double fraction_tolerance(double rtol) { return 0.1 * rtol; }

/// \param velocity_scale  m/s  \param pressure_scale  Pa: rtol times these is the tolerance of velocities and pressure
/// \param equations  outlive what is returned
[[nodiscard]] Tolerances tolerances_of(const RightHandSide& equations, const StateLayout& layout, double rtol,
                                       double velocity_scale, double pressure_scale);

}  // namespace polybed::tfm
