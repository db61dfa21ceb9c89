// The approximate inverse of the implicit system's Jacobian: drag solved in every face, pressure and solids
// fraction coupled through two elliptic equations, continuity in flux form.
//
//   face:  S (dU_1..dU_N, dJ),  dU_f = (dJ - sum phi_j dU_j)/eps,  d_j = b_j/rho_j,  c = the integrator's cj
//          row j: c dU_j + d_j (dU_j - dU_f) + species exchange + diagonal of the solids' viscosity;
//                 c dU_j where the species is held
//          row J: c dJ + sum phi_j b_j (1/rho_f - 1/rho_j)(dU_f - dU_j)
//          R_q = S^-1 (1/rho_j.., B),   R_g = S^-1 (1/(phi rho_j).., sum phi_j/(phi rho_j))
//   cell:  A (dp, q) = (kappa c dp, c q/L) - div( C grad(dp, q) ),  L = p_s' + lambda c
//          (kappa = 0 if the fluid is incompressible); inverted approximately by core::BlockSolver.
//          q = p_s' sum dphi_j - lambda div sum phi_j v_j is the change of p_s: lambda acts on motion, not on
//          r_phi
//   apply: 1. v = S^-1 r on faces
//          2. A (dp, q) = ( r_p - div v_J , (p_s'/L) sum r_phi_j - div sum phi_j v_j )
//          3. v -= R_q grad dp + R_g grad q
//          4. dphi_j = (r_phi_j - div(phi_j v_j))/c, and (r + phi_j v_j)/c for passages through open ends,
//             dtheta_j = r_theta_j/(c + decay), if theta_j is an unknown
//
// Step 4 has unit column sums up to 1/c: mass is kept to round-off however inexact step 2 is.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/numerics/linear_solver.hpp"
#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"
#include "tfm/state_layout.hpp"

namespace polybed::tfm {

class Preconditioner {
 public:
  static constexpr std::size_t most_rows = 16;  ///< unknowns on a face: fifteen species and the flux

  Preconditioner(const Constants& constants, const fluid::Boundaries& boundaries);

  /// Builds S^-1, the responses and the elliptic system from the fields of one evaluation. Returns false on failure.
  [[nodiscard]] bool setup(const Fields& fields, double c);

  /// z = P^-1 r, entries in the order of the layout.
  void apply(const StateLayout& layout, std::span<const double> r, std::span<double> z);

 private:
  enum class Place { inside, outlet, screen };
  template <class Density>
  void build(const Fields& fields, const Density& density, int axis, const core::Box& box, Place place);
  [[nodiscard]] double viscous_diagonal(int axis, core::Index face) const;
  void invert_face(const Fields& fields, double fluid_density, int axis, core::Index face);
  void respond(const Fields& fields, double fluid_density, int axis, core::Index face);
  template <class Rows>
  void couple(const Fields& fields, double fluid_density, int axis, core::Index face, Rows& rows) const;
  void unpack(const StateLayout& layout, std::span<const double> r);
  void solve_faces();
  void elliptic_sources();
  void divergence_of_solids(std::size_t first, std::size_t last, core::Field& out);
  void correct_faces();
  void pack(const StateLayout& layout, std::span<double> z);

  [[nodiscard]] std::size_t inverse_at(core::Index face) const { return std::size_t(face) * rows_ * rows_; }

  const Constants& constants_;
  const fluid::Boundaries& boundaries_;
  std::size_t rows_;         ///< species + 1: unknowns on a face
  std::vector<bool> moves_;  ///< for the species on the present face: false if it is held
  double c_ = 0;
  std::array<std::vector<double>, 3> inverse_;                 ///< S^-1 by face, row major
  std::array<std::vector<core::Field>, 3> response_pressure_;  ///< R_q by axis and row
  std::array<std::vector<core::Field>, 3> response_stress_;    ///< R_g by axis and row
  std::array<std::vector<core::Field>, 3> fraction_;           ///< phi_j on faces
  std::array<core::FaceField, 4> coupling_;                    ///< C11, C12, C21, C22
  core::Field slope_, elastic_;                                ///< L; p_s'/L, 1 where both are 0
  core::Field diagonal_;                                       ///< kappa c; empty if the fluid is incompressible
  std::array<std::vector<core::Field>, 3> face_value_;         ///< residuals, then corrections, by row
  std::vector<core::Field> fraction_residual_;
  std::vector<core::FaceField> passed_residual_;
  std::vector<core::Field> temperature_residual_, temperature_row_;  ///< c + decay of theta_j; or empty
  core::Field pressure_residual_, source_p_, source_s_, dp_, work_;
  core::FaceField flux_;
  core::BlockSolver solver_;
};

}  // namespace polybed::tfm
