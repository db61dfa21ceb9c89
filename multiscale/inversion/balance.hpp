// Parts of the models of inversion: roots of a residual, and the velocity at which a species rests.
#pragma once

#include <array>
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

/// What the drag of a species follows from.
struct Around {
  double voidage;
  std::array<double, 2> share;
};

/// Superficial velocity at which species j rests in a mixture, its drag being (rho_j - rho_b) g V_j; none where it
/// floats in the bulk. \param voidage  of the mixture  \param around  what the species sees of it: the slip in the
/// drag law is that of one velocity between the particles, u around.voidage/voidage
[[nodiscard]] std::optional<double> resting_velocity(const BinaryBed& bed, const closures::DragLaw& law, double voidage,
                                                     const Around& around, std::size_t j);

/// Voidages and velocities at which both species rest in what each sees; none where around(voidage) has nothing.
[[nodiscard]] std::vector<InversionPoint> balanced(
    const BinaryBed& bed, const closures::DragLaw& law, int intervals,
    const std::function<std::optional<std::array<Around, 2>>(double voidage)>& around);

}  // namespace polybed::multiscale
