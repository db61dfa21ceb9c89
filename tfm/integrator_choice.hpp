// Which integrator a scene is run with, and why: as the case says, or the one that is expected to be cheapest.
#pragma once

#include <string>

#include "core/case/scene.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

struct IntegratorChoice {
  core::TfmIntegrator kind{};  ///< not automatic
  std::string reason;
};

/// The rule rests on measured costs, docs/record/cost.md: a liquid bed is cheaper with steps that take the drag alone
/// implicitly, unless a wholly implicit one replaces more than 1.5 of them, because the solids' pressure binds them;
/// one that settles or is fluidised by a gas is cheaper with wholly implicit ones. Throws core::StartError where the
/// integrator cannot run the scene.
/// \param greatest_inflow  superficial velocity of the inlet, m/s
[[nodiscard]] IntegratorChoice choose_integrator(const core::Scene& scene, const Constants& constants,
                                                 const Effects& effects, double greatest_inflow);

}  // namespace polybed::tfm
