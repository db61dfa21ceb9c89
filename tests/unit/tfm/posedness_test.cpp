#include "tfm/posedness.hpp"

#include <gtest/gtest.h>

namespace polybed::tfm {
namespace {

constexpr double slip = 0.1;

/// Solids of 2000 kg/m3 at 0.2 in a fluid of 1000 kg/m3, slip 0.1 m/s, in 2 x 3 cells, the last of them empty.
struct State {
  Constants constants;
  std::optional<Fields> fields;

  explicit State(std::vector<double> densities) {
    constants.grid.cells = {2, 3, 1};
    constants.fluid = {1000, 1e-3};
    constants.density = densities;
    constants.diameter.assign(densities.size(), 1e-3);
    constants.bed_share.assign(densities.size(), 1.0 / double(densities.size()));
    constants.name.assign(densities.size(), "solid");
    fields.emplace(constants);
    fields->stress.pressure = fields->stress.slope = core::make_field(constants.grid);
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 2; ++i)
        if (i + j < 3) set(i, j, 0.2, 10);
  }
  void set(int i, int j, double phi, double slope) {
    const auto c = std::size_t(constants.grid.index(i, j));
    fields->solids_fraction[c] = phi;
    fields->stress.slope[c] = slope;
    for (std::size_t s = 0; s < constants.species(); ++s) {
      fields->solids.fraction[s][c] = phi / double(constants.species());
      fields->slip_superficial[s][c] = (1 - phi) * slip * double(s + 1);
    }
  }
};

// By hand: G_crit = 0.2 2000 1000 0.01/(0.8 2000 + 0.2 1000) = 20/9 Pa.
TEST(Posedness, FindsTheLeastMarginItsPlaceAndTheShareBelow) {
  State state({2000});
  PosednessMargin margin = posedness_margin(state.constants, *state.fields);
  EXPECT_NEAR(margin.least, 10 * 9.0 / 20, 1e-14);
  EXPECT_EQ(margin.share, 0);
  EXPECT_EQ(sentence_of(margin, state.constants.grid).substr(0, 11), "well-posed:");
  state.set(1, 1, 0.2, 10.0 / 9);
  state.set(0, 2, 0.2, 19.9 / 9);
  margin = posedness_margin(state.constants, *state.fields);
  EXPECT_NEAR(margin.least, 0.5, 1e-15);
  EXPECT_EQ(margin.cell, (std::array<int, 3>{1, 1, 0}));
  EXPECT_NEAR(margin.share, 2.0 / 5, 1e-15) << "the empty cell does not count";
  EXPECT_EQ(
      sentence_of(margin, state.constants.grid),
      "ill-posed: least slope of the solids pressure 0.5 of the critical one, in cell (1, 1); below it in 40 % of the "
      "cells with solids");
}

// By hand: density (2000 + 3000)/2, slip (0.1 + 0.2)/2: G_crit = 0.2 2500 1000 0.0225/(0.8 2500 + 0.2 1000) =
// 11250/2200.
TEST(Posedness, TakesSeveralSolidsAsOne) {
  const State state({2000, 3000});
  EXPECT_NEAR(posedness_margin(state.constants, *state.fields).least, 10 * 2200 / 11250.0, 1e-14);
}

TEST(Posedness, OfSolidsWithoutSlipOrWithoutStress) {
  State state({2000});
  for (double& s : state.fields->slip_superficial[0]) s = 0;
  EXPECT_EQ(sentence_of(posedness_margin(state.constants, *state.fields), state.constants.grid),
            "well-posed: nothing slips");
  State bare({2000});
  bare.fields->stress = {};
  EXPECT_EQ(posedness_margin(bare.constants, *bare.fields).least, 0);
  EXPECT_EQ(posedness_margin(bare.constants, *bare.fields).share, 1);
}

}  // namespace
}  // namespace polybed::tfm
