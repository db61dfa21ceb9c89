// Values to compare with an inversion velocity: the mixed interval from the force balance, and published results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "multiscale/inversion/models.hpp"

namespace polybed::app {

using multiscale::InversionPoint;

struct InversionBeside {
  /// Equal bulk densities of the pure beds, and the force balance, the lower first; empty if either has no root.
  std::optional<std::array<InversionPoint, 2>> mixed;
  std::vector<double> measured, simulated;  ///< m/s
};

/// \param law  in the case
[[nodiscard]] InversionBeside inversion_beside(const core::Scene& scene, const closures::DragLaw& law);

/// "mixed_interval_m_s", "measured_m_s" and "simulated_m_s".
[[nodiscard]] core::Json json_of(const InversionBeside& beside);
[[nodiscard]] std::string lines_of(const InversionBeside& beside);

}  // namespace polybed::app
