// Everything that one evaluation of the right-hand side computes: the working fields of the continuum model.
#pragma once

#include <array>
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

/// What does not change during a run, in the order of the species.
struct Constants {
  core::Grid grid;
  double gravity = 9.81;                 ///< m/s2, along `down`
  std::array<double, 3> down{0, -1, 0};  ///< unit vector on the axes; aslant in a column that leans
  relevance::FluidConstants fluid;
  std::vector<double> diameter;              ///< D_j, m
  std::vector<double> density;               ///< rho_j, kg/m3
  std::vector<closures::ShapeFactor> shape;  ///< on the drag of a lone particle; empty: all are spheres
  std::vector<double> bed_share;             ///< X_j: share of the species in the whole bed
  bool form_b = false;                       ///< the pressure's gradient acts on the fluid alone
  std::vector<std::string> name;
  fluid::Openings openings;  ///< where solids cross the ends of the column

  [[nodiscard]] std::size_t species() const { return diameter.size(); }
};

/// Solids stress on cells; empty where no stress acts.
struct SolidsStress {
  core::Field pressure;  ///< p_s with its bulk-viscous part, Pa
  core::Field slope;     ///< dp_s/dphi, Pa
  /// -dp_s/d(phi div U), Pa s: alpha rho_s c_s h of the bulk-viscous part, and what compression does to p_s by way of a
  /// granular temperature that balances in each cell.
  core::Field damping;
  core::Field contact;  ///< p_f: the part of friction alone, Pa; empty if nothing asks for it
  core::FaceField
      upwind_work;  ///< jump of pressure across a face that takes the work of its flux, Pa; empty along axes without
  core::Field viscosity;            ///< mu_s/phi, Pa s; empty where the solids have no shear viscosity
  std::vector<core::Field> strain;  ///< 2 D':D' of each species, 1/s2; with the viscosity
  core::Field wall;                 ///< friction of walls by collisions over phi, Pa s/m; empty if absent
  [[nodiscard]] bool present() const { return !pressure.empty(); }
  [[nodiscard]] bool viscous() const { return !viscosity.empty(); }
  void make_viscous(const Constants& constants) {
    viscosity = core::make_field(constants.grid);
    strain.assign(constants.species(), core::make_field(constants.grid));
  }
};

/// What the equation of the granular temperature needs, species by species; empty unless theta_j is an unknown.
struct Granular {
  std::vector<core::Field> conductivity;  ///< k_j/phi_j, kg/(m s)
  std::vector<core::Field> decay;         ///< rate at which a disturbance of theta_j in one cell decays, 1/s
};

/// Of forces on single particles; empty where none acts.
struct ParticleForce {
  std::vector<core::Field> on_solids;  ///< f_j: over the particles' volume, N/m3, [species][face] of the axis at hand
  [[nodiscard]] bool present() const { return !on_solids.empty(); }
};

/// What added mass needs, on the faces where solids move; empty where it is absent.
struct Inertia {
  std::vector<core::FaceField> convection;  ///< -(U.grad)U of each species and, last, of the fluid, m/s2
  std::vector<core::FaceField> share;       ///< k_j = C_m rho_f/(rho_j + C_m rho_f): of the fluid's in a solid's motion
  std::vector<core::FaceField> response;    ///< what a unit gradient of the pressure does to U_j, m3/kg
  core::FaceField fluid_response;           ///< and to U_f, m3/kg
  [[nodiscard]] bool present() const { return !share.empty(); }
};

struct Fields {
  fluid::Interphase solids;
  fluid::FluidState fluid;
  core::Field solids_fraction;                ///< phi = sum phi_j
  std::vector<core::Field> share;             ///< x_j as closures see it: [species][cell]
  std::vector<core::Field> slip_superficial;  ///< eps |U_f - U_j| at cell centres, m/s: [species][cell];
                                              ///< times rho_f/rho_0 if the fluid is compressible
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

/// Memory of the fields, bytes; memory_use.cpp.
[[nodiscard]] std::size_t bytes_of(const Fields& fields);

}  // namespace polybed::tfm
