// A bed at rest as a start.
#pragma once

#include <functional>
#include <memory>

#include "core/case/scene.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/checkpoint.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"

namespace polybed::dem {

/// Progress of a settling bed.
struct Settling {
  double time = 0, expected = 0;  ///< s, simulated, and from settling_time()
  double over_rest = 0;           ///< kinetic energy over the threshold of rest
};

/// The particles of a scene after they have fallen from a loose random bed and come to rest, with a low restitution to
/// save time, on a closed bottom, in a fluid without inflow, with a rotational spring instead of a constant rolling
/// moment. At rest their kinetic energy, without spin, which a point contact does not resist, is a millionth of the
/// energy that lifts each by its radius, or of its energy when it settles alone. Collective; on the first rank a
/// checkpoint for Model::start_from. Throws core::NumericsError, with the part that still moves, if they do not come to
/// rest in twenty times settling_time(), core::CaseError without gravity.
/// \param step  of the model that starts from it, s  \param see  called now and then, on every rank
[[nodiscard]] core::Checkpoint settled(const core::Scene& scene, double step,
                                       const std::shared_ptr<const core::Ranks>& ranks,
                                       const std::function<void(const Settling&)>& see = {});

/// Approximate time of this, s: 2.2 falls through the height of the start, up to 4.7 times as long with little
/// friction; in a fluid half as much again, plus the time in which the slowest species settles, or rises to the top of
/// the column. Measured: 0.5 to 1.9 times that in fifteen dry beds, 0.3 to 1.4 in eight in fluids.
[[nodiscard]] double settling_time(const core::Scene& scene, const Materials& materials, const Box& box);

}  // namespace polybed::dem
