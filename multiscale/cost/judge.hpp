// From runs to errors, ranks and one recommendation: functions of what a sweep has measured.
#pragma once

#include "multiscale/cost/sweep.hpp"

namespace polybed::multiscale {

/// Whether a reference carries a ranking. Two references, of two families, disagree by `disagreement`; errors below ten
/// times that are not ranked. It does if an error is above that floor, or if the floor itself is below the target
/// (cost.md, section 4). \param errors  of the candidates
[[nodiscard]] bool carries(double disagreement, const std::vector<double>& errors, double target);

/// What errors of a quantity are relative to.
[[nodiscard]] double scale_of(const Sweep& sweep, const std::string& quantity);

/// Gives a row its quantities with their distances from the reference.
void measure_errors(const Sweep& sweep, Row& row);

/// Statuses of all rows, and the recommendation.
void rank(Sweep& sweep);

/// How far apart two runs are in the first quantity, relative; empty where one has none.
[[nodiscard]] std::optional<double> distance_of(const Sweep& sweep, const Row& row, const Row& other);

/// Advice in words, a sentence each.
[[nodiscard]] std::vector<std::string> advice(const Sweep& sweep);

/// Settings of a row in words: "rtol 1e-3, grid 9x64".
[[nodiscard]] std::string settings_text(const Sweep& sweep, const Row& row);

}  // namespace polybed::multiscale
