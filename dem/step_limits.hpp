// The time step of the particles and its limits.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

struct StepLimit {
  std::string name;  ///< of the limit, with the species
  double dt = 0;     ///< s
};

struct StepLimits {
  double dt = 0;  ///< s
  std::string limited_by;
  double greatest_speed = 0;  ///< m/s, expected
  bool synchronised = false;  ///< the integrator, and the reason for it
  std::string integrator_reason;
  std::vector<StepLimit> all;  ///< the smallest first
  StepLimit stability;         ///< the full limit from the linear analysis: beyond it the solution for this pair grows
  std::string warning;         ///< for a step from the case, above half of that; empty otherwise
};

/// The step of a scene: the minimum of contact time over steps_per_contact, a share of the Rayleigh time, of the
/// oscillation of the stiffest contact and of the time to move a part of a diameter, over all species and pairs, and of
/// the limit from a fluid's viscous stress.
/// \param speed  greatest expected, m/s, above 0
[[nodiscard]] StepLimits step_limits(const core::Scene& scene, const Materials& materials, const PairLaws& laws,
                                     double speed);

}  // namespace polybed::dem
