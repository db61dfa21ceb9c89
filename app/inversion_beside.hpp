// Values to compare with an inversion velocity: the mixed interval from the force balance, and published results.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "multiscale/inversion/models.hpp"

namespace polybed::app {

using multiscale::InversionPoint;

struct InversionBeside {
  std::optional<InversionPoint> densities, balance;  ///< equal bulk densities of the pure beds; the force balance
  /// Between both, the densities first; empty if either has no root or if the balance inverts first: they contradict.
  std::optional<std::array<InversionPoint, 2>> mixed;
  std::vector<double> measured, simulated;  ///< m/s
  /// The force balance with each formula of the shape that the case does not use.
  std::map<std::string, std::optional<InversionPoint>> shapes;
};

/// \param law  in the case
[[nodiscard]] InversionBeside inversion_beside(const core::Scene& scene, const closures::DragLaw& law);

/// "mixed_interval_m_s", "equal_bulk_density_m_s", "by_shapes", "measured_m_s" and "simulated_m_s".
[[nodiscard]] core::Json json_of(const InversionBeside& beside);
[[nodiscard]] std::string lines_of(const InversionBeside& beside);

}  // namespace polybed::app
