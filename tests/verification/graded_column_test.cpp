// Layers of cells that grow with height, and cells that grow from the side walls: rest, the voidage of a bed, order,
// mass, mirror images and restarts.
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

core::Scene graded_across(core::Scene scene, double ratio) {
  core::Column& column = scene.column;
  column.sides = core::Boundary::wall;
  for (const std::size_t axis : {0, 2})
    if (column.cells[axis] > 1)
      column.across[axis / 2] = core::graded_widths(column.size[axis], column.cells[axis], ratio);
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

/// After a second of a scene, whose bed fills the volume that it should.
void expect_masses_kept(const core::Scene& scene) {
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

TEST_P(GradedColumn, KeepsTheMass) { expect_masses_kept(with_integrator(expanding())); }

TEST_P(GradedColumn, ResumedRunGivesTheSameBits) {
  const TwoEnds ends = through_and_resumed(with_integrator(with_particle_forces(expanding())), 0.2, 0.4);
  EXPECT_EQ(ends.through.arrays.at("state"), ends.resumed.arrays.at("state"));
}

/// The same bed of solids in eight cells across, also in depth.
core::Scene wide_liquid_column(int dimensions) {
  core::Scene scene = liquid_column();
  scene.column.dimensions = dimensions;
  scene.column.cells = {8, 60, dimensions == 3 ? 8 : 1};
  scene.column.size = {0.04, 0.3, 0.04};
  scene.column.sides = core::Boundary::wall;
  return scene;
}

// Even solids under walls that do not rub stay even, whatever the width of a cell.
TEST_P(GradedColumn, LeavesTheVoidageOfAnEvenBedBetweenCellsOfAllWidths) {
  for (const int dimensions : {2, 3}) {
    const core::Scene even = with_integrator(wide_liquid_column(dimensions));
    const double until = dimensions == 2 ? 10 : 1;
    const Finished expected(even, until), found(graded_across(even, 1.2), until);
    const double most = distance(found.grid(), found.phi(0), expected.phi(0));
    record(fmt::format("difference in solids fraction, {} dimensions", dimensions), most);
    EXPECT_LT(most, 1e-4);
  }
}

/// As expanding(), in cells that also grow from the walls, in both directions.
core::Scene expanding_across() {
  core::Scene scene = graded_across(expanding(), 1.15);
  scene.effects["fluid_stress"] = "newtonian";
  return scene;
}

TEST_P(GradedColumn, KeepsTheMassInCellsOfAllWidths) { expect_masses_kept(with_integrator(expanding_across())); }

TEST_P(GradedColumn, ResumedRunInCellsOfAllWidthsGivesTheSameBits) {
  const TwoEnds ends = through_and_resumed(with_integrator(with_particle_forces(expanding_across())), 0.2, 0.4);
  EXPECT_EQ(ends.through.arrays.at("state"), ends.resumed.arrays.at("state"));
}

// As in even cells (invariance_test.cpp), where the implicit steps leave more of their tolerance.
TEST(GradedColumnMirror, LeftAndRightAreMirrorImages) {
  core::Scene scene = graded_across(binary_bed(8, 40, 0.024, 0.12), 1.2);
  scene.jets.clear();
  scene.effects["fluid_stress"] = "newtonian";
  scene.tfm.fixed_step = 1e-3;
  scene.tfm.pressure_tolerance = 1e-13;
  const Finished run(scene, 0.5);
  double worst = 0, uneven = 0;
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 4; ++i) {
      const double here = run.phi(0)[std::size_t(run.grid().index(i, j))];
      worst = std::max(worst, std::abs(here - run.phi(0)[std::size_t(run.grid().index(7 - i, j))]));
      uneven = std::max(uneven, std::abs(here - run.phi(0)[std::size_t(run.grid().index(3, j))]));
    }
  record("greatest difference", worst);
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(uneven, 1e-3);  // walls rub
}

INSTANTIATE_TEST_SUITE_P(Integrators, GradedColumn, testing::Values("explicit", "imex", "implicit"));

/// The error of the manufactured solution in layers from 1 to 1.4 times the lowest and back, at most 1 + 1.26/n apart.
/// \param across  in cells of such widths
Error error_in_layers(int n, bool across) {
  core::Scene scene = all_effects(liquid_bed, 2, {n, n, 1});
  std::vector<double>& layers = across ? scene.column.across[0] : scene.column.layers;
  for (int j = 0; j < n; ++j) layers.push_back(1.2 - 0.2 * std::cos(2 * std::numbers::pi * (j + 0.5) / n));
  const double sum = std::accumulate(layers.begin(), layers.end(), 0.0);
  for (double& height : layers) height *= liquid_bed.length / sum;
  return Driven(scene, tfm::Scheme::limited, tfm::Scheme::limited).error(liquid_bed.time);
}

// As in even layers (manufactured_test.cpp).
void expect_order_of_two(bool across) {
  std::vector<Error> e;
  for (const int n : {32, 64, 128}) {
    e.push_back(error_in_layers(n, across));
    record(fmt::format("fraction, {}", n), e.back().fraction);
    record(fmt::format("velocity, {}", n), e.back().velocity);
  }
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_GT(e[n].fraction / e[n + 1].fraction, 3.2);
    EXPECT_GT(e[n].velocity / e[n + 1].velocity, 3.2);
  }
}
TEST(GradedColumnOrder, IsTwoInSmoothlyGradedLayers) { expect_order_of_two(false); }
TEST(GradedColumnOrder, IsTwoInSmoothlyGradedCellsAcross) { expect_order_of_two(true); }

}  // namespace
}  // namespace polybed::scenes
