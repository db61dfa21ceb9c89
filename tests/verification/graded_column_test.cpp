// Layers of cells that grow with height: rest, the voidage of a bed below and within them, order, mass and restarts.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "core/case/grading.hpp"
#include "scenes/manufactured_box.hpp"
#include "scenes/record.hpp"
#include "scenes/settled_glass.hpp"

namespace polybed::scenes {
namespace {

core::Scene graded(core::Scene scene, double above, double ratio) {
  core::Column& column = scene.column;
  column.layers = core::graded_layers(column.size[1], column.cells[1], above, ratio);
  column.cells[1] = int(column.layers.size());
  return scene;
}

class GradedColumn : public testing::TestWithParam<const char*> {
 protected:
  static core::Scene with_integrator(core::Scene scene) {
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
    return scene;
  }
};

// 0.1 m of glass in water, the upper 40 % in layers that grow by up to 1.15. Bounds as of a bed in even layers
// (hydrostatics_test.cpp).
TEST_P(GradedColumn, ASettledBedThatReachesIntoItRests) {
  const Finished run(with_integrator(graded(settled_glass(), 0.06, 1.15)), 1.0);
  record("greatest velocity", greatest_beside_solids(run.model));
  EXPECT_LT(greatest_beside_solids(run.model), 1e-9);
}

/// 50 mm of settled solids of 1 mm, 2200 kg/m3, in 20 mm/s of water, in cells of 5 mm; expanded to about 0.07 m.
core::Scene liquid_column() {
  core::Scene scene = uniform_bed(1e-3, 2200, 998.207, 1.00157e-3, 0.6, 60, 0.3);
  scene.effects["solids_stress"] = "frictional";
  scene.inlet.superficial_velocity = {{0.0, 0.02}};
  scene.bed.static_height = 0.05;
  scene.bed.start_solids_fraction = 0.5;
  return scene;
}

/// Voidage of the lowest cells of a column.
std::vector<double> lowest(const Finished& run, int count) {
  std::vector<double> voidage;
  for (int j = 0; j < count; ++j)
    voidage.push_back(run.model.fields().fluid.voidage[std::size_t(run.grid().index(0, j))]);
  return voidage;
}

// The bed ends below the graded part: its voidage is the one in even layers. 1e-4 is this project's goal.
TEST_P(GradedColumn, LeavesTheVoidageOfABedBelowIt) {
  const core::Scene even = with_integrator(liquid_column());
  const std::vector<double> expected = lowest(Finished(even, 10.0), 12),
                            found = lowest(Finished(graded(even, 0.1, 1.2), 10.0), 12);
  double most = 0;
  for (std::size_t j = 0; j < found.size(); ++j) most = std::max(most, std::abs(found[j] - expected[j]));
  record("difference in voidage", most);
  EXPECT_LT(most, 1e-4);
}

// Only the lowest 20 mm are even: the voidage follows from drag and weight, whatever the height of a layer.
TEST_P(GradedColumn, HasTheSameVoidageInLayersOfEveryHeight) {
  core::Scene scene = with_integrator(liquid_column());
  scene.bed.static_height = 0.15;
  const std::vector<double> found = lowest(Finished(graded(scene, 0.02, 1.1), 20.0), 12);  // up to 0.097 m
  const auto [least, most] = std::minmax_element(found.begin(), found.end());
  record("difference in voidage", *most - *least);
  EXPECT_LT(*most - *least, 1e-4);
}

// A mixed binary bed between walls that reaches into the graded part and expands through it, with random fractions.
core::Scene expanding() {
  core::Scene scene = binary_bed(6, 60, 0.03, 0.18);
  scene.bed.static_height = 0.06;
  scene.bed.perturbation = 0.05;
  scene.tfm.rtol = 1e-3;
  return graded(scene, 0.04, 1.2);
}

TEST_P(GradedColumn, KeepsTheMass) {
  const core::Scene scene = with_integrator(expanding());
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  const std::vector<double> before = measures::species_volumes(model.constants().grid, model.fields().solids);
  const double area = scene.column.size[0] * scene.column.size[2];
  EXPECT_NEAR(before[0] + before[1], area * scene.bed.static_height * scene.bed.solids_fraction, 1e-15 * area);
  advance(model, 1.0);
  const std::vector<double> after = measures::species_volumes(model.constants().grid, model.fields().solids);
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(after[j], before[j], 1e-12 * before[j]);
}

TEST_P(GradedColumn, ResumedRunGivesTheSameBits) {
  const TwoEnds ends = through_and_resumed(with_integrator(with_particle_forces(expanding())), 0.2, 0.4);
  EXPECT_EQ(ends.through.arrays.at("state"), ends.resumed.arrays.at("state"));
}

INSTANTIATE_TEST_SUITE_P(Integrators, GradedColumn, testing::Values("explicit", "imex", "implicit"));

/// The error of the manufactured solution in layers from 1 to 1.4 times the lowest and back, at most 1 + 1.26/n apart.
Error error_in_layers(int n) {
  core::Scene scene = all_effects(liquid_bed, 2, {n, n, 1});
  std::vector<double>& layers = scene.column.layers;
  for (int j = 0; j < n; ++j) layers.push_back(1.2 - 0.2 * std::cos(2 * std::numbers::pi * (j + 0.5) / n));
  const double sum = std::accumulate(layers.begin(), layers.end(), 0.0);
  for (double& height : layers) height *= liquid_bed.length / sum;
  return Driven(scene, tfm::Scheme::limited, tfm::Scheme::limited).error(liquid_bed.time);
}

// As in even layers (manufactured_test.cpp).
TEST(GradedColumnOrder, IsTwoInSmoothlyGradedLayers) {
  std::vector<Error> e;
  for (const int n : {32, 64, 128}) {
    e.push_back(error_in_layers(n));
    record(fmt::format("fraction, {}", n), e.back().fraction);
    record(fmt::format("velocity, {}", n), e.back().velocity);
  }
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_GT(e[n].fraction / e[n + 1].fraction, 3.2);
    EXPECT_GT(e[n].velocity / e[n + 1].velocity, 3.2);
  }
}

}  // namespace
}  // namespace polybed::scenes
