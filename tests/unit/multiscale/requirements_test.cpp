#include "multiscale/requirements.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "scenes/record.hpp"

namespace polybed::multiscale {
namespace {

using testing::HasSubstr;

TEST(NarrowPart, KeepsTheCellsAndTheBedAndNarrowsTheSides) {
  core::Scene scene = scenes::binary_bed(400, 300, 0.8, 0.6);
  scene.jets = {{{0.2}, {0.4}, {{0.0, 0.1}}}};
  scene.layers = {{"", {1, 0}, 0.1, 0.6, {}, {}}, {"", {0, 1}, 0.1, 0.6, {0.4}, {0.8}}};
  const core::Scene part = narrow_part(scene, 12000);
  EXPECT_EQ(part.column.cells[0], 40);
  EXPECT_EQ(part.column.cells[1], 300);
  EXPECT_NEAR(part.column.size[0], 0.08, 1e-15);  // rounding
  EXPECT_EQ(part.bed.static_height, scene.bed.static_height);
  EXPECT_NEAR(part.jets[0].to[0], 0.04, 1e-15);
  EXPECT_NEAR(part.layers[1].from[0], 0.04, 1e-15);
  EXPECT_EQ(part.layers[1].height, 0.1);
  EXPECT_EQ(narrow_part(scene, 200000).column.cells, scene.column.cells) << "what is small stays";
  scene.bed.particles = {1000, 100};
  EXPECT_TRUE(narrow_part(scene, 12000).bed.particles.empty()) << "of all its width; shares and height stand for them";
}

TEST(NarrowPart, IsSmallInThreeDimensionsAndForAbsurdHeights) {
  core::Scene scene = scenes::binary_bed(100, 300, 0.2, 0.6);
  scene.column.dimensions = 3;
  scene.column.cells[2] = 100;
  EXPECT_LE(narrow_part(scene, 12000).column.cells[0] * narrow_part(scene, 12000).column.cells[2], 48);
  core::Scene tower = scenes::binary_bed(10, 1000000, 0.01, 1000);
  tower.layers = {{"", {0.569, 0.431}, tower.bed.static_height, 0.62, {}, {}}};
  const core::Scene part = narrow_part(tower, 12000);
  EXPECT_LE(part.column.cells[0] * part.column.cells[1], 12000);
  EXPECT_NEAR(part.bed.static_height / part.column.size[1], 0.4, 1e-12);  // rounding
  EXPECT_EQ(part.layers[0].height, part.bed.static_height);
}

TEST(Requirements, NeedFewSteps) {
  core::Timers timers;
  std::unique_ptr<tfm::Model> model;
  core::Scene scene = scenes::binary_bed(10, 12, 0.3, 0.36);
  scene.tfm.fixed_step = 1e-5;
  (void)requirements_of(scene, timers, model);
  EXPECT_LE(model->time(), 40.5 * 1e-5) << "a check is short: 40 steps";
}

TEST(Requirements, GrowWithTheCase) {
  core::Timers timers;
  std::unique_ptr<tfm::Model> model;
  core::Scene scene = scenes::binary_bed(100, 120, 0.3, 0.36);
  const Requirements one = requirements_of(scene, timers, model);
  scene.column.cells[0] *= 10;
  scene.column.size[0] *= 10;
  const Requirements ten = requirements_of(scene, timers, model);
  ASSERT_TRUE(one.time && ten.time);
  EXPECT_EQ(ten.cells, 10 * one.cells);
  EXPECT_EQ(ten.unknowns, 10 * one.unknowns - 9 * 3 * 120);    // a side has one more face of three fields
  EXPECT_NEAR(ten.memory.state / one.memory.state, 10, 1e-9);  // rounding
  EXPECT_EQ(ten.time->steps, one.time->steps) << "the cells have the same size";
  EXPECT_GT(ten.time->computing(),
            3 * one.time->computing());  // ten times the cells; timing on a busy machine is rough
}

TEST(Requirements, ARefusalTellsBothNumbers) {
  const core::Scene scene = scenes::binary_bed(8, 40, 0.03, 0.15);
  const MemoryNeed need{.state = 3e9, .fields = 1e9, .solver = 0.5e9, .program = 0.5e9};
  EXPECT_NO_THROW(refuse_beyond_memory(scene, need.total(), {6e9, "the test"}));
  for (const auto& [particles, what] : {std::pair(0, "column.cells = ["), std::pair(12, "12 particles: ")}) try {
      refuse_beyond_memory(scene, need.total(), {4e9, "the test"}, particles);
      FAIL() << "nothing was thrown";
    } catch (const core::CaseError& error) {
      EXPECT_THAT(error.what(), HasSubstr("about 5 GB of memory; the test leaves 4 GB"));
      EXPECT_THAT(error.what(), HasSubstr(what));
    }
}

}  // namespace
}  // namespace polybed::multiscale
