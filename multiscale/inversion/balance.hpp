// Parts of the models of inversion: roots of a residual, and the velocity at which a species rests.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "multiscale/inversion/models.hpp"

namespace polybed::multiscale {

using Residual = std::function<std::optional<double>(double)>;

inline constexpr double least_voidage = 0.2;

/// Roots of a residual that may be undefined in places, in (low, high): sign changes of a scan, refined by bisection.
[[nodiscard]] std::vector<double> roots(const Residual& residual, double low, double high, int intervals);

/// u > 0 with load(u) = target, for a load that grows with u: bisection in the logarithm, then Ridders' method.
[[nodiscard]] double velocity_of(const std::function<double(double)>& load, double target);

/// Of solids and fluid together, kg/m3; T(5.6).
[[nodiscard]] double bulk_density(const BinaryBed& bed, double voidage);

/// Superficial velocity at which species j rests in a mixture, its drag being (rho_j - rho_b) g V_j; none where it
/// floats in the bulk. \param voidage  of the mixture
[[nodiscard]] std::optional<double> resting_velocity(const BinaryBed& bed, const closures::DragLaw& law, double voidage,
                                                     std::size_t j);

}  // namespace polybed::multiscale
