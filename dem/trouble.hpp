// Messages of the particle model when it cannot continue: particles, place, and what to do.
#pragma once

#include <cstdint>
#include <string>

#include "core/case/scene.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

/// Reports the deepest overlap on this rank.
[[nodiscard]] std::string trouble_of_pair(const Model& model, const core::Scene& scene);

/// Reports a particle on this rank that a step would move too far.
[[nodiscard]] std::string trouble_of_haste(const Model& model, const core::Scene& scene, std::int64_t id);

/// \param met, expected  greatest speeds, m/s
[[nodiscard]] std::string trouble_of_speed(const Model& model, double met, double expected);

}  // namespace polybed::dem
