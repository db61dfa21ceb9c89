// A bed at rest to start from.
#pragma once

#include <functional>
#include <memory>

#include "core/case/scene.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"

namespace polybed::dem {

/// How far a bed has come.
struct Settling {
  double time = 0, expected = 0;  ///< s, simulated and by settling_time()
  double over_rest = 0;           ///< energy of motion over that of rest
};

/// The particles of a scene, let fall from a loose random bed until they rest, with little bounce so that this takes
/// little time, on a closed bottom, in a fluid that does not flow in, with a spring of rotation in place of a constant
/// rolling moment. At rest: their kinetic energy without that of spin, which a contact at a point does not resist, is a
/// millionth of what lifts each by its radius, or of what it has as it settles alone. Collective; on the first rank a
/// checkpoint for Model::start_from. Throws core::NumericsError, with what still moves, if they do not come to rest in
/// twenty times settling_time(), core::CaseError without gravity.
/// \param step  of the model that starts from it, s  \param see  called now and then, on every rank
[[nodiscard]] core::Checkpoint settled(const core::Scene& scene, double step,
                                       const std::shared_ptr<const core::Ranks>& ranks,
                                       const std::function<void(const Settling&)>& see = {});

/// s, that this takes about: 2.2 falls through the height of the start, up to 4.7 times as long with little friction,
/// and in a fluid half as much again and the time in which the slowest species settles, or rises to the top of the
/// column. Measured were 0.5 to 1.9 times that in fifteen dry beds, 0.3 to 1.4 in eight in fluids.
[[nodiscard]] double settling_time(const core::Scene& scene, const Materials& materials, const Box& box);

}  // namespace polybed::dem
