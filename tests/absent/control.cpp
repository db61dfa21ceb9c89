#include "absent/control.hpp"

namespace polybed::absent {

double control_kernel(int pairs) {
#ifdef POLYBED_WITH_FLAG
  volatile bool attracts = false;  // as a run would have it: known to no compiler
#endif
  double sum = 0;
  for (int n = 0; n < pairs; ++n) {
    const double gap = 1e-6 * (n + 1);
    sum += gap * gap;
#ifdef POLYBED_WITH_FLAG
    if (attracts) sum -= 1e-19 / (gap * gap);
#endif
  }
  return sum;
}

}  // namespace polybed::absent
