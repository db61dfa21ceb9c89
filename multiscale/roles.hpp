// What a case file may name that the models know: all roles of [effects], and distributions of sizes.
#pragma once

#include <vector>

#include "core/case/registry.hpp"
#include "core/case/size_classes.hpp"

namespace polybed::multiscale {

/// The roles of the continuum model, then those that act between particles alone.
[[nodiscard]] std::vector<core::Role> all_roles();

/// How a distribution of sizes becomes classes: by its moments, closures/size_classes.hpp.
[[nodiscard]] std::vector<std::pair<double, double>> size_classes(const core::SizeDistribution& distribution);

}  // namespace polybed::multiscale
