// Solids further above the packing than any bed can be end a run, with time, place and what to do.
#include "tfm/packing_limit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using testing::HasSubstr;

std::string said_of(double phi, int species, const std::string& stress = "frictional") {
  core::Scene scene = species == 1 ? uniform_bed(1e-3, 2500, 1000, 1e-3, 0.5, 8, 0.04) : binary_bed(4, 8, 0.02, 0.04);
  scene.effects["solids_stress"] = stress;
  scene.tfm.max_packing = 0.62;
  core::Timers timers;
  const tfm::Model model(scene, timers);
  const tfm::StateLayout layout(model.constants().grid, species, false);
  std::vector<double> y(layout.size(), 0.0);
  y[3] = phi;
  try {
    tfm::require_packing(model.constants(), layout, y, 1.5, model.effects().solids_stress.get());
  } catch (const core::ConservationError& error) {
    return error.what();
  }
  return "";
}

TEST(PackingLimit, NamesTimeCellAndExcess) {
  EXPECT_EQ(said_of(0.6299, 1), "");
  EXPECT_THAT(said_of(0.6401, 1), HasSubstr("t = 1.5 s: solids at phi_solid (0, 3) lie 0.0201 above the packing"));
  EXPECT_THAT(said_of(0.6401, 1), testing::Not(HasSubstr("exchange_pressure")));
}

// pi/sqrt(18) = 0.740480 and 0.01 more. Yu and Standish's packing of the two sizes is above the crystal of one.
TEST(PackingLimit, WithoutAStressIsThatOfACrystal) {
  EXPECT_EQ(said_of(0.7504, 1, "none"), "");
  EXPECT_THAT(said_of(0.7606, 1, "none"), HasSubstr("lie 0.0201 above the packing"));
  EXPECT_THAT(said_of(0.7606, 1, "none"), HasSubstr("effects.solids_stress = \"frictional\""));
}

TEST(PackingLimit, TellsWhatHoldsSpeciesTogether) {
  EXPECT_THAT(said_of(0.6401, 2), HasSubstr("tfm.exchange_pressure"));
}

// A run that passes the limit ends at the state before the step: a cell that starts at 0.6299, onto which solids fall
// at 0.5 m/s.
TEST(PackingLimit, LeavesTheStateBeforeTheStep) {
  core::Scene scene = uniform_bed(1e-3, 2500, 1000, 1e-3, 0.5, 8, 0.04);
  scene.column.closed = true;
  scene.effects["solids_stress"] = "frictional";
  scene.tfm.max_packing = 0.62;
  scene.tfm.fixed_step = 1e-4;
  core::Timers timers;
  tfm::Model model(scene, timers);
  core::Checkpoint start = model.checkpoint();
  for (std::size_t c = 0; c < 8; ++c) start.arrays.at("state")[c] = c == 0 ? 0.6299 : 0.3;
  for (std::size_t face = 1; face < 8; ++face) start.arrays.at("state")[8 + face] = -0.5;  // falls onto the lowest cell
  model.start_from(start);
  EXPECT_THROW(model.step(1), core::NumericsError);
  EXPECT_EQ(model.time(), 0);
  model.keep_last_state();
  const core::Checkpoint left = model.checkpoint();
  for (std::size_t c = 0; c < 8; ++c) EXPECT_NEAR(left.arrays.at("state")[c], start.arrays.at("state")[c], 1e-12) << c;
}

}  // namespace
}  // namespace polybed::scenes
