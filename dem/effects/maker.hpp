// Makers of the effects in the particle model, and their list. Effects that a scene does not need are not created.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "closures/drag.hpp"
#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "dem/contacts/materials.hpp"
#include "relevance/effect.hpp"

namespace polybed::dem {

class NormalLaw;
class SideForce;
struct PairLaws;

/// Creates a law of the normal force for these materials and this tail ("clip" or "keep").
using MakeNormal = std::function<std::unique_ptr<NormalLaw>(const Materials&, core::Tail)>;

/// Slot Pair: fills its place in `laws`. The laws have consecutive places in a contact's memory.
struct PairMaking {
  const core::Scene& scene;
  const Materials& materials;
  const std::string& law;
  PairLaws& laws;
  std::function<std::unique_ptr<NormalLaw>(const MakeNormal&)>& around_normal;  ///< empty: the plain normal force
  double resolved_gap;                                                          ///< as in make_pair_laws()
};
using MakePair = void (*)(const PairMaking&);

/// The maker of each law of an effect of the slot Pair.
using PairMakers = std::map<std::string, MakePair>;

/// Slot Force.
struct ForceMaking {
  const core::Scene& scene;
  const Materials& materials;
  double density, viscosity;  ///< of the fluid, kg/m3, Pa s
  double dt, interval;        ///< step of the particles and of the fluid, s
  std::size_t place;          ///< index of its memory in a particle's row
  bool other_inertia;         ///< the slot Inertia has a law
};
using MakeForce = std::unique_ptr<SideForce> (*)(const ForceMaking&);

/// Slots Exchange and Inertia: laws in the one loop over particles in a fluid.
struct LoadLaws {
  std::optional<closures::DragLaw> drag;
  double (*added_mass)(double solids_fraction) = nullptr;  ///< its coefficient C_m
};
using MakeLoad = void (*)(const core::Scene& scene, const std::string& law, LoadLaws& laws);

/// An effect of this model. Without a maker another effect includes it.
struct Maker {
  const relevance::Effect* effect;
  std::string slot;
  std::variant<std::monostate, MakePair, MakeForce, MakeLoad> make = {};
  std::vector<core::Rule> rules = {};  ///< requirements on [dem], besides the effect's rules
};

/// All makers, in the order of creation and of listings.
[[nodiscard]] const std::vector<const Maker*>& effects();

/// The valid entries of [effects], and the requirements of listed effects.
[[nodiscard]] std::vector<core::Role> roles();
/// The rules among them for keys of [dem].
[[nodiscard]] std::vector<core::Rule> rules_of_keys(const std::vector<const Maker*>& list = effects());
[[nodiscard]] std::vector<core::Rule> rules(const std::vector<const Maker*>& list = effects());

/// Calls body(its function, law) for the effects in a list that a scene needs and that fill the slot of this type.
template <class Make, class Body>
void for_each_called(const std::vector<const Maker*>& list, const core::Scene& scene, Body&& body) {
  for (const Maker* one : list) {
    const Make* make = std::get_if<Make>(&one->make);
    const std::string law = core::law_of(scene, one->effect->role);
    if (make != nullptr && !core::is_off(law)) body(*make, law);
  }
}

}  // namespace polybed::dem
