#include <memory>
#include <string>
#include <vector>

#include "dem/effects.hpp"
#include "dem/effects/contact_hertz.hpp"
#include "dem/effects/contact_linear.hpp"
#include "dem/effects/friction.hpp"
#include "dem/effects/friction_partial_slip.hpp"
#include "dem/effects/maker.hpp"
#include "relevance/effect_rules.hpp"
#include "relevance/effects/contact.hpp"

namespace polybed::dem::makers {

namespace {

bool contact_has(const PairMaking& m, const relevance::Trait& trait) {
  return relevance::effects::contact.law_has(m.law, trait);
}

std::unique_ptr<TangentialLaw> make_tangential(const PairMaking& m, int place) {
  const core::Dem& dem = m.scene.dem;
  if (contact_has(m, relevance::effects::frictionless)) return nullptr;
  if (contact_has(m, relevance::effects::linear_springs))
    return std::make_unique<SpringFriction>(m.materials, dem.normal_stiffness.value(), dem.tangential_ratio, place);
  if (dem.tangential == core::Tangential::mindlin) return std::make_unique<MindlinFriction>(m.materials, place);
  if (dem.tangential == core::Tangential::mindlin_deresiewicz)
    return std::make_unique<PartialSlipFriction>(m.materials, place);
  return std::make_unique<SpringFriction>(m.materials, place);
}

void make_contact(const PairMaking& m) {
  const MakeNormal make = [&](const Materials& materials, core::Tail tail) -> std::unique_ptr<NormalLaw> {
    if (!contact_has(m, relevance::effects::linear_springs)) return std::make_unique<HertzContact>(materials, tail);
    return std::make_unique<LinearContact>(materials, m.scene.dem.normal_stiffness.value(), tail);
  };
  m.laws.normal = m.around_normal ? m.around_normal(make) : make(m.materials, m.scene.dem.tail);
  m.laws.tangential = make_tangential(m, m.laws.normal->memory_size());
}

core::Rule linear_has_no_radius(core::Tangential tangential) {
  return {{"dem.tangential", "effects.contact"},
          "dem.tangential = \"" + std::string(core::name_of(tangential)) +
              "\" needs the radius of a contact, which effects.contact = \"linear\" has not: use hertz_mindlin, or "
              "dem.tangential = \"linear\"",
          [tangential](const core::Scene& scene) {
            return core::broken_if(relevance::effects::contact.has(scene, relevance::effects::linear_springs) &&
                                   scene.dem.tangential == tangential);
          }};
}

std::vector<core::Rule> contact_rules() {
  return {relevance::rule_of_law("contact", "linear", {"dem.normal_stiffness"},
                                 "dem.normal_stiffness: effects.contact = \"linear\" needs it, as in \"1000 N/m\"",
                                 [](const core::Scene& scene) { return !scene.dem.normal_stiffness; }),
          linear_has_no_radius(core::Tangential::mindlin),
          linear_has_no_radius(core::Tangential::mindlin_deresiewicz),
          {{"dem.tangential", "effects.contact"},
           "dem.tangential = \"linear\" is a share of dem.normal_stiffness: it goes with effects.contact = "
           "\"linear\"",
           [](const core::Scene& scene) {
             using namespace relevance::effects;
             return core::broken_if(contact.has(scene, elastic_spheres) && !contact.has(scene, frictionless) &&
                                    scene.dem.tangential == core::Tangential::linear);
           }}};
}

}  // namespace

extern const Maker contact;
const Maker contact{&relevance::effects::contact, "Pair", MakePair(make_contact), {}, contact_rules()};

}  // namespace polybed::dem::makers
