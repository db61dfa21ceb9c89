// The numbers that decide, effect by effect, over the situations of a scene: the rows of the table before a decision.
#pragma once

#include <vector>

#include "core/case/scene.hpp"
#include "multiscale/effects/effect_row.hpp"
#include "multiscale/effects/situation.hpp"

namespace polybed::multiscale {

/// Re_p beyond which lift and spin forces are no more than known by their order, also in sign
/// (docs/reference/effects.md).
inline constexpr double greatest_certain_reynolds = 100;

/// What the numbers rest on beside the situations.
struct Surfaces {
  double roughness, hamaker;  ///< m, J
};
/// What the case says of them, else what is usual: across a gas, or nothing, ten times the pull across a liquid.
[[nodiscard]] Surfaces surfaces_of(const core::Scene& scene, const Survey& survey);

/// Forces on particles: added mass, history, lift, magnus, brownian, gas_slip, lubrication, cohesion.
[[nodiscard]] std::vector<EffectRow> weigh_forces(const core::Scene& scene, const Survey& survey);

/// Drag, and what acts between cells, species and contacts: fluid_stress, solids_stress, granular_temperature,
/// solids_viscosity, species_exchange, contact, rolling.
[[nodiscard]] std::vector<EffectRow> weigh_phases(const core::Scene& scene, const Survey& survey);

/// What is no role: weight, pressure gradient, equation of state, coupling, walls, level; and what is not modelled.
[[nodiscard]] std::vector<EffectRow> weigh_conditions(const core::Scene& scene, const Survey& survey);

}  // namespace polybed::multiscale
