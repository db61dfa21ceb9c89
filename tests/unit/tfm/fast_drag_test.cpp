#include "tfm/fast_drag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "scenes/record.hpp"
#include "tfm/model.hpp"
#include "tfm/right_hand_side.hpp"

namespace polybed::tfm {
namespace {

/// Two species in water, coefficients of a bed that is fluidised, and velocities at random.
struct Bed {
  core::Timers timers;
  core::Scene scene = scenes::binary_bed(4, 8, 0.02, 0.04);
  Model model{scene, timers};
  StateLayout layout{model.constants().grid, 2, false};
  FastDrag fast{model.constants(), model.boundaries(), layout};
  std::vector<double> state;

  Bed() {
    model.show(0);
    fast.hold(model.fields());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> velocity(-0.1, 0.1);
    state.resize(layout.size());
    for (double& value : state) value = velocity(random);
  }
};

// x - gamma A x = r with A x from add(): round-off of sums whose terms reach 5 m/s, as gamma times the rates is up to
// 50 times the velocities.
TEST(FastDrag, SolveUndoesAdd) {
  Bed bed;
  for (const double gamma : {1e-4, 1e-2, 1.0}) {
    std::vector<double> solution = bed.state, left;
    bed.fast.solve(gamma, solution);
    left = solution;
    bed.fast.add(-gamma, solution, left);
    double most = 0;
    for (std::size_t n = 0; n < left.size(); ++n) most = std::max(most, std::abs(left[n] - bed.state[n]));
    EXPECT_LT(most, 1e-12) << gamma;
    EXPECT_NE(solution, bed.state);
  }
}

// The total flux feels no force and the fractions do not change: only velocities of solids have rates.
TEST(FastDrag, ChangesNothingButTheSolidsVelocities) {
  Bed bed;
  std::vector<double> rates(bed.layout.size());
  bed.fast.add(1, bed.state, rates);
  for (const StateLayout::Entry& entry : bed.layout.entries()) {
    double most = 0;
    for (std::size_t n = entry.begin; n < entry.begin + entry.size; ++n) most = std::max(most, std::abs(rates[n]));
    if (entry.kind == StateLayout::Entry::Kind::velocity)
      EXPECT_GT(most, 0.1);
    else
      EXPECT_EQ(most, 0);
  }
}

// One face by hand: eps 0.6, fractions 0.3 and 0.1 of 2000 and 1500 kg/m3, b 4e5 and 1e5 kg/(m3 s), water of 1000
// kg/m3, J 0.1 m/s, solids at rest. U_f = 1/6 m/s; G = (0.3 4e5 (-5e-4) + 0.1 1e5 (-1/3e3)) U_f/B = -10.5556/8.16667e-4
// = -12925.17 Pa/m; rates (4e5/6 + 12925.17)/2000 = 39.79592 and (1e5/6 + 12925.17)/1500 = 19.72789 m/s2.
TEST(FastDrag, IsThatOfOneFaceByHand) {
  Constants constants;
  constants.grid.cells = {1, 2, 1};
  constants.diameter = {1e-3, 1e-3};
  constants.density = {2000, 1500};
  constants.bed_share = {0.75, 0.25};
  constants.fluid.density = 1000;
  const fluid::Boundaries boundaries(constants.grid, fluid::Ends::walls);
  const StateLayout layout(constants.grid, 2, false);
  Fields fields(constants);
  std::fill(fields.fluid.voidage.begin(), fields.fluid.voidage.end(), 0.6);
  for (const auto& [j, phi, b] : {std::tuple{0, 0.3, 4e5}, {1, 0.1, 1e5}}) {
    std::fill(fields.solids.fraction[std::size_t(j)].begin(), fields.solids.fraction[std::size_t(j)].end(), phi);
    std::fill(fields.solids.exchange[std::size_t(j)].begin(), fields.solids.exchange[std::size_t(j)].end(), b);
  }
  FastDrag fast(constants, boundaries, layout);
  fast.hold(fields);
  std::vector<double> state(layout.size()), rates(layout.size());
  for (const StateLayout::Entry& entry : layout.entries())
    if (entry.kind == StateLayout::Entry::Kind::flux && entry.axis == 1) state[entry.begin + 1] = 0.1;
  fast.add(1, state, rates);
  for (const StateLayout::Entry& entry : layout.entries())
    if (entry.kind == StateLayout::Entry::Kind::velocity && entry.axis == 1) {
      EXPECT_NEAR(rates[entry.begin + 1], entry.species == 0 ? 39.79592 : 19.72789, 1e-5);
      EXPECT_EQ(rates[entry.begin], 0);      // the floor
      EXPECT_EQ(rates[entry.begin + 2], 0);  // the lid
    }
}

}  // namespace
}  // namespace polybed::tfm
