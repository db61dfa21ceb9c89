// The time step of the particles and what limits it.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/effects.hpp"

namespace polybed::dem {

struct StepLimit {
  std::string name;  ///< what it is, with the species
  double dt = 0;     ///< s
};

struct StepLimits {
  double dt = 0;  ///< s
  std::string limited_by;
  double greatest_speed = 0;  ///< m/s, expected
  bool synchronised = false;  ///< the integrator, and why
  std::string integrator_reason;
  std::vector<StepLimit> all;  ///< the smallest first
  StepLimit stability;         ///< whole, of the linear analysis: beyond it the numbers of this pair grow
  std::string warning;         ///< of a step that the case gives, beyond half of that; empty: it is not
};

/// The step of a scene: the smallest of contact time over steps_per_contact, a share of the Rayleigh time, of the
/// oscillation of the stiffest contact and of the time to move a part of a diameter, the smallest over species and
/// pairs, and of what the viscous stress of a fluid bears.
/// \param speed  greatest expected, m/s, above 0
[[nodiscard]] StepLimits step_limits(const core::Scene& scene, const Materials& materials, const PairLaws& laws,
                                     double speed);

}  // namespace polybed::dem
