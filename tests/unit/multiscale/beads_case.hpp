// The text of a case: a bed of beads of one size in water.
#pragma once

#include <string>

namespace polybed::multiscale::test {

/// effects: lines of [effects]; fluid: keys of [fluid] beside the name.
inline std::string beads_case(const std::string& effects, const std::string& fluid = "temperature = \"20 degC\"") {
  return R"(
column = { size = [0.02, 0.1], cells = [4, 20] }
bed = { volume_share = [1], static_height = "40 mm", solids_fraction = 0.6 }
inlet = { superficial_velocity = "10 mm/s" }
run = { until = "1 s" }
fluid = { name = "water", )" +
         fluid + R"( }
[[species]]
name = "beads"
diameter = "1 mm"
density = 2500
[effects]
drag = "cello"
)" + effects;
}

}  // namespace polybed::multiscale::test
