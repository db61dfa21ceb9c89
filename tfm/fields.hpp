// The working fields of the continuum model: all results of one evaluation of the right-hand side.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "closures/shape_factor.hpp"
#include "core/numerics/field.hpp"
#include "fluid/fluid_state.hpp"
#include "fluid/interphase.hpp"
#include "fluid/momentum.hpp"
#include "fluid/openings.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::tfm {

/// Constants during a run, in the order of the species.
struct Constants {
  core::Grid grid;
  double gravity = 9.81;                 ///< m/s2, along `down`
  std::array<double, 3> down{0, -1, 0};  ///< unit vector on the axes; oblique in a tilted column
  relevance::FluidConstants fluid;
  std::vector<double> diameter;              ///< D_j, m
  std::vector<double> density;               ///< rho_j, kg/m3
  std::vector<closures::ShapeFactor> shape;  ///< on the drag of a lone particle; empty: all are spheres
  std::vector<double> bed_share;             ///< X_j: share of the species in the whole bed
  bool form_b = false;                       ///< the pressure's gradient acts on the fluid alone
  std::optional<double> given_gradient;      ///< mean, of the net pressure between joined ends, Pa/m; else the weight's
  std::vector<std::string> name;
  fluid::Openings openings;  ///< where solids cross the ends of the column

  [[nodiscard]] std::size_t species() const { return diameter.size(); }
};

/// Solids stress on cells; empty without stress.
struct SolidsStress {
  core::Field pressure;  ///< p_s with its bulk-viscous part, Pa
  core::Field slope;     ///< dp_s/dphi, Pa
  /// -dp_s/d(phi div U), Pa s: alpha rho_s c_s h from the bulk-viscous part, plus the effect of compression on p_s
  /// through a granular temperature from a local balance.
  core::Field damping;
  core::Field contact;  ///< p_f: the part of friction alone, Pa; empty if unused
  core::FaceField
      upwind_work;  ///< jump of pressure across a face that takes the work of its flux, Pa; empty along unused axes
  core::Field viscosity;            ///< mu_s/phi, Pa s; empty if the solids have no shear viscosity
  std::vector<core::Field> strain;  ///< 2 D':D' for each species, 1/s2; with the viscosity
  core::Field wall;                 ///< collisional wall friction over phi, Pa s/m; empty if absent
  [[nodiscard]] bool present() const { return !pressure.empty(); }
  [[nodiscard]] bool viscous() const { return !viscosity.empty(); }
  void make_viscous(const Constants& constants) {
    viscosity = core::make_field(constants.grid);
    strain.assign(constants.species(), core::make_field(constants.grid));
  }
};

/// Input to the equation of the granular temperature, species by species; empty unless theta_j is an unknown.
struct Granular {
  std::vector<core::Field> conductivity;  ///< k_j/phi_j, kg/(m s)
  std::vector<core::Field> decay;         ///< decay rate of a disturbance of theta_j in one cell, 1/s
};

/// Forces on individual particles; empty if there are none.
struct ParticleForce {
  std::vector<core::Field> on_solids;  ///< f_j: over the particles' volume, N/m3, [species][face] of the present axis
  [[nodiscard]] bool present() const { return !on_solids.empty(); }
};

/// Added mass on the faces where solids move; empty if it is absent.
struct Inertia {
  std::vector<core::FaceField> convection;  ///< -(U.grad)U for each species and, last, for the fluid, m/s2
  std::vector<core::FaceField> share;       ///< k_j = C_m rho_f/(rho_j + C_m rho_f): share of the fluid's acceleration
  std::vector<core::FaceField> response;    ///< change of U_j per unit gradient of the pressure, m3/kg
  core::FaceField fluid_response;           ///< the same for U_f, m3/kg
  [[nodiscard]] bool present() const { return !share.empty(); }
};

struct Fields {
  fluid::Interphase solids;
  fluid::FluidState fluid;
  core::Field solids_fraction;                ///< phi = sum phi_j
  std::vector<core::Field> share;             ///< x_j as in closures: [species][cell]
  std::vector<core::Field> slip_superficial;  ///< eps |U_f - U_j| at cell centres, m/s: [species][cell];
                                              ///< times rho_f/rho_0 if the fluid is compressible
  std::vector<core::FaceField> solids_flux;   ///< F_j: volume flux of each species, m/s, ghosts owned by other cells
  core::FaceField fluid_acceleration;         ///< a_f, m/s2
  fluid::FluxRate flux_rate;
  SolidsStress stress;
  Granular granular;
  ParticleForce force;
  Inertia inertia;
  /// K_jk / (phi_j phi_k), kg/(m3 s), pairs j < k; empty if absent.
  std::vector<core::Field> species_exchange;

  Fields() = default;
  explicit Fields(const Constants& constants);
};

/// Place of the pair j < k in a list of all pairs of n species.
[[nodiscard]] inline std::size_t pair_index(std::size_t j, std::size_t k, std::size_t n) {
  return j * (2 * n - j - 1) / 2 + (k - j - 1);
}

/// Memory of the fields, bytes.
[[nodiscard]] std::size_t bytes_of(const Fields& fields);

/// Sets the fields to 0 that the solids' equations set only in the rows of Boundaries::with_solids.
void clear_results_of_solids(Fields& fields);

}  // namespace polybed::tfm
