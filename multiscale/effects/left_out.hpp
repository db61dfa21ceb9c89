// What a run leaves out, told before it and in its record whether or not anything is left to the chooser: each effect
// that its model does without, with the bound that the case alone gives.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/case/scene.hpp"
#include "core/output/json.hpp"
#include "relevance/choice.hpp"

namespace polybed::multiscale {

/// One effect that is left out.
struct LeftOutEffect {
  relevance::EffectRow row;  ///< decided by the case
  std::string why;  ///< off in the case | undecided | no law of it in this model | not modelled | what it needs
  std::optional<double> bound;  ///< by row.number, of a force as a share of the weight; empty: not known
};

struct LeftOut {
  std::string model;    ///< "tfm" or "dem"
  std::string purpose;  ///< "steady" or "transient": whether what goes with acceleration counts
  double promise = 0;   ///< chooser.tolerance
  double sum = 0;       ///< of the bounds of forces, drag, stress and exchange, as a share of the buoyant weight
  double up_to = 0;     ///< the same on the scales that a run may reach
  std::vector<LeftOutEffect> effects;
  /// Of them those that the scene calls for, though this model has laws of them: off by the case, largest share first.
  std::vector<LeftOutEffect> called_for;
  std::string wrong_drag;  ///< why the drag law cannot be right here; empty: nothing is wrong with it
};

/// What a run of a scene leaves out, by the rules of docs/reference/effects.md; nothing is run, it takes some
/// milliseconds.
/// \param scene  with its roles in words  \param model  "tfm" or "dem"
/// Throws core::CaseError if the fluid is not known at a temperature that the chooser is to span.
[[nodiscard]] LeftOut left_out(const core::Scene& scene, const std::string& model);

/// The member "neglected" of an open object.
void write_left_out(core::Json& json, const LeftOut& left_out);

/// What can be done about the effects that the sum consists of, those of any weight, as phrases: what to switch on,
/// what this model has no law of, what is undecided, what a run cannot have. Empty where the sum is within the promise.
[[nodiscard]] std::vector<std::string> remedies(const LeftOut& left_out);

/// A line that names what the scene calls for and the case has off, or a drag law that cannot be right; empty without.
[[nodiscard]] std::string called_for_line(const LeftOut& left_out);

/// A line that says why the drag law that the case names does not suit its bed, and which one does; empty if it suits.
[[nodiscard]] std::string unsuited_line(const core::Scene& scene);

/// A line that names what was chosen where the case left it to the chooser, and counts what was left out; empty where
/// it left nothing.
[[nodiscard]] std::string chosen_line(const core::Scene& scene);

/// The same as write_left_out in at most three lines: forces and their sum against the promise, what has a number of
/// its own, what is not known.
[[nodiscard]] std::vector<std::string> left_out_lines(const LeftOut& left_out);

}  // namespace polybed::multiscale
