// Balance of drag and buoyant weight in a uniform bed of one size, or of a mixture at its Sauter diameter and mean
// density: 18 mu u f(eps, Re)/D^2 = |rho_s - rho_f| g eps, T(1.49) with the balance of T(1.24). Drag falls with voidage
// and grows with the superficial slip velocity u, so both roots are found by bisection.
#pragma once

namespace polybed::closures {

/// What is carried, by which fluid.
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

/// The voidage at which the bed is carried: `packed` where even that is not, 1 where a lone particle is carried away.
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

/// The superficial slip velocity, m/s, at which a bed of a voidage is carried; 0 without weight.
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

/// s, > 0: the top of a bed that lies packed rises as a plug at u - u_mf after the fluid is switched on, however fast
/// layers below it expand (Slis, Willemse and Kramers, Applied Scientific Research A 8 (1959) 209, for their case
/// u_1 = u_mf). Beds of several sizes need longer: their species part afterwards.
/// \param rise  of the top, m  \param velocity, lifting  u > u_mf, superficial, m/s
[[nodiscard]] inline double rising_time(double rise, double velocity, double lifting) {
  return rise / (velocity - lifting);
}

}  // namespace polybed::closures
