// An effect as both models see it: its name in the case file, its laws, what it needs, and the number that decides
// whether it matters. The models add who makes it: dem/effects/maker.hpp, tfm/effects/maker.hpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "closures/vec3.hpp"
#include "core/case/registry.hpp"
#include "core/case/rule.hpp"
#include "core/case/scene.hpp"
#include "relevance/effect_row.hpp"
#include "relevance/situation.hpp"

namespace polybed::relevance {

/// Re_p beyond which lift and spin forces are no more than known by their order, also in sign
/// (docs/reference/effects.md).
inline constexpr double greatest_certain_reynolds = 100;

/// Of particles.
struct Surfaces {
  double roughness, hamaker;  ///< m, J
};
/// What the case says of them, else what is usual: across a gas, or nothing, ten times the pull across a liquid.
[[nodiscard]] Surfaces surfaces_of(const core::Scene& scene, const Survey& survey);

/// What an effect is weighed by.
struct Weighing {
  const core::Scene& scene;
  const Survey& survey;
  const std::vector<EffectRow>& rows;  ///< of the effects weighed so far
};

/// A particle in a run that left the effect out.
struct Encountered {
  double diameter, weight;          ///< m; less the buoyancy, N
  double fluid_density, viscosity;  ///< kg/m3, Pa s
  Surfaces surfaces;
  closures::Vec3 slip, vorticity;      ///< u_f - v, m/s; curl u_f, 1/s
  std::optional<closures::Vec3> spin;  ///< 1/s; of a continuum not known: it differs by half the vorticity

  /// Whether laws of the slip are more than a guess here.
  [[nodiscard]] bool certain() const;
};

/// What other code asks about laws, without knowing their names; told apart by its address.
struct Trait {
  const char* what;
};

/// The laws of an effect, by name, that have a trait.
struct LawsWith {
  const Trait* trait;
  std::vector<std::string> laws;
};

struct Effect {
  std::string role;                  ///< key in [effects]
  std::string help = {};             ///< one line
  std::string absent = {};           ///< what the other model does without it, e.g. "reaches the TFM through a table"
  std::vector<core::Law> laws = {};  ///< the first is the one that is weighed; "none" need not be listed
  std::vector<core::Advice> advice = {};  ///< which law to take, the best first
  std::vector<core::Rule> rules = {};     ///< what it needs, and what it cannot stand beside
  std::string number = {};                ///< what decides, as a formula
  std::string phrase = {};                ///< the same in plain words, with {} for the value: "2 % of" or "30 times"
  /// The row of the table with its number; nothing if a scene has no such row. A function of its arguments alone.
  std::function<std::optional<EffectRow>(const Weighing&, EffectRow)> weigh = {};
  /// Why it cannot act beside what all effects have been weighed to be; empty: it can.
  std::function<std::string(const Weighing&)> idle = {};
  /// Share of the weight, of what a run has met; nothing beyond the range of the law. Without it the monitor
  /// evaluates nothing of this effect.
  std::function<std::optional<double>(const Encountered&)> share = {};
  /// Sets the keys that a law needs where the chooser has chosen it.
  std::function<void(core::Scene&, const Surfaces&)> set_keys = {};
  bool of_acceleration = false;  ///< vanishes in the mean of what is steady
  std::vector<LawsWith> traits = {};

  /// Whether a law has a trait; "table:a.h5" is the law "table:FILE".
  [[nodiscard]] bool law_has(const std::string& law, const Trait& trait) const;
  /// The same of the law that a scene gives this role; false of a role that it leaves out or to the chooser.
  [[nodiscard]] bool has(const core::Scene& scene, const Trait& trait) const {
    return law_has(core::law_of(scene, role), trait);
  }
};

/// An effect with the models that act on it.
struct MenuEntry {
  const Effect* effect;
  std::string models;  ///< "tfm", "dem" or "tfm, dem"
  std::string slot;    ///< place in the discrete equation: Exchange, Stress, Pair ...
};
using Menu = std::vector<MenuEntry>;

/// Adds an effect of a model, or the model to an effect that is there.
void add(Menu& menu, const Effect& effect, const std::string& model, const std::string& slot);

/// What [effects] may name.
[[nodiscard]] std::vector<core::Role> roles_of(const Menu& menu);

/// The rules of its effects. \param models  of those that exactly these models act on, as MenuEntry has them; empty: all
[[nodiscard]] std::vector<core::Rule> rules_of(const Menu& menu, const std::string& models = "");

/// A row that is not yet weighed.
[[nodiscard]] EffectRow row_of(const MenuEntry& entry);

/// Makes a row that of a force on particles: a share of the weight, which counts in the sum of what is left out.
[[nodiscard]] EffectRow as_force(EffectRow row, const core::Scene& scene);

/// The rows of all effects, in the order of the menu, then what is no role.
[[nodiscard]] std::vector<EffectRow> weigh(const core::Scene& scene, const Survey& survey, const Menu& menu);

/// What is no role: weight, pressure gradient, equation of state, coupling, walls, level; and what is not modelled.
[[nodiscard]] std::vector<EffectRow> weigh_conditions(const core::Scene& scene, const Survey& survey);

/// The row of a role; null if there is none.
[[nodiscard]] const EffectRow* find_row(const std::vector<EffectRow>& rows, const std::string& role);

}  // namespace polybed::relevance
