#include "relevance/effects/contact.hpp"
#include "dem/effects.hpp"
#include "dem/effects/contact_hertz.hpp"
#include "dem/effects/contact_linear.hpp"
#include "dem/effects/friction.hpp"
#include "dem/effects/friction_partial_slip.hpp"
#include "dem/effects/maker.hpp"

namespace polybed::dem::makers {

namespace {

std::unique_ptr<TangentialLaw> make_tangential(const PairMaking& m, int place) {
  const core::Dem& dem = m.scene.dem;
  if (m.law == "hertz") return nullptr;
  if (m.law == "linear")
    return std::make_unique<SpringFriction>(m.materials, dem.normal_stiffness.value(), dem.tangential_ratio, place);
  if (dem.tangential == core::Tangential::mindlin) return std::make_unique<MindlinFriction>(m.materials, place);
  if (dem.tangential == core::Tangential::mindlin_deresiewicz)
    return std::make_unique<PartialSlipFriction>(m.materials, place);
  return std::make_unique<SpringFriction>(m.materials, place);
}

void make_contact(const PairMaking& m) {
  const MakeNormal make = [&](const Materials& materials, core::Tail tail) -> std::unique_ptr<NormalLaw> {
    if (m.law != "linear") return std::make_unique<HertzContact>(materials, tail);
    return std::make_unique<LinearContact>(materials, m.scene.dem.normal_stiffness.value(), tail);
  };
  m.laws.normal = m.around_normal ? m.around_normal(make) : make(m.materials, m.scene.dem.tail);
  m.laws.tangential = make_tangential(m, m.laws.normal->memory_size());
}

}  // namespace

extern const Maker contact;
const Maker contact{&relevance::effects::contact, "Pair", MakePair(make_contact)};

}  // namespace polybed::dem::makers
