// What the calibration in Python asks of the program: which boxes a case has, what they measure, and how a table reads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/studies.hpp"
#include "core/numerics/ranks.hpp"

namespace polybed::app {

/// Answers questions until there are no more: each is a line with a JSON array of texts, each answer a line of JSON.
///   case PATH SETTING...      reads the case: the plan, {"regime", "axes", "seeds", ...}; the first question
///   take DIRECTORY            takes the directory as long as this runs; null
///   boxes POINT...            of each its hash and the seconds that it is expected to take on one core, [[hash, s],
///   ...] run FILE POINT ...        runs boxes on the ranks, in this order: null each time the first rank has finished
///   one of
///                             its own, and at the end the places of those that failed, [0, 3]
///   table PATH                how a table of sheared boxes runs, {"falls", "falls_in_shear_up_to", "a"}
///   bed PATH                  null for a table of fluidised boxes
///   ratios PATH POINT...      of each [p, p one standard error up, mu, mu likewise] that a run reads from a table
/// A point is "regime phi stokes restitution friction share binary pushed seed". Collective; the first rank reads and
/// writes. Throws what the question meets.
/// \param questions, answers  descriptors  \param ranks  null: one process
void answer_calibration(int questions, int answers, std::shared_ptr<const core::Ranks> ranks);

/// Runs one box and writes its file. Collective for a fluidised one.
void run_box_into(const std::string& file, const std::string& case_path, const std::vector<std::string>& overrides,
                  const std::string& point);

}  // namespace polybed::app
