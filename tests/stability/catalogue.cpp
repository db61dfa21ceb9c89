#include "stability/cases.hpp"

namespace polybed::stability {

namespace {

std::vector<HardCase> joined(const std::vector<std::vector<HardCase>>& groups) {
  std::vector<HardCase> all;
  for (const std::vector<HardCase>& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace

std::vector<HardCase> short_cases() {
  return joined({settling_cases(), closure_cases(), fluidised_cases(), transport_cases(), column_cases()});
}

std::vector<HardCase> long_cases() { return demanding_cases(); }

}  // namespace polybed::stability
