// Slot Stress: what a liquid's drag and films add to the stress of sheared solids, as boxes of particles measured it.
#pragma once

#include <string>
#include <vector>

#include "closures/stress_ratios.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// p = mu_f gamma (1 + lambda St) V(phi) R_p, mu_s = mu_f (1 + lambda St) V(phi) R_mu, closures/stress_ratios.hpp, with
/// St = rho d^2 gamma/mu_f of the cell's Sauter diameter and mean density. It needs no granular temperature. gamma is
/// sqrt(2 D':D' + g^2) - g with g = 0.01 1/s, D' the mean over the solids: 0 at rest, and smooth there. Beyond the
/// table the ratios of its edge are held, which is counted where there are solids.
class WetStress : public CollisionalStress {
 public:
  /// \param jammed  phi_m of V  \param lambda  of the table
  WetStress(const Constants& constants, const fluid::Boundaries& boundaries, closures::StressRatios ratios,
            double jammed, double lambda, const std::string& name, Fields& fields);
  void add(Fields& fields) override;
  [[nodiscard]] std::optional<ClosureUse> use() const override { return use_; }

 private:
  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  closures::StressRatios ratios_;
  double jammed_, lambda_;
  ClosureUse use_;
};

}  // namespace polybed::tfm
