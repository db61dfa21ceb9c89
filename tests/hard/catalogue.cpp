#include "hard/cases.hpp"

namespace polybed::hard {

namespace {

std::vector<HardCase> joined(const std::vector<std::vector<HardCase>>& groups) {
  std::vector<HardCase> all;
  for (const std::vector<HardCase>& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace

std::vector<HardCase> catalogue() {
  std::vector<HardCase> long_ones = joined({column_cases(), leaning_cases(), demanding_cases()});
  for (HardCase& one : long_ones) one.ci = false;
  return joined({settling_cases(), closure_cases(), wave_cases(), fluidised_cases(), inertia_cases(), transport_cases(),
                 round_cases(), long_ones, unit_cases(), particle_cases(), suspension_cases(), one_sphere_cases(),
                 sound_cases(), level_cases(), rank_cases(), input_cases()});
}

}  // namespace polybed::hard
