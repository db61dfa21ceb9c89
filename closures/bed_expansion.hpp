// Balance of drag and buoyant weight in a uniform bed of one size, or of a mixture with its Sauter diameter and mean
// density: 18 mu u f(eps, Re)/D^2 = |rho_s - rho_f| g eps, T(1.49) with T(1.24). Drag decreases with voidage and
// increases with the superficial slip velocity u, so both roots are found by bisection.
#pragma once

namespace polybed::closures {

/// A suspended bed and its fluid.
struct CarriedBed {
  double diameter, excess;          ///< D, m; |rho_s - rho_f|, kg/m3
  double fluid_density, viscosity;  ///< kg/m3, Pa s
  double gravity;                   ///< m/s2
};

/// Whether the drag at a voidage and a superficial slip velocity exceeds the weight.
/// \param f  callable (voidage, reynolds) -> pure drag over Stokes
template <class Drag>
[[nodiscard]] bool is_carried(Drag&& f, const CarriedBed& bed, double voidage, double velocity) {
  const double reynolds = bed.fluid_density * velocity * bed.diameter / bed.viscosity;
  return 18 * bed.viscosity * velocity * f(voidage, reynolds) / (bed.diameter * bed.diameter) >
         bed.excess * bed.gravity * voidage;
}

/// The voidage at which the bed is suspended: `packed` if the flow is too slow, 1 if it carries a lone particle away.
template <class Drag>
[[nodiscard]] double carried_voidage(Drag&& f, const CarriedBed& bed, double velocity, double packed) {
  double low = packed, high = 1 - 1e-6;
  if (!(velocity > 0) || !is_carried(f, bed, low, velocity)) return packed;
  if (is_carried(f, bed, high, velocity)) return 1;
  for (int n = 0; n < 50; ++n) {
    const double middle = 0.5 * (low + high);
    (is_carried(f, bed, middle, velocity) ? low : high) = middle;
  }
  return low;
}

/// The superficial slip velocity, m/s, that suspends a bed with a given voidage; 0 without weight.
template <class Drag>
[[nodiscard]] double carrying_velocity(Drag&& f, const CarriedBed& bed, double voidage) {
  if (!(bed.excess * bed.gravity > 0)) return 0;
  double low = 0, high = bed.diameter * bed.diameter * bed.excess * bed.gravity / (18 * bed.viscosity);
  for (int n = 0; n < 100 && !is_carried(f, bed, voidage, high); ++n) high *= 2;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (is_carried(f, bed, voidage, middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// Rising time, s, > 0: the top of a packed bed rises as a plug at u - u_mf after the fluid is switched on, however
/// fast layers below it expand (Slis, Willemse and Kramers, Applied Scientific Research A 8 (1959) 209, for u_1 =
/// u_mf). Beds with several sizes need longer: their species separate afterwards.
/// \param rise  of the top, m  \param velocity, lifting  u > u_mf, superficial, m/s
[[nodiscard]] inline double rising_time(double rise, double velocity, double lifting) {
  return rise / (velocity - lifting);
}

}  // namespace polybed::closures
