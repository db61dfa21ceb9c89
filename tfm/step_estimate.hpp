// Time scales of a case before its run: for a uniform bed, without cells and without a state.
#pragma once

#include <string>
#include <vector>

#include "closures/drag.hpp"
#include "core/case/scene.hpp"
#include "tfm/effects.hpp"
#include "tfm/step_limits.hpp"

namespace polybed::tfm {

/// Mean density of the solids of the whole bed, kg/m3.
[[nodiscard]] double mean_density(const Constants& constants);

/// Terminal velocity, m/s >= 0, of a lone particle of a species with Schiller and Naumann's drag, and the greatest over
/// all species.
[[nodiscard]] double terminal_velocity(const Constants& constants, std::size_t species);
[[nodiscard]] double greatest_terminal_velocity(const Constants& constants);

/// A uniform bed at rest.
struct UniformBed {
  double solids_fraction;  ///< phi, with the composition of the whole bed
  double velocity;         ///< superficial, for the fluid, m/s, >= 0
};

/// The solids fraction at which the drag carries a bed of its Sauter diameter and mean density:
/// 18 mu U f(eps, Re)/D^2 = (rho_s - rho_f) g eps, T(1.49) with the balance of T(1.24); `packed` where even that is not
/// carried, 0 where a lone particle is carried away or nothing pulls it down. By bisection, since drag falls with
/// voidage.
[[nodiscard]] double expanded_fraction(const Constants& constants, const closures::DragLaw& law, double velocity,
                                       double packed);

/// The scales of time_scales(), for a uniform bed: convection with the fluid's velocity between the particles and the
/// terminal velocity of the fastest species; drag of every species, relaxing with the fluid; elastic waves of the
/// solids and their bulk viscosity with the slope of the solids pressure at phi; the fluid's viscosity. Effects that
/// are off have none. For a bed that starts packed they match its initial fields to a thousandth; later the flow within
/// the bed decides.
/// \param split  as in time_scales()
[[nodiscard]] std::vector<TimeScale> time_scales_of_bed(const core::Scene& scene, const Constants& constants,
                                                        const Effects& effects, const UniformBed& bed,
                                                        bool split = false);

/// The expected step of the explicit integrator: a share of the shortest scale, s. Measured, docs/record/cost.md.
[[nodiscard]] double explicit_step(const std::vector<TimeScale>& scales);

/// The expected step of the implicit integrator at a tolerance: its error test follows the slower of convection, h/U,
/// and free fall through a cell, sqrt(h/g'), g' = g |1 - rho_f/rho_s|; in a fluid at rest the fall of a lone particle,
/// h/u_t, if that is slower. The error of a second-order step scales with its third power. Measured,
/// docs/record/cost.md.
/// \param velocity  of the fluid between the particles, m/s
[[nodiscard]] double implicit_step(const Constants& constants, double velocity, double rtol);

/// The expected step with implicit drag alone: limited by the error test, as in implicit_step() but of third order, or
/// by the remaining scales. Measured, docs/record/cost.md.
/// \param scales  for the bed with a split
[[nodiscard]] double split_step(const Constants& constants, const std::vector<TimeScale>& scales, double velocity,
                                double rtol);

/// Expected number of steps with implicit drag alone per fully implicit step, in the bed as a velocity expands it, or
/// packed if the velocity is too low: it selects the integrator for a liquid bed.
/// \param velocity  superficial, for the fluid, m/s, >= 0
[[nodiscard]] double split_steps_per_implicit(const core::Scene& scene, const Constants& constants,
                                              const Effects& effects, double velocity);

}  // namespace polybed::tfm
