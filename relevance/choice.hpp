// Chooses the effects for a scene: decides the rows of the table, and replaces "auto" roles in the case by laws.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_row.hpp"

namespace polybed::relevance {

/// Input for deciding rows.
struct DecisionRule {
  double tolerance = 0.02;
  bool transient = false;
  std::set<std::string> on, off;  ///< roles that the case itself decides
};

/// Decides undecided rows (docs/reference/effects.md):
/// acceleration forces act only in transients; a number whose band includes R is undecided and off;
/// R > tolerance is on; of the remaining forces the largest is turned on while their sum exceeds the tolerance.
void decide(std::vector<EffectRow>& rows, const DecisionRule& rule);

/// Sum of the neglected effects as a share of the weight: bounds for forces on particles, the upper end for undecided
/// ones, and the missing part for drag, stress and exchange. Needed but unavailable effects count.
[[nodiscard]] double neglected_sum(const std::vector<EffectRow>& rows);

/// The same on the scales that a run can reach, within the ranges of the laws; never less.
[[nodiscard]] double neglected_up_to(const std::vector<EffectRow>& rows);

/// Whether a run with this model neglects a row: it is off, unavailable, or acts on particles with laws that this model
/// lacks. Closures of the other model (stress of the averaged solids, contacts) are not rows of this one.
/// \param model  "tfm" or "dem"
[[nodiscard]] bool is_left_out(const EffectRow& row, const std::string& model);

/// Both sums of the effects that a run with one model neglects. They are not below the sums of the choice, which can
/// turn on effects that the model has no law for.
/// \param rows  decided  \param model  "tfm" or "dem"
[[nodiscard]] double neglected_sum(const std::vector<EffectRow>& rows, const std::string& model);
[[nodiscard]] double neglected_up_to(const std::vector<EffectRow>& rows, const std::string& model);

/// The certain part of neglected_sum(): the lower end of each band.
[[nodiscard]] double neglected_certainly(const std::vector<EffectRow>& rows, const std::string& model);

struct Choice {
  std::vector<EffectRow> rows;     ///< the recommendation, whatever the case turns off
  std::vector<EffectRow> of_case;  ///< the case: decided by its roles, with its open roles chosen accordingly
  double tolerance = 0;
  double neglected_sum = 0;  ///< of the choice, as a share of the buoyant weight
  double sum_up_to = 0;      ///< of the choice, on the scales that a run can reach
  double case_sum = 0;       ///< of the roles in the case, given or chosen
  Surfaces surfaces{};       ///< used in the evaluation of cohesion
};

/// The choice for a scene: free if the case decides every role itself (to show what it lacks), else in addition to the
/// effects that it turns on. Throws core::CaseError if the fluid is unknown at a required temperature.
[[nodiscard]] Choice choose(const core::Scene& scene, const Menu& menu);

/// Whether a scene leaves a role to the chooser.
[[nodiscard]] bool has_auto(const core::Scene& scene);

/// The scene with every "auto" role replaced by its law or left out, and with the keys that the law needs; the same
/// scene if no role is "auto". Records the roles in chooser.chosen.
[[nodiscard]] core::Scene with_choice(core::Scene scene, const Menu& menu);

}  // namespace polybed::relevance
