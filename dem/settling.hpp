// A bed at rest to start from.
#pragma once

#include <memory>

#include "core/case/scene.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"

namespace polybed::dem {

/// The particles of a scene, let fall from a loose random bed until they rest, with little bounce so that this takes
/// little time, on a closed bottom, in a fluid that does not flow in. At rest: their kinetic energy without that
/// of spin, which a contact at a point does not resist, is a millionth of what lifts each by its radius. Collective; on
/// the first rank a checkpoint for Model::start_from. Throws core::NumericsError if they do not come to rest in the
/// time in which a particle falls through the box a hundred times, core::CaseError without gravity.
/// \param step  of the model that starts from it, s
[[nodiscard]] core::Checkpoint settled(const core::Scene& scene, double step,
                                       const std::shared_ptr<const core::Ranks>& ranks);

/// s, that this takes about: 2.2 falls through the height of the start, and in a fluid half as much again and the time
/// in which the slowest species settles. Measured were 0.7 to 1.9 times that in nine dry beds, 0.9 to 1.2 in three in
/// water.
[[nodiscard]] double settling_time(const core::Scene& scene, const Materials& materials, const Box& box);

}  // namespace polybed::dem
