// Ways to halve the time of a run, with what is known of the loss.
#pragma once

#include <vector>

#include "multiscale/estimate/estimate.hpp"

namespace polybed::multiscale {

/// Three ways that apply, those that lose least first.
[[nodiscard]] std::vector<Way> tfm_ways(const core::Scene& scene, bool implicit, int ranks, int cores);
[[nodiscard]] std::vector<Way> dem_ways(const core::Scene& scene, const std::string& limited_by, int ranks, int cores);

}  // namespace polybed::multiscale
