// Roles that contradict each other.
#pragma once

#include <vector>

#include "core/case/rule.hpp"
#include "core/case/scene.hpp"

namespace polybed::multiscale {

/// Two faults, one at each role, for each pair of roles of a scene that cannot both be, whatever the model; empty if
/// there is none.
[[nodiscard]] std::vector<core::SceneFault> role_conflicts(const core::Scene& scene);

}  // namespace polybed::multiscale
