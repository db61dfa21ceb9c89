// What a prediction says of a part of a run, by hand; and measuring a machine that is faster than the beds are long.
#include "multiscale/estimate/estimate.hpp"

#include <gtest/gtest.h>

namespace polybed::multiscale {
namespace {

// 10 s (4 to 22) of which 2 s (1 to 4) are before the first step: the steps take 8 s (3 to 18).
TEST(TimeBand, OfAPartOfARun) {
  const TimeBand whole{4, 10, 22, 2};
  const TimeBand begun = whole.part(0.25, true), resumed = whole.part(0.75, false), all = whole.part(1, true);
  EXPECT_EQ(begun.expected, 4);
  EXPECT_EQ(begun.least, 1.75);
  EXPECT_EQ(begun.most, 8.5);
  EXPECT_EQ(resumed.expected, 6);
  EXPECT_EQ(resumed.least, 2.25);
  EXPECT_EQ(resumed.most, 13.5);
  EXPECT_EQ(begun.expected + resumed.expected, all.expected);
  EXPECT_EQ(all.expected, 10);
}

// A tenth of a second takes the two-fluid model some 20 steps of milliseconds, so its beds end before 0.4 s of CPU.
TEST(Machine, IsMeasuredByBedsThatEndBefore) {
  const Machine machine = measure_machine(2, 0.1);
  EXPECT_GT(machine.explicit_step, 0);
  EXPECT_GT(machine.implicit_step, 0);
  EXPECT_GT(machine.particles.particle_step, 0);
  EXPECT_GT(machine.particles.particle_step_in_fluid, 0);
  EXPECT_GT(machine.particles.cell, 0);
}

}  // namespace
}  // namespace polybed::multiscale
