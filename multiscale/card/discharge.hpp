// Discharge that a case of dry particles leads to expect.
#pragma once

#include <optional>
#include <vector>

#include "multiscale/card/bed_of_case.hpp"

namespace polybed::multiscale {

/// Discharge of a case's particles through its opening, with their Sauter diameter and the settled solids fraction;
/// nothing between walls inside other than cones. \param share  by volume, of each species
[[nodiscard]] std::optional<ExpectedDischarge> expected_discharge(const core::Scene& scene,
                                                                  const std::vector<double>& share, double gravity);

}  // namespace polybed::multiscale
