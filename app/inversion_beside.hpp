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

/// Whether a law is made for such a bed at its point: not for lone or dilute spheres, nor for comparison alone, and
/// within its stated range, unless it was derived from such beds.
[[nodiscard]] bool suits_point(const std::string& name, const closures::DragLaw& law, const multiscale::BinaryBed& bed,
                               const multiscale::InversionPoint& point);

/// Whether a point is within the range of a law, and its Reynolds number.
struct RangeAt {
  bool within;
  double reynolds;  ///< of the Sauter diameter and the superficial velocity
};
[[nodiscard]] RangeAt range_at(const closures::DragLaw& law, const multiscale::BinaryBed& bed,
                               const multiscale::InversionPoint& point);

/// A line for a point outside the range of its law, or of a law file without a range; otherwise empty.
[[nodiscard]] std::string range_warning(const closures::DragLaw& law, const multiscale::BinaryBed& bed,
                                        const multiscale::InversionPoint& point);

/// Which species is below at all velocities, for a law without an inversion point; empty if that is not known.
[[nodiscard]] std::string line_without_point(const core::Scene& scene, const closures::DragLaw& law);

}  // namespace polybed::app
