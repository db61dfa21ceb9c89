// Stress regime of sheared particles in a scene: dry, dominated by collisions, or wet, by drag and films.
#pragma once

#include <string>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::tfm {

/// The deciding numbers of one species at the voidage where it is suspended.
struct RegimeNumbers {
  std::string species;
  double velocity = 0, voidage = 0;          ///< m/s; from the force balance of the species alone
  double shear_rate = 0;                     ///< 1/s
  double stokes_least = 0, stokes_most = 0;  ///< for impacts at 0.2 and 1 of the slip
  double stokes_of_shear = 0;                ///< rho d^2 gamma/mu
  double shear_times_relaxation = 0;         ///< gamma tau_p
};

struct Regime {
  core::BoxRegime kind = core::BoxRegime::automatic;  ///< dry | wet; automatic: nothing moves the bed
  std::string reason;                                 ///< in one line, with the deciding numbers
  std::vector<RegimeNumbers> numbers;
};

/// gamma = max(10 w/L, w/(10 d)), w = U/eps, tau_p from the scene's drag law; St* = (rho_p + rho_f/2) d v/(9 mu).
/// \param velocity  superficial, m/s, above 0  \param voidage  0: where drag balances the weight at the velocity
[[nodiscard]] RegimeNumbers regime_numbers(const core::Scene& scene, std::size_t species, double velocity,
                                           double voidage);

/// calibrate.regime if it is dry or wet; else dry without a fluid, or with gamma tau_p of at least 1 for a species at
/// the greatest velocity of the inlet, and wet below. Throws core::CaseError without a drag law.
[[nodiscard]] Regime shear_regime(const core::Scene& scene);

}  // namespace polybed::tfm
