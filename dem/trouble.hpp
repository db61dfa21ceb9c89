// What the particle model says when it cannot go on: who, where, and what to do about it.
#pragma once

#include <cstdint>
#include <string>

#include "core/case/scene.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

/// The deepest overlap of this rank.
[[nodiscard]] std::string trouble_of_pair(const Model& model, const core::Scene& scene);

/// A particle of this rank that a step would move too far.
[[nodiscard]] std::string trouble_of_haste(const Model& model, const core::Scene& scene, std::int64_t id);

/// \param met, expected  greatest speeds, m/s
[[nodiscard]] std::string trouble_of_speed(const Model& model, double met, double expected);

}  // namespace polybed::dem
