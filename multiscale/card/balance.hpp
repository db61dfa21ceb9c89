// The balance of drag and weight in a scene: minimum fluidisation, height and pressure drop of a uniform bed.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "closures/bed_expansion.hpp"
#include "closures/drag.hpp"
#include "closures/minimum_fluidisation.hpp"
#include "closures/pressure_drop.hpp"
#include "multiscale/card/slices.hpp"

namespace polybed::multiscale {

/// The balance of drag and weight in a scene.
struct Balance {
  std::string name;
  std::optional<closures::DragLaw> law;
  double packed = 0;  ///< voidage of the settled bed; 0: unknown

  [[nodiscard]] auto drag() const {
    return [this](double eps, double re) { return closures::pure_drag_at(*law, eps, re); };
  }
  [[nodiscard]] bool known() const { return law && packed > 0; }
  [[nodiscard]] std::optional<double> minimum_fluidisation(const closures::CarriedBed& bed) const {
    return minimum_fluidisation(bed, packed);
  }
  /// \param at  voidage of the bed when settled
  [[nodiscard]] std::optional<double> minimum_fluidisation(const closures::CarriedBed& bed, double at) const {
    if (!(bed.excess > 0 && bed.gravity > 0)) return {};
    if (known()) return closures::carrying_velocity(drag(), bed, at);
    return closures::minimum_fluidisation(bed.diameter, bed.excess, bed.fluid_density, bed.viscosity, bed.gravity);
  }
  /// \param solids  volume over the area of the bottom, m
  [[nodiscard]] std::optional<Filled> height(const Slices& slices, const closures::CarriedBed& bed, double velocity,
                                             double solids) const {
    if (!known() || !(solids > 0)) return {};
    const auto fraction_at = [&](double u) { return 1 - closures::carried_voidage(drag(), bed, u, packed); };
    if (!slices.empty())
      return fill(slices, solids,
                  [&](std::size_t n) { return fraction_at(velocity * slices.height[n] / slices.even[n]); });
    const double fraction = fraction_at(velocity);
    return fraction > 0 ? std::optional(Filled{solids / fraction, solids}) : std::nullopt;
  }
  /// Pressure drop of the settled bed at rest, Pa.
  [[nodiscard]] std::optional<double> packed_drop(const closures::CarriedBed& bed, double velocity,
                                                  double solids) const {
    if (!known() || !(solids > 0)) return {};
    return solids / (1 - packed) * closures::pressure_gradient(drag(), bed, packed, std::abs(velocity));
  }
};

}  // namespace polybed::multiscale
