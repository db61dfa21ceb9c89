// History force of the fluid on a sphere, from past accelerations g = d(u_f - v)/dt of the slip, which shed vorticity.
//
// F(t) = 3 pi mu d int_0^t K(t - s) g(s) ds for a slip that starts from rest; a slip w_0 at the start would add 3 pi mu
// d K(t) w_0. Basset's kernel is summed with the scheme of van Hinsberg, ten Thije Boonkkamp and Clercx (J. Comput.
// Phys. 230, 2011, 1465): g is linear between times one step apart; the last N steps, including the singular one, are
// integrated exactly; older ones enter ten exponentials, each updated by one multiplication. Second order in the step,
// until the error of the exponentials dominates.
//
// The newest g contains the particle's own dv/dt: its coefficient is returned separately, an inertia for the left side.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "closures/vec3.hpp"

namespace polybed::closures {

/// K = (4 pi nu t/d^2)^-1/2: creeping flow (Basset, Treatise on Hydrodynamics 2, 1888, ch. 22). \param time t > 0, s
[[nodiscard]] inline double history_kernel_basset(double time, double diameter, double kinematic_viscosity) {
  return diameter / std::sqrt(4 * std::numbers::pi * kinematic_viscosity * time);
}

/// K = {[4 pi nu t/d^2]^(1/4) + [pi w^3 t^2/(nu d (0.75 + 0.105 Re_p)^3)]^(1/2)}^-2, Re_p = w d/nu (Mei and Adrian, J.
/// Fluid Mech. 237, 1992, 323, calculations at Re_p 0.1-40; for a slip w that changes little): Basset's at first, t^-2
/// later. It depends on the present w, so sums cannot be updated: it needs the whole past.
/// \param time t > 0, s  \param slip w >= 0, m/s
[[nodiscard]] inline double history_kernel_mei_adrian(double time, double diameter, double kinematic_viscosity,
                                                      double slip) {
  const double nu = kinematic_viscosity, f_h = 0.75 + 0.105 * slip * diameter / nu;
  const double early = std::sqrt(std::sqrt(4 * std::numbers::pi * nu * time) / diameter);
  const double late = time * std::sqrt(std::numbers::pi * slip * slip * slip / (nu * diameter * f_h * f_h * f_h));
  return 1 / ((early + late) * (early + late));
}

/// 1.5 d^2 sqrt(pi rho_f mu), kg/s^(1/2): 3 pi mu d K sqrt(t) with Basset's kernel.
[[nodiscard]] inline double basset_prefactor(double diameter, double fluid_density, double viscosity) {
  return 1.5 * diameter * diameter * std::sqrt(std::numbers::pi * fluid_density * viscosity);
}

/// 1/sqrt(t) as a sum of a_i sqrt(e/t_i) exp(-t/(2 t_i)), t from 1 to 1e5 in units of the window (van Hinsberg et al.
/// 2011). Beyond, it falls below 1/sqrt(t): older slips lose their influence.
struct BassetTail {
  static constexpr std::size_t terms = 10;
  std::array<double, terms> time, share;  ///< t_i, a_i
};

/// Ten terms with the least greatest error, tests/unit/closures/basset_tail_fit.py: 0.126 % to t = 1e5.
inline constexpr BassetTail basset_tail_fitted{
    {0.3037829814794, 1.101875066371, 3.96024745792, 14.22725814, 51.11133376225, 183.6457712224, 660.8677489681,
     2413.573898021, 9978.490263909, 106197.7229658},
    {0.3169747753027, 0.3097961954886, 0.30945597876, 0.3094413274276, 0.3094491427082, 0.3095467371408,
     0.3104942726614, 0.3193666739533, 0.3889005191874, 0.9860850933615}};

/// Weights of 1/sqrt(t) for one step and a window of `Window` steps, s^(1/2). For set-up.
template <std::size_t Window>
struct BassetWeights {
  static_assert(Window > 0);
  /// Weights of the newer and the older end of each step in the window, newest step first.
  std::array<double, Window> newer, older;
  /// For the step that leaves the window, and the factor for the sums in each step (no unit).
  std::array<double, BassetTail::terms> tail_newer, tail_older, kept;
};

/// int_0^1 (1-s) e^(-z s) ds and int_0^1 s e^(-z s) ds, z >= 0: by series below 1, where the closed forms cancel.
struct RampsOfExponential {
  double falling, rising;
};
[[nodiscard]] inline RampsOfExponential ramps_of_exponential(double z) {
  if (z > 1) return {(z - 1 + std::exp(-z)) / (z * z), (1 - std::exp(-z) * (1 + z)) / (z * z)};
  RampsOfExponential sum{0, 0};
  double power = 1;  // (-z)^k/k!
  for (int k = 0; k < 20; ++k) {
    sum.falling += power / ((k + 1) * (k + 2));
    sum.rising += power / (k + 2);
    power *= -z / (k + 1);
  }
  return sum;
}

/// Weights for steps of h: with p = sqrt(n+1), q = sqrt(n), the step from age n h to (n+1) h has the weight (2/3)
/// sqrt(h) (2p + q)/(p+q)^2 at its newer and (2/3) sqrt(h) (p + 2q)/(p+q)^2 at its older end.
/// \param step h, s, > 0
template <std::size_t Window>
[[nodiscard]] BassetWeights<Window> basset_weights(const BassetTail& tail, double step) {
  BassetWeights<Window> w;
  for (std::size_t n = 0; n < Window; ++n) {
    const double p = std::sqrt(double(n + 1)), q = std::sqrt(double(n));
    w.newer[n] = std::sqrt(step) * 2 / 3 * (2 * p + q) / ((p + q) * (p + q));
    w.older[n] = std::sqrt(step) * 2 / 3 * (p + 2 * q) / ((p + q) * (p + q));
  }
  const double window = step * double(Window);
  for (std::size_t i = 0; i < BassetTail::terms; ++i) {
    const double time = tail.time[i] * window, z = step / (2 * time);
    const double entry = step * tail.share[i] * std::sqrt(std::numbers::e / time) * std::exp(-z * double(Window));
    const RampsOfExponential ramps = ramps_of_exponential(z);
    w.tail_newer[i] = entry * ramps.falling;
    w.tail_older[i] = entry * ramps.rising;
    w.kept[i] = std::exp(-z);
  }
  return w;
}

/// A particle's memory between steps, (Window + 10) vectors and a number; empty: no step yet.
template <std::size_t Window>
struct BassetHistory {
  std::array<Vec3, Window> past{};             ///< g one step ago, two steps ago, ..., m/s2
  std::array<Vec3, BassetTail::terms> tail{};  ///< sums over steps older than the window, m/s^(3/2)
  std::size_t known = 0;                       ///< number of valid entries in `past`
};

/// The sum without the newest g, m/s^(3/2): F = B (newest g + past), B the prefactor, newest = weights.newer[0], and 0
/// at the very start. In the equation of motion: add B newest to the mass, and B (newest du_f/dt + past) to the other
/// forces.
template <std::size_t Window>
[[nodiscard]] Vec3 basset_past(const BassetWeights<Window>& weights, const BassetHistory<Window>& history) {
  Vec3 sum{0, 0, 0};
  for (std::size_t n = 1; n <= history.known; ++n) {
    const double before = n < history.known && n < Window ? weights.newer[n] : 0;
    sum = sum + (before + weights.older[n - 1]) * history.past[n - 1];
  }
  for (const Vec3& part : history.tail) sum = sum + part;
  return sum;
}

/// Advances the history by one step. \param acceleration present g, m/s2
template <std::size_t Window>
[[nodiscard]] BassetHistory<Window> basset_step(const BassetWeights<Window>& weights,
                                                const BassetHistory<Window>& history, const Vec3& acceleration) {
  BassetHistory<Window> next = history;
  if (history.known == Window) {  // the oldest step leaves the window
    const Vec3& newer = Window > 1 ? history.past[Window > 1 ? Window - 2 : 0] : acceleration;
    for (std::size_t i = 0; i < BassetTail::terms; ++i)
      next.tail[i] = weights.kept[i] * history.tail[i] + weights.tail_newer[i] * newer +
                     weights.tail_older[i] * history.past[Window - 1];
  }
  for (std::size_t n = Window - 1; n > 0; --n) next.past[n] = history.past[n - 1];
  next.past[0] = acceleration;
  next.known = history.known < Window ? history.known + 1 : Window;
  return next;
}

}  // namespace polybed::closures
