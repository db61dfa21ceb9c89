// The lines and the members of a card for a box with joined ends in a fluid, which has no bottom and no top.
#pragma once

#include <string>
#include <vector>

#include "core/output/json.hpp"
#include "multiscale/card/balance.hpp"
#include "multiscale/card/bed_of_case.hpp"
#include "multiscale/card/bed_of_run.hpp"

namespace polybed::multiscale {

/// From the case alone. \param share  of each species in the solids
[[nodiscard]] JoinedBox joined_box_of(const core::Scene& scene, const Balance& balance,
                                      const std::vector<double>& share);
/// What is joined, what is in it and what drives it; and the slip that an even suspension would have.
void add_joined_box(const core::Scene& scene, const JoinedBox& box, const std::string& law,
                    std::vector<std::string>& lines);
/// The slips in a run.
void add_slips(const BedOfRun::Joined& run, std::vector<std::string>& lines);

[[nodiscard]] core::Json json_of(const JoinedBox& box);
[[nodiscard]] core::Json json_of(const BedOfRun::Joined& run);

}  // namespace polybed::multiscale
