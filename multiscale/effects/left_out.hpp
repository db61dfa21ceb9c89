// Effects neglected in a run, reported before it and in its record, whether or not the chooser decides anything: each
// effect that its model lacks, with the bound from the case alone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "multiscale/effects/neglected.hpp"
#include "relevance/choice.hpp"

namespace polybed::multiscale {

/// One neglected effect.
struct LeftOutEffect {
  relevance::EffectRow row;  ///< decided by the case
  std::string why;  ///< off in the case | undecided | no law of it in this model | not modelled | missing requirement
  std::optional<double> bound;  ///< for row.number; for a force as a share of the weight; empty: unknown
};

struct LeftOut {
  std::string model;    ///< "tfm" or "dem"
  std::string purpose;  ///< "steady" or "transient": whether acceleration effects count
  double promise = 0;   ///< chooser.tolerance
  double sum = 0;       ///< of the bounds for forces, drag, stress and exchange, as a share of the buoyant weight
  double least = 0;     ///< the same from the lower ends of uncertain bounds
  double up_to = 0;     ///< the same on the scales that a run can reach
  std::vector<LeftOutEffect> effects;
  /// Those of them that the scene needs and this model has laws for: off by the case, largest share first.
  std::vector<LeftOutEffect> called_for;
  std::string wrong_drag;  ///< why the drag law must be wrong here; empty: it need not be
};

/// The effects neglected in a run of a scene, by the rules of docs/reference/effects.md; runs nothing and takes some
/// milliseconds.
/// \param scene  with resolved roles  \param model  "tfm" or "dem"
/// Throws core::CaseError if the fluid is unknown at a temperature in the chooser's range.
[[nodiscard]] LeftOut left_out(const core::Scene& scene, const std::string& model);

/// A bound as a share of the weight: above the weight itself its number says nothing more.
[[nodiscard]] std::string share_of_weight(double bound);

/// The member "neglected" of an open object.
void write_left_out(core::Json& json, const LeftOut& left_out);

/// Remedies for the effects in the sum, if they are significant, as phrases: those to turn on, those without a law in
/// this model, undecided ones, and those that a run cannot include. Empty if the sum is within the tolerance.
[[nodiscard]] std::vector<std::string> remedies(const LeftOut& left_out);

/// The roles that remedies() calls undecided.
[[nodiscard]] std::vector<std::string> to_try(const LeftOut& left_out);

/// The sum, and whether it matters by the case and by what a run met, in one line without the heading of a card.
[[nodiscard]] std::string left_out_text(const LeftOut& left_out, const std::optional<ForcesMet>& met = {});

/// A line with the effects that the scene needs and the case has off, or a drag law that must be wrong; empty without.
[[nodiscard]] std::string called_for_line(const LeftOut& left_out);

/// A line that says why the drag law in the case does not suit its bed, and which one does; empty if it suits.
[[nodiscard]] std::string unsuited_line(const core::Scene& scene);

/// A line with the effects chosen by the chooser and the number neglected; empty if it decided nothing.
[[nodiscard]] std::string chosen_line(const core::Scene& scene);

/// The content of write_left_out in at most three lines: forces and their sum against the tolerance, effects with other
/// numbers, unknown ones.
[[nodiscard]] std::vector<std::string> left_out_lines(const LeftOut& left_out);

}  // namespace polybed::multiscale
