// Slot Stress: collisional stress of the solids from kinetic theory, with one granular temperature per species, from a
// local balance or, as slot Scalar, from its own equation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "closures/kinetic_theory.hpp"
#include "closures/stress_ratios.hpp"
#include "tfm/effects.hpp"
#include "tfm/effects/kinetic_rows.hpp"

namespace polybed::tfm {

/// p = sum_j phi_j rho_j theta_j (1 + sum_k h_jk), mu_s = sum_j x_j mu_j with mu_j for species j alone at the solids
/// fraction of all and g0_j = sum_k x_k g_jk: unchanged if a species is split in two. Per volume of species j, in W/m3:
///   (3/2) rho_j (dtheta_j/dt + U_j.grad theta_j) = mu_j/phi 2 D':D' - p_j/phi_j div U - Gamma_j/phi_j
///     - 3 b_j theta_j + slip production + div(k_j grad theta_j)/(phi_j + 1e-4 X_j).
/// D' and U are for all solids, by volume: the stress acts on all. Algebraic: the left side and the last term are
/// omitted. Below a solids fraction of 0.01 p, mu_j and k_j, here and there, fade to 0 together.
class KineticStress : public CollisionalStress {
 public:
  KineticStress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                bool transported, double max_packing, Fields& fields);
  void add(Fields& fields) override;
  /// For a measured stress: pressure, viscosity and dissipation times these ratios to Garzo and Dufty with the g0 of
  /// Carnahan and Starling. \param restitution  of each species, in that reference
  /// \param name  of the table, for the count of points outside it
  void multiply(closures::StressRatios ratios, const std::vector<double>& restitution, const std::string& name);
  [[nodiscard]] std::optional<ClosureUse> use() const override { return use_; }

 private:
  /// Adds the row of cells from `begin` on; the species are those in the cells.
  void add_row(Fields& fields, core::Index begin);
  void set_motion(const Fields& fields, core::Index begin);
  void flow_on_faces(const Fields& fields, std::size_t axis, core::Index begin, std::size_t faces, double* flow) const;
  void set_ratios();
  void collide(const Fields& fields, std::size_t species, core::Index begin);
  void add_species(Fields& fields, std::size_t species, core::Index begin);
  void add_wall_energy(Fields& fields);
  [[nodiscard]] double wall_gain(const Fields& fields, int wall, std::size_t species, core::Index cell) const;

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  closures::KineticModel model_;
  bool dense_, transported_;
  std::vector<Grain> grains_;
  std::optional<closures::StressRatios> ratios_;  ///< absent: kinetic theory alone
  std::optional<ClosureUse> use_;
  double specularity_, max_packing_, least_shear_rate_, conduction_diagonal_ = 0;
  KineticRows rows_;
};

}  // namespace polybed::tfm
