// The inversion point of a binary bed without a run: the velocity and voidage at which both species would rest in a
// uniform mixture. Contains the models of section 5.2 of the thesis that are defined there.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "closures/drag.hpp"
#include "core/case/scene.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

/// Two species in a fluid.
struct BinaryBed {
  std::array<double, 2> diameter{};  ///< m
  std::array<double, 2> density{};   ///< kg/m3
  std::array<double, 2> share{};     ///< x_j, sums to 1
  relevance::FluidConstants fluid;
  double gravity = 9.81;  ///< m/s2
};

/// The bed of a case; throws core::CaseError unless it has two species with their shares.
[[nodiscard]] BinaryBed binary_bed(const core::Scene& scene);

struct InversionPoint {
  double velocity;  ///< superficial, m/s
  double voidage;
};

/// The methods by name, with descriptions for messages and lists.
struct InversionMethod {
  std::string name, help;
  bool takes_law;        ///< the drag law affects the result
  bool takes_partition;  ///< and so does its distribution between the species
  std::vector<InversionPoint> (*points)(const BinaryBed& bed, const closures::DragLaw& law);
};
[[nodiscard]] const std::vector<InversionMethod>& inversion_methods();

/// All inversion points with 0.2 < voidage < 1, by increasing voidage; empty if there is none.
/// Throws core::CaseError for an unknown method.
///
/// - force_balance: T(5.4), (5.7), (5.12): F_d,j = (rho_j - rho_b) g V_j for both species; with di_felice T(5.13)
/// - bulk_density: T(5.8), Epstein and LeClair 1985: the pure beds at equal velocity have equal bulk density
/// - expansion: T(5.9), Masliyah 1979, with the voidages of Patwardhan and Tien and the exponent q_j - 2
/// - density_maximum: T(5.10), Gibilaro 1986: the composition has the largest bulk density at that velocity
///
[[nodiscard]] std::vector<InversionPoint> inversion_points(const BinaryBed& bed, const closures::DragLaw& law,
                                                           const std::string& method);

/// Species on top at velocities just below a point of the force balance: the one that rests in the mixture at a lower
/// velocity than the other. Above the point the other one is on top. Empty if a species floats there.
[[nodiscard]] std::optional<std::size_t> on_top_below(const BinaryBed& bed, const closures::DragLaw& law,
                                                      const InversionPoint& point);

}  // namespace polybed::multiscale
