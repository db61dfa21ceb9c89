// The side force on spinning spheres.
#pragma once

#include "closures/magnus_rubinow_keller.hpp"
#include "closures/relevance.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/effects/contact.hpp"
#include "relevance/effects/sheared.hpp"

namespace polybed::relevance::effects {

inline std::optional<EffectRow> weigh_magnus(const Weighing& by, EffectRow row) {
  const auto force = [](const Situation& s, double slip, double spin) {
    return closures::magnus_relevance(s.diameter, s.fluid_density, s.viscosity, slip, spin, s.reference());
  };
  return weigh_sheared(
      as_force(row, by.scene), by.survey,
      [&](const Situation& s, double slip) { return force(s, slip, 0.5 * s.shear); },
      [&](const Situation& s, double slip) {  // contact at speeds up to the slip makes particles spin
        return force(s, slip, 0.5 * s.shear + closures::spin_of_impact(s.slip, s.diameter));
      });
}

/// Uses the contact law in the case, else the one that the chooser would select.
inline std::string magnus_is_idle(const Weighing& by) {
  const std::string given = core::law_of(by.scene, "contact");
  const bool free = given == core::automatic || !by.scene.effects.contains("contact");
  const EffectRow* contact_row = find_row(by.rows, "contact");
  const bool smooth = free ? contact_row != nullptr && contact.law_has(contact_row->model, frictionless)
                           : contact.law_has(given, frictionless);
  return smooth ? "without friction nothing rotates" : "";
}

inline std::optional<double> share_of_magnus(const Encountered& met) {
  if (!met.certain()) return std::nullopt;
  const closures::Vec3 spin =
      met.spin ? closures::spin_relative_to_fluid(*met.spin, met.vorticity) : 0.5 * met.vorticity;
  return share_of(closures::magnus_rubinow_keller(met.slip, spin, met.diameter, met.fluid_density, met.viscosity),
                  met.weight);
}

inline const Effect magnus{
    .role = "magnus",
    .help = "force across the stream on spheres that spin, and the torque that ends the spin",
    .absent = "no law of it in the two-fluid model",
    .laws = {{"rubinow_keller", "of one sphere", "Rubinow and Keller 1961, times 0.45 above Re_p 1"}},
    .rules = joined(
        {{needs_a_fluid("magnus"), idle_in_a_sheared_box("magnus")},
         excludes("magnus", any_law, "contact", "hertz", "a force of rotation, and nothing rotates without friction")}),
    .number = "Magnus force over weight",
    .phrase = "side force on particles that spin: {} the weight",
    .weigh = weigh_magnus,
    .idle = magnus_is_idle,
    .share = share_of_magnus};

}  // namespace polybed::relevance::effects
