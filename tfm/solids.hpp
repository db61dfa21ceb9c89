// Continuity and momentum of the solid species, T(1.28) per unit mass of each species.
//
//   (1) dphi_j/dt = -div(phi_j U_j)
//   (2) dU_j/dt   = a_j - grad p / rho_j
//       a_j = -(U_j.grad)U_j + (1 - rho_f/rho_j) g + (b_j/rho_j)(U_f - U_j)
//             - grad p_s / (phi rho_j) + sum_k K_jk (U_k - U_j) / (phi_j rho_j)
//
// Each function adds one term to the acceleration or the rate; nothing is divided by phi_j.
#pragma once

#include "fluid/boundaries.hpp"
#include "tfm/fields.hpp"
#include "tfm/first_order_fallback.hpp"

namespace polybed::tfm {

/// Least solids fraction as a divisor of the gradient of the solids pressure.
constexpr double stress_fraction_floor = 1e-3;

/// Interpolation of a quantity to faces, or its difference.
enum class Scheme { upwind, limited };

/// (1): fraction_rate = -div F_j with F_j = U_j times upwind phi_j, with half a limited slope if `limited`, and with
/// the flow through the ends at time t. Fills ghosts of the rate. For a compressible fluid also sets its own flux,
/// J - sum F_j.
/// \param first_order  faces with plain upwind phi_j whatever the scheme; null: none
void continuity(const Constants&, const fluid::Boundaries&, Scheme, double t, Fields&, const FaceList* first_order);

/// For a compressible fluid: sets its own flux, J - sum F_j, only on the faces of the ends and of sides with flow, to
/// the values from continuity(). Reads J, U_j and phi_j on the owned faces and cells.
void fluid_flux_through_ends(const Constants&, const fluid::Boundaries&, double t, Fields&);

/// Adds the buoyant weight, (1 - rho_f/rho_j) g, along every axis with a component of gravity.
void add_gravity(const Constants&, const fluid::Boundaries&, Fields&);

/// Adds the drag of the fluid, (b_j/rho_j)(U_f - U_j).
void add_exchange(const Constants&, const fluid::Boundaries&, Fields&);

/// Subtracts grad p_s / (phi rho_j): the solids pressure shared by volume.
void subtract_stress(const Constants&, const fluid::Boundaries&, Fields&);

/// Adds the momentum exchange between species; exact opposites for the two in a pair.
void add_species_exchange(const Constants&, const fluid::Boundaries&, Fields&);

}  // namespace polybed::tfm
