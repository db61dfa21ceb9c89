// The holes that discharges are in the faces of the box.
#pragma once

#include <utility>
#include <vector>

#include "core/case/scene.hpp"
#include "dem/box.hpp"

namespace polybed::dem {

struct Hole {
  std::size_t discharge;  ///< the first of its discharges, from 0
  Opening opening;
};

/// Discharges that share a whole edge, also across joined sides, are one rectangle. Corner lists of a wrong length are
/// read as far as they go: rules call this for cases that other rules refuse.
[[nodiscard]] std::vector<Hole> rectangles_of(const core::Scene& scene, const Box& box);

/// These rectangles as holes: without a rim where they end with their face, or along an axis that they span.
[[nodiscard]] std::vector<Hole> holes_of(const core::Scene& scene, const Box& box);

/// For particles that are counted where they leave: the rectangle of each discharge, and an open top. Empty if there
/// are fewer than two.
[[nodiscard]] std::vector<Opening> exits_of(const core::Scene& scene, const Box& box);

/// Pairs of discharges, from 0, whose rectangles share a part of an edge: a particle there would meet the rims of both.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> touching_holes(const core::Scene& scene, const Box& box);

}  // namespace polybed::dem
