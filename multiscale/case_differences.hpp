// Whether two runs are of one case.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/case/registry.hpp"

namespace polybed::multiscale {

/// A key in which two cases differ, with its value in each; "-" where a case has none.
struct Difference {
  std::string key, first, second;
};

/// The keys in which two resolved cases differ, those left out that may: [tfm], [dem], [output], run.until, the title,
/// and a role of [effects] that acts in one model alone.
[[nodiscard]] std::vector<Difference> case_differences(const std::string& first, const std::string& second,
                                                       std::span<const core::Role> roles);

}  // namespace polybed::multiscale
