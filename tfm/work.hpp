// What a run of the continuum model has done so far.
#pragma once

#include <cstdint>

namespace polybed::tfm {

/// Repeats exactly from run to run.
struct Work {
  std::uint64_t steps = 0, rejected_steps = 0, right_hand_sides = 0, pressure_solves = 0, pressure_iterations = 0,
                newton_iterations = 0, krylov_iterations = 0, first_order_cells = 0;
};

}  // namespace polybed::tfm
