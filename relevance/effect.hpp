// An effect as both models use it: its name in the case file, its laws, its requirements, and the number that decides
// whether it matters. The models add its makers: dem/effects/maker.hpp, tfm/effects/maker.hpp.
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

/// Re_p above which lift and spin forces are known only by order of magnitude, and not even in sign
/// (docs/reference/effects.md).
inline constexpr double greatest_certain_reynolds = 100;

/// Surface properties of particles.
struct Surfaces {
  double roughness, hamaker;  ///< m, J
};
/// From the case, else usual values: across a gas, or without a fluid, ten times the attraction across a liquid.
[[nodiscard]] Surfaces surfaces_of(const core::Scene& scene, const Survey& survey);

/// Input for weighing an effect.
struct Weighing {
  const core::Scene& scene;
  const Survey& survey;
  const std::vector<EffectRow>& rows;  ///< for the effects weighed so far
};

/// A particle in a run that neglects the effect.
struct Encountered {
  double diameter, weight;          ///< m; less the buoyancy, N
  double fluid_density, viscosity;  ///< kg/m3, Pa s
  Surfaces surfaces;
  closures::Vec3 slip, vorticity;      ///< u_f - v, m/s; curl u_f, 1/s
  std::optional<closures::Vec3> spin;  ///< 1/s; unknown for a continuum: it differs by half the vorticity

  /// Whether laws of the slip are more than an estimate here.
  [[nodiscard]] bool certain() const;
};

/// A property of laws that other code can query without their names; identified by its address.
struct Trait {
  const char* what;
};

/// The laws of an effect that have a trait, by name.
struct LawsWith {
  const Trait* trait;
  std::vector<std::string> laws;
};

struct Effect {
  std::string role;                  ///< key in [effects]
  std::string help = {};             ///< one line
  std::string absent = {};           ///< effect on the other model without it, e.g. "reaches the TFM through a table"
  std::vector<core::Law> laws = {};  ///< the first one is weighed; "none" need not be listed
  std::vector<core::Advice> advice = {};  ///< recommended laws, the best first
  std::vector<core::Rule> rules = {};     ///< requirements and exclusions
  std::string number = {};                ///< the deciding number, as a formula
  std::string phrase = {};                ///< the same in plain words, with {} for the value: "2 % of" or "30 times"
  /// The row of the table with its number; nothing if it does not apply to a scene. Depends on the arguments alone.
  std::function<std::optional<EffectRow>(const Weighing&, EffectRow)> weigh = {};
  /// Why it cannot act together with the effects already weighed; empty: it can.
  std::function<std::string(const Weighing&)> idle = {};
  /// Share of the weight for a particle in a run; nothing outside the range of the law. Without this function the
  /// monitor skips the effect.
  std::function<std::optional<double>(const Encountered&)> share = {};
  /// Sets the keys that a law needs when the chooser selects it.
  std::function<void(core::Scene&, const Surfaces&)> set_keys = {};
  bool of_acceleration = false;  ///< vanishes in the mean of a steady flow
  std::vector<LawsWith> traits = {};

  /// Whether a law has a trait; "table:a.h5" is the law "table:FILE".
  [[nodiscard]] bool law_has(const std::string& law, const Trait& trait) const;
  /// The same for the law that a scene gives this role; false if it leaves the role out or to the chooser.
  [[nodiscard]] bool has(const core::Scene& scene, const Trait& trait) const {
    return law_has(core::law_of(scene, role), trait);
  }
};

/// An effect with the models in which it acts.
struct MenuEntry {
  const Effect* effect;
  std::string models;  ///< "tfm", "dem" or "tfm, dem"
  std::string slot;    ///< place in the discrete equation: Exchange, Stress, Pair ...
};
using Menu = std::vector<MenuEntry>;

/// Adds an effect of a model, or adds the model to an existing effect.
void add(Menu& menu, const Effect& effect, const std::string& model, const std::string& slot);

/// The valid entries of [effects].
[[nodiscard]] std::vector<core::Role> roles_of(const Menu& menu);

/// Rules of its effects. \param models  select those that exactly these models act on, as in MenuEntry; empty: all
[[nodiscard]] std::vector<core::Rule> rules_of(const Menu& menu, const std::string& models = "");

/// A row before weighing.
[[nodiscard]] EffectRow row_of(const MenuEntry& entry);

/// Makes a row a force on particles: its value is a share of the weight and counts in the sum of neglected effects.
[[nodiscard]] EffectRow as_force(EffectRow row, const core::Scene& scene);

/// The rows of all effects, in the order of the menu, then the conditions.
[[nodiscard]] std::vector<EffectRow> weigh(const core::Scene& scene, const Survey& survey, const Menu& menu);

/// Rows without a role: weight, pressure gradient, equation of state, coupling, walls, level, and unmodelled effects.
[[nodiscard]] std::vector<EffectRow> weigh_conditions(const core::Scene& scene, const Survey& survey);

/// The row of a role; null if there is none.
[[nodiscard]] const EffectRow* find_row(const std::vector<EffectRow>& rows, const std::string& role);

}  // namespace polybed::relevance
