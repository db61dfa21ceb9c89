// The integrator for a scene, with the reason: from the case, or the one with the least expected cost.
#pragma once

#include <string>

#include "core/case/scene.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

struct IntegratorChoice {
  core::TfmIntegrator kind{};  ///< never automatic
  std::string reason;
};

/// The rule uses measured costs, docs/record/cost.md. A liquid bed is cheaper with steps that take only the drag
/// implicitly, unless one fully implicit step replaces more than 1.5 of them because the solids' pressure limits them.
/// A bed that settles or is fluidised by a gas is cheaper with fully implicit steps. Throws core::StartError if the
/// integrator cannot run the scene.
/// \param greatest_inflow  superficial velocity of the inlet, m/s
[[nodiscard]] IntegratorChoice choose_integrator(const core::Scene& scene, const Constants& constants,
                                                 const Effects& effects, double greatest_inflow);

}  // namespace polybed::tfm
