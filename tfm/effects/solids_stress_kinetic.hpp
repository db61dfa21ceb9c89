// Slot Stress: what collisions add to the stress of the solids, by kinetic theory with one granular temperature per
// species, from a local balance or, as slot Scalar, from an equation of its own.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "closures/kinetic_theory.hpp"
#include "closures/stress_ratios.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// p = sum_j phi_j rho_j theta_j (1 + sum_k h_jk), mu_s = sum_j x_j mu_j with mu_j that of species j alone at the
/// solids fraction of all and g0_j = sum_k x_k g_jk: neutral to cutting a species in two. Per volume of species j, in
/// W/m3:
///   (3/2) rho_j (dtheta_j/dt + U_j.grad theta_j) = mu_j/phi 2 D':D' - p_j/phi_j div U - Gamma_j/phi_j
///     - 3 b_j theta_j + slip production + div(k_j grad theta_j)/(phi_j + 1e-4 X_j).
/// D' and U are those of all solids, by volume: the stress acts on all. Algebraic: the left side and the last term are
/// left out. Below a solids fraction of 0.01 p, mu_j and k_j, here and there, fade to 0 together.
class KineticStress : public CollisionalStress {
 public:
  KineticStress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                bool transported, double max_packing, Fields& fields);
  void add(Fields& fields) override;
  /// Of a stress that was measured: pressure, viscosity and dissipation times these ratios, which are to Garzo and
  /// Dufty with the g0 of Carnahan and Starling. \param name  of the table, for the count of what lies outside it
  void multiply(closures::StressRatios ratios, const std::string& name);
  [[nodiscard]] std::optional<ClosureUse> use() const override { return use_; }

 private:
  struct NoRatios {};
  static constexpr std::size_t most_species = 15;  ///< as the case file allows
  /// One species in one cell, per volume of the species; s = sqrt theta.
  struct Local {
    double g0, collisions;                        ///< sum_k x_k g_jk; sum_k h_jk
    double viscosity;                             ///< mu_j/(phi s), kg/m2
    double compression, shear, loss, drag, slip;  ///< of theta, s, s^3, theta, 1/s in the balance above, W/m3
  };
  void radial_distributions(const Fields& fields, std::size_t cell, double phi, std::span<Local> local) const;
  struct Motion {
    double divergence, strain;  ///< 1/s, 1/s2
  };
  [[nodiscard]] Motion motion_in(const Fields& fields, core::Index cell) const;
  void balance_terms(const Fields& fields, std::size_t cell, double phi, std::size_t species, const Motion& motion,
                     Local& local) const;
  template <class Ratios>
  void add_with(Fields& fields, const Ratios& ratios);
  template <class Ratios>
  void add_cell(Fields& fields, core::Index cell, const closures::RadialValue& radial, const Ratios& ratios) const;
  void find_rate(Fields& fields, std::size_t cell, double phi, std::size_t species, const Local& local) const;
  void add_wall_energy(Fields& fields) const;

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  closures::KineticModel model_;
  bool dense_, transported_;
  std::vector<double> restitution_;
  std::optional<closures::StressRatios> ratios_;  ///< absent: kinetic theory alone
  std::optional<ClosureUse> use_;
  double specularity_, wall_restitution_, max_packing_, least_shear_rate_, conduction_diagonal_ = 0;
};

}  // namespace polybed::tfm
