// The negative control of the test of absent effects: a kernel that, in the whole program alone, asks a flag for each
// pair whether an effect is on. It is off; and costs.
#pragma once

namespace polybed::absent {

[[nodiscard]] double control_kernel(int pairs);

}  // namespace polybed::absent
