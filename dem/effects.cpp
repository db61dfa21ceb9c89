#include "dem/effects.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "dem/effects/cohesion.hpp"
#include "dem/effects/contact_hertz.hpp"
#include "dem/effects/contact_linear.hpp"
#include "dem/effects/film.hpp"
#include "dem/effects/friction.hpp"
#include "dem/effects/friction_partial_slip.hpp"
#include "dem/effects/rolling.hpp"
#include "dem/effects/wet_contact.hpp"
#include "fluid/properties.hpp"

namespace polybed::dem {

namespace {

/// What acts through the fluid needs one, and what turns with it has to be able to turn.
void require_fluid(const core::Scene& scene) {
  for (const char* role : {"lift", "magnus", "history", "brownian", "gas_slip", "lubrication"})
    if (const std::string law = core::law_of(scene, role); law != "none" && !scene.fluid.present())
      throw core::CaseError(fmt::format(
          "effects.{} = \"{}\" is what a fluid does, and there is none: name it under [fluid], or leave it out", role,
          law));
  if (const std::string law = core::law_of(scene, "magnus"); law != "none" && core::law_of(scene, "contact") == "hertz")
    throw core::CaseError("effects.magnus = \"" + law +
                          "\" is a force of rotation, and with effects.contact = \"hertz\" nothing rotates: use "
                          "hertz_mindlin or linear, or leave it out");
}

std::unique_ptr<NormalLaw> make_dry(const core::Scene& scene, const Materials& materials, const std::string& contact,
                                    core::Tail tail) {
  if (contact == "none")
    throw core::CaseError("effects.contact: particles need a law of contact: hertz_mindlin, hertz or linear");
  if (contact != "linear") return std::make_unique<HertzContact>(materials, tail);
  return std::make_unique<LinearContact>(materials, scene.dem.normal_stiffness.value(), tail);
}

/// Its memory, if any, is the first in a contact's.
std::unique_ptr<NormalLaw> make_normal(const core::Scene& scene, const Materials& materials,
                                       const std::string& contact) {
  if (core::law_of(scene, "lubrication") != "wet_restitution")
    return make_dry(scene, materials, contact, scene.dem.tail);
  const fluid::FluidConstants fluid = fluid::fluid_constants(scene.fluid);
  const Materials whole = materials.with_restitution(0);  // whose damping ratio is 1, with the tail kept
  return std::make_unique<WetContact>(make_dry(scene, whole, contact, core::Tail::keep), materials,
                                      WetContact::Fluid{fluid.density, fluid.viscosity}, scene.dem.tail, 0);
}

std::unique_ptr<TangentialLaw> make_tangential(const core::Scene& scene, const Materials& materials,
                                               const std::string& contact, int place) {
  const core::Tangential law = scene.dem.tangential;
  if (contact == "hertz") return nullptr;
  if (contact == "linear")
    return std::make_unique<SpringFriction>(materials, scene.dem.normal_stiffness.value(), scene.dem.tangential_ratio,
                                            place);
  if (law == core::Tangential::mindlin) return std::make_unique<MindlinFriction>(materials, place);
  if (law == core::Tangential::mindlin_deresiewicz) return std::make_unique<PartialSlipFriction>(materials, place);
  return std::make_unique<SpringFriction>(materials, place);
}

std::unique_ptr<RollingLaw> make_rolling(const core::Scene& scene, const Materials& materials,
                                         const std::string& contact, int place) {
  const std::string law = core::law_of(scene, "rolling");
  if (law == "none") return nullptr;
  if (contact == "hertz")
    throw core::CaseError("effects.rolling = \"" + law +
                          "\" resists rotation, and with effects.contact = \"hertz\" nothing rotates: use "
                          "hertz_mindlin or linear, or leave it out");
  if (law == "cdt") return std::make_unique<ConstantRolling>(materials, scene.dem.rolling_friction);
  return std::make_unique<SpringRolling>(materials, scene.dem.rolling_friction, scene.dem.rolling_damping, place);
}

std::unique_ptr<CohesionLaw> make_cohesion(const core::Scene& scene, const Materials& materials,
                                           const std::string& contact, int place) {
  const std::string law = core::law_of(scene, "cohesion");
  if (law == "none") return nullptr;
  if (law == "van_der_waals")
    return std::make_unique<VanDerWaalsCohesion>(materials, scene.dem.hamaker_constant, scene.dem.cohesion_gap,
                                                 scene.dem.asperity_radius);
  if (law == "dmt") return std::make_unique<DmtCohesion>(materials, scene.dem.cohesion_energy);
  if (contact == "linear")
    throw core::CaseError(
        "effects.cohesion = \"jkr\" stands in place of Hertz' force, which effects.contact = \"linear\" has not: use "
        "hertz_mindlin, hertz or dmt");
  return std::make_unique<JkrCohesion>(materials, scene.dem.cohesion_energy, place);
}

}  // namespace

PairLaws make_pair_laws(const core::Scene& scene, const Materials& materials) {
  require_fluid(scene);
  core::refuse(effect_faults(scene));
  PairLaws laws;
  const std::string contact = core::law_of(scene, "contact");
  laws.normal = make_normal(scene, materials, contact);
  laws.tangential = make_tangential(scene, materials, contact, laws.normal->memory_size());
  laws.rolling = make_rolling(scene, materials, contact, laws.contact_memory());
  laws.cohesion = make_cohesion(scene, materials, contact, laws.contact_memory());
  if (core::law_of(scene, "lubrication") == "film")
    laws.film = std::make_unique<Film>(materials, fluid::fluid_constants(scene.fluid).viscosity, scene.dem.roughness);
  return laws;
}

std::vector<core::Role> roles() {
  const std::string absent = "DEM only; reaches the TFM through the solids stress";
  return {{"added_mass",
           "dem",
           "Inertia",
           "fluid that a particle drags along when it accelerates",
           "not in this version",
           {{"zuber", "C_m = (1 + 2 phi)/(2 (1 - phi)), Zuber 1964"}, {"half", "C_m = 1/2, of one sphere"}}},
          {"lift",
           "dem",
           "Force",
           "force across a sheared fluid's stream",
           "not in this version",
           {{"saffman_mei", "Saffman 1965 with the share of Mei 1992, of one sphere"}}},
          {"magnus",
           "dem",
           "Force",
           "force across the stream on spheres that spin, and the torque that ends the spin",
           "not in this version",
           {{"rubinow_keller", "Rubinow and Keller 1961, times 0.45 above Re_p 1"}}},
          {"history",
           "dem",
           "Force",
           "vorticity that past accelerations of a particle have left in the fluid",
           "not in this version",
           {{"basset", "Basset 1888, creeping flow, summed by exponentials; adds an inertia"}}},
          {"brownian",
           "dem",
           "Force",
           "heat motion of small particles, with fluid.temperature",
           "not in this version",
           {{"langevin", "random force of variance 2 k_B T k/dt, k the drag over the slip; Langevin 1908"}}},
          {"contact",
           "dem",
           "Pair",
           "forces of touching particles",
           absent,
           {{"hertz_mindlin", "Hertz's normal force and friction by dem.tangential"},
            {"hertz", "Hertz's normal force alone: no friction, no rotation"},
            {"linear", "linear springs, dem.normal_stiffness"}}},
          {"lubrication",
           "dem",
           "Pair",
           "fluid that is squeezed out between particles that meet",
           absent,
           {{"wet_restitution", "restitution times exp(-35/St*) by the speed at first touch, Legendre et al. 2005"},
            {"film", "6 pi mu R*^2 v_n/h from a gap h of 0.1 R* down to dem.roughness"}}},
          {"rolling",
           "dem",
           "Pair",
           "moments that resist rolling, dem.rolling_friction",
           absent,
           {{"cdt", "constant moment mu_r R* F_n against the rolling, for contacts that move (Ai et al. 2011, A)"},
            {"epsd", "spring of rotation capped at it, dem.rolling_damping, for heaps at rest (Ai et al. 2011, C)"}}},
          {"cohesion",
           "dem",
           "Pair",
           "attraction of particles that touch or nearly do",
           absent,
           {{"dmt", "constant pull 2 pi W R* in contact, hard small spheres, dem.cohesion_energy"},
            {"jkr", "Johnson, Kendall and Roberts in place of Hertz, soft large spheres, dem.cohesion_energy"},
            {"van_der_waals", "A R*/(6 z^2) across a gap, dem.hamaker_constant, dem.cohesion_gap"}}}};
}

}  // namespace polybed::dem
