// What must not change a result: an empty species, a species cut in two, the order of species, left and right.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// Steps of one length: an adaptive norm changes with the number of fields.
core::Scene short_bed() {
  core::Scene scene = binary_bed(6, 40, 0.018, 0.12);
  scene.tfm.fixed_step = 1e-3;
  scene.tfm.pressure_tolerance = 1e-13;
  return scene;
}

class Invariance : public testing::TestWithParam<std::string> {};

TEST_P(Invariance, AnEmptySpeciesChangesNothing) {
  core::Scene without = short_bed();
  without.scheme.momentum = core::choice_of<core::Momentum>(GetParam());
  core::Scene with = without;
  core::Species none = without.species[0];
  none.name = "none";
  none.diameter = 1.5e-3;
  none.density = 2000;
  with.species.push_back(none);
  with.bed.volume_share.push_back(0.0);
  const Finished a(without, 0.1), b(with, 0.1);
  // Round-off: 100 steps of sums in another order; the pressure solver's tolerance is 1e-13.
  EXPECT_LT(distance(a.grid(), a.phi(0), b.phi(0)), 1e-12);
  EXPECT_LT(distance(a.grid(), a.phi(1), b.phi(1)), 1e-12);
  record("distance", distance(a.grid(), a.phi(1), b.phi(1)));
  EXPECT_EQ(*std::max_element(b.phi(2).begin(), b.phi(2).end()), 0.0);
}

TEST_P(Invariance, ASpeciesCutInTwoMovesAsOne) {
  core::Scene whole = short_bed();
  whole.scheme.momentum = core::choice_of<core::Momentum>(GetParam());
  whole.effects.erase("species_exchange");
  core::Scene cut = whole;
  cut.species.push_back(cut.species[1]);
  cut.species[2].name = "coarse too";
  cut.bed.volume_share = {0.569, 0.2, 0.231};
  const Finished a(whole, 0.1), b(cut, 0.1);
  core::Field sum = b.phi(1);
  for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += b.phi(2)[c];
  // Round-off of other sums, amplified over 100 steps of an unsteady bed.
  EXPECT_LT(distance(a.grid(), a.phi(0), b.phi(0)), 1e-10);
  record("distance", distance(a.grid(), a.phi(1), sum));
  EXPECT_LT(distance(a.grid(), a.phi(1), sum), 1e-10);
}

TEST_P(Invariance, OrderOfSpeciesDoesNotMatter) {
  core::Scene one = short_bed();
  one.scheme.momentum = core::choice_of<core::Momentum>(GetParam());
  core::Scene other = one;
  std::swap(other.species[0], other.species[1]);
  std::swap(other.bed.volume_share[0], other.bed.volume_share[1]);
  const Finished a(one, 0.1), b(other, 0.1);
  const double apart = distance(a.grid(), a.phi(0), b.phi(1));
  record("distance", apart);
  EXPECT_LT(apart, 1e-12);
}

/// Of the first species after 1 s, steps of one length, between the left half of a bed and the right.
double asymmetry(core::Scene scene) {
  scene.tfm.fixed_step = 1e-3;
  scene.tfm.pressure_tolerance = 1e-13;
  const Finished run(scene, 1.0);
  const core::Grid& grid = run.grid();
  double worst = 0;
  for (int j = 0; j < grid.cells[1]; ++j)
    for (int i = 0; i < grid.cells[0]; ++i)
      worst = std::max(worst, std::abs(run.phi(0)[std::size_t(grid.index(i, j))] -
                                       run.phi(0)[std::size_t(grid.index(grid.cells[0] - 1 - i, j))]));
  return worst;
}

TEST_P(Invariance, LeftAndRightAreMirrorImages) {
  core::Scene scene = binary_bed(8, 40, 0.024, 0.12);
  scene.scheme.momentum = core::choice_of<core::Momentum>(GetParam());
  // Ten times cell height over inlet velocity. The operators are symmetric to the bit; the multigrid cycle is
  // not, and leaves its tolerance in every stage.
  const double worst = asymmetry(scene), with_forces = asymmetry(with_particle_forces(scene));
  record("greatest difference", worst);
  record("greatest difference, with lift and added mass", with_forces);
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(with_forces, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Momentum, Invariance,
                         testing::Values(std::string("conservative"), std::string("conservative_limited")));

}  // namespace
}  // namespace polybed::scenes
