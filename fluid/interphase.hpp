// The only interface between the averaged fluid and the solids, whatever they are: filled by a model of the solids,
// read by the equations of the fluid.
#pragma once

#include <vector>

#include "core/numerics/field.hpp"

namespace polybed::fluid {

struct Interphase {
  std::vector<double> density;                ///< rho_j, kg/m3
  std::vector<core::Field> fraction;          ///< phi_j, [species][cell]
  std::vector<core::FaceField> velocity;      ///< U_j, m/s, [species][axis][face]
  std::vector<core::Field> fraction_rate;     ///< d phi_j / dt, 1/s, [species][cell]
  std::vector<core::FaceField> acceleration;  ///< a_j: dU_j/dt without the net pressure gradient, m/s2
  std::vector<core::Field> temperature;       ///< theta_j, m2/s2, of fluctuations; empty if no closure needs it
  std::vector<core::Field> temperature_rate;  ///< d theta_j / dt, m2/s3; empty unless theta_j is an unknown
  std::vector<core::FaceField> passed;        ///< volume through ends and sides, m, [species][axis][face]; or empty
  std::vector<core::FaceField> passed_rate;   ///< d passed / dt, m/s
  std::vector<core::Field> exchange;          ///< b_j = beta_j / phi_j, kg/(m3 s), finite where phi_j = 0
  bool carry_pressure = true;                 ///< -phi_j grad p acts on them (form A), or on the fluid alone (form B)

  Interphase() = default;
  Interphase(const core::Grid& grid, std::vector<double> species_density)
      : density(std::move(species_density)),
        fraction(density.size(), core::make_field(grid)),
        velocity(density.size(), core::make_face_field(grid)),
        fraction_rate(density.size(), core::make_field(grid)),
        acceleration(density.size(), core::make_face_field(grid)),
        exchange(density.size(), core::make_field(grid)) {}

  [[nodiscard]] std::size_t species() const { return density.size(); }
  /// Change of U_j per unit gradient of the pressure, m3/kg.
  [[nodiscard]] double response(std::size_t j) const { return carry_pressure ? 1 / density[j] : 0; }
};

}  // namespace polybed::fluid
