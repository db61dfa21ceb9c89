// Slot Stress: the frictional pressure of packed solids, with a bulk viscosity that damps elastic waves.
#pragma once

#include <algorithm>
#include <array>

#include "closures/max_packing.hpp"
#include "closures/stress_frictional.hpp"
#include "core/numerics/operators.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {

/// p_s = p_f(phi) - lambda sum_j phi_j div U_j, lambda = alpha rho_s c_s h, c_s = sqrt(p_f'/rho_s), rho_s the mean
/// density of the cell's solids, h the smallest cell width. alpha = 0 omits the second term.
///
/// In a partly filled cell S on packed solids K, p_s is at least p_f(phi_K) phi_S/(phi_K + 2 phi_S), at which both of
/// its faces rest: K carries (phi_K/2 + phi_S) and S phi_S/2 of the weight of a full cell. p_f(phi_S) alone is 0 below
/// the onset, and the upper half of S would fall forever.
///
/// Gravity acts on the mean fraction of a face, while an upwind flux carries the fraction of the cell it leaves. If the
/// lower cell is fuller, rising solids gain (phi_K - phi_S)/2 more potential energy than gravity takes, and falling
/// solids release the same amount less than it gives. On packed solids this difference sustained an endless motion. A
/// pressure jump across the face, rho' g h (phi_K - phi_S)/2 U/(|U| + U_0), takes that energy from the motion. It
/// opposes the mean velocity U of the solids and acts as far as K carries half a packed cell and S is looser than the
/// onset. U_0 = g' h/c, c the speed of elastic waves at the bottom, so that it relaxes no faster than these waves.
class FrictionalStress : public StressEffect {
 public:
  /// \param alone  the solids have no other pressure, which would also act at the surface
  FrictionalStress(const core::Scene& scene, const Constants& constants, const fluid::Boundaries& boundaries,
                   Fields& fields, bool alone = true);
  void evaluate(Fields& fields) override;
  [[nodiscard]] double max_packing() const override { return law_.max_packing; }
  [[nodiscard]] double packing_of(std::span<const double> share) const override;
  [[nodiscard]] double packing_above(const Fields& fields) const override;
  [[nodiscard]] double pressure_at(double solids_fraction) const override;
  [[nodiscard]] double pressure_on_top(double solids_fraction, double half_weight) const override;
  [[nodiscard]] double solids_fraction_at(double pressure) const override;

 private:
  void charge_upwind_work(int axis, Fields& fields) const;
  /// Sets the supporting pressure in the loose row on packed solids and in the row above it: the packed row's load
  /// times the row's upper half over all solids from the packed row's middle up. The law alone gives none, and the
  /// upper half, on the face above, falls forever and drags the fluid along. In the second row only dust is supported,
  /// the less the thinner it is: noise in a cell without solids has no stiffness.
  void hold_surface(Fields& fields) const;
  void add_bulk_viscosity(Fields& fields) const;
  template <class Metric>
  void add_bulk_viscosity(const Metric& metric, Fields& fields) const;
  template <class Body>
  void for_each_cell_with_packing(const Fields& fields, const core::Box& box, Body&& body) const;

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  closures::FrictionalLaw law_;               ///< its maximum packing is for the whole bed's composition
  closures::MixturePacking mixture_packing_;  ///< for a cell's composition; null: one for all cells
  std::vector<double> species_packing_;
  double bulk_viscosity_, cell_width_;
  double wave_speed_ = 0;  ///< elastic waves at the bottom of the settled bed, m/s; 0 without support at the surface
  std::array<double, 3> lies_towards_{};  ///< unit vector of the buoyant weight; 0 without support at the surface
};

/// Damping of elastic waves in a packed bed: alpha in the bulk viscosity alpha rho_s c_s h, dimensionless, from the
/// case, or 1 over the number of directions with more than one cell. It acts in all directions at once, so that an
/// explicit step is limited to about h/(2 d alpha c_s) in d of them: with alpha = 1 in two dimensions nothing else
/// limited the steps of a packed bed (docs/record/cost.md).
[[nodiscard]] inline double bulk_viscosity_of(const core::Scene& scene, const core::Grid& grid) {
  int directions = 0;
  for (int axis = 0; axis < grid.dimensions; ++axis) directions += grid.column_cells(axis) > 1 ? 1 : 0;
  return scene.tfm.bulk_viscosity.value_or(1.0 / std::max(directions, 1));
}

}  // namespace polybed::tfm
