// Sound in a pipe as a textbook of explicit methods computes it, for tests only.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::hard::naive {

/// As hard::Textbook::sound, by
///   explicit_sound  velocities from the old pressures, then pressures from the new velocities, whatever the step:
///                   stable below h/c
/// Throws std::invalid_argument for any other name.
[[nodiscard]] std::vector<double> bottom_pressures(const std::string& name, const core::Scene& scene, double step,
                                                   int steps);

}  // namespace polybed::hard::naive
