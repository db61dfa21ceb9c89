// What stands beside an inversion velocity: the mixed interval by force balance, what particles see, and what others
// have found.
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
  /// Equal bulk densities of the pure beds, and the balance of forces, the lower first; empty if either has no root.
  std::optional<std::array<InversionPoint, 2>> mixed;
  bool seen_asked = false;
  std::optional<InversionPoint> kept_out, percus_yevick;  ///< by force balance with what particles see
  std::vector<double> measured, simulated;                ///< m/s
};

/// \param law  of the case  \param seen  whether to balance with what particles see; throws core::CaseError where the
/// case has no cells to average over
[[nodiscard]] InversionBeside inversion_beside(const core::Scene& scene, const closures::DragLaw& law, bool seen);

/// "mixed_interval_m_s", "seen" (null unless asked for), "measured_m_s" and "simulated_m_s".
[[nodiscard]] core::Json json_of(const InversionBeside& beside);
[[nodiscard]] std::string lines_of(const InversionBeside& beside);

}  // namespace polybed::app
