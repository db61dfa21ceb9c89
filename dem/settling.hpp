// A bed at rest to start from.
#pragma once

#include <memory>

#include "core/checkpoint.hpp"
#include "core/ranks.hpp"
#include "core/scene.hpp"

namespace polybed::dem {

/// The particles of a scene, let fall from a loose random bed until they rest, with little bounce so that this takes
/// little time, on a closed bottom. At rest: their kinetic energy is a millionth of what lifts each by its radius.
/// Collective; on the first rank a checkpoint for Model::start_from. Throws core::NumericsError if they do not come to
/// rest in the time in which a particle falls through the box a hundred times, core::CaseError without gravity.
/// \param step  of the model that starts from it, s
[[nodiscard]] core::Checkpoint settled(const core::Scene& scene, double step,
                                       const std::shared_ptr<const core::Ranks>& ranks);

}  // namespace polybed::dem
