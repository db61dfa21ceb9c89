// The holes that discharges are in the faces of the box.
#pragma once

#include <utility>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/box.hpp"

namespace polybed::dem {

struct Hole {
  std::size_t discharge;  ///< number of the first one that it is of, from 0
  Opening opening;
};

/// Discharges that share a whole edge, also across joined sides, are one rectangle. Rules ask also for those of cases
/// whose corners they refuse.
[[nodiscard]] std::vector<Hole> rectangles_of(const core::Scene& scene, const Box& box);

/// The same as holes, which have no rim where they end with their face, and none along an axis that they span.
[[nodiscard]] std::vector<Hole> holes_of(const core::Scene& scene, const Box& box);

/// Numbers of two discharges whose holes share a part of an edge: there a particle would meet the rims of both.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> holes_in_part_joined(const core::Scene& scene,
                                                                                    const Box& box);

}  // namespace polybed::dem
