// What a scene calls for: the rows of the table decided, and the case with its "auto" roles in words.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "relevance/effect.hpp"
#include "relevance/effect_row.hpp"

namespace polybed::relevance {

/// How rows are decided.
struct DecisionRule {
  double tolerance = 0.02;
  bool transient = false;
  std::set<std::string> on, off;  ///< roles that the case itself decides
};

/// Decides rows that are not yet decided (docs/reference/effects.md):
///   forces of acceleration only in transients; a number that may lie on either side of R is undecided and off;
///   R > tolerance is on; of the remaining forces the largest goes on while their sum exceeds the tolerance.
void decide(std::vector<EffectRow>& rows, const DecisionRule& rule);

/// Sum of what is left out, as a share of the weight: of forces on particles their bounds, of what is undecided the
/// upper end; of drag, stress and exchange the part that is missing. What is called for and not built counts.
[[nodiscard]] double neglected_sum(const std::vector<EffectRow>& rows);

/// The same on the scales that a run may reach, within the ranges of the laws: no less.
[[nodiscard]] double neglected_up_to(const std::vector<EffectRow>& rows);

/// Whether a run of this model does without a row: it is off, cannot be built, or acts on particles by laws that this
/// model does not have. The closures of the other model (stress of the averaged solids, contacts) are no rows of this
/// one.
/// \param model  "tfm" or "dem"
[[nodiscard]] bool is_left_out(const EffectRow& row, const std::string& model);

/// Both sums of what a run of one model leaves out: no less than those of the choice, which may have on what the model
/// has no law of.
/// \param rows  decided  \param model  "tfm" or "dem"
[[nodiscard]] double neglected_sum(const std::vector<EffectRow>& rows, const std::string& model);
[[nodiscard]] double neglected_up_to(const std::vector<EffectRow>& rows, const std::string& model);

struct Choice {
  std::vector<EffectRow> rows;     ///< what is recommended, whatever the case switches off
  std::vector<EffectRow> of_case;  ///< as the case is: decided by its roles, and what it leaves open chosen beside them
  double tolerance = 0;
  double neglected_sum = 0;  ///< of the choice, as a share of the buoyant weight
  double sum_up_to = 0;      ///< of the choice, on the scales that a run may reach
  double case_sum = 0;       ///< of the roles that the case has, or is given
  Surfaces surfaces{};       ///< that cohesion was weighed with
};

/// The choice for a scene: free where the case decides every role itself (what it should have decided), else beside
/// what it switches on. Throws core::CaseError if the fluid is not known at a temperature asked for.
[[nodiscard]] Choice choose(const core::Scene& scene, const Menu& menu);

/// Whether a scene has a role that it leaves to the chooser.
[[nodiscard]] bool has_auto(const core::Scene& scene);

/// The scene with every "auto" role given its law, or left out, and with what that law needs; the same scene if none
/// is "auto". Records the roles in chooser.chosen.
[[nodiscard]] core::Scene with_choice(core::Scene scene, const Menu& menu);

}  // namespace polybed::relevance
