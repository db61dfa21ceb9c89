// Kynch's settling suspension: solids flux, shocks and a fan, and a sediment that packs.
//
// 60 um, 2500 kg/m3 in water at 20 degC, closed column of 80 mm, 100 cells. With q = u_t phi (1 - phi)^n,
// u_t = 2.79282 mm/s, n = 4.65: the characteristics give the speeds below, computed apart from the code. They hold for
// a sediment at 0.62; the frictional stress from 0.615 on packs it to 0.616, which moves no front by half a cell.
#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

constexpr int cells = 100;
constexpr double height = 0.08, cell = height / cells;

core::Scene suspension(double solids_fraction) {
  core::Scene scene = uniform_bed(60e-6, 2500, 998.207, 1.00157e-3, solids_fraction, cells, height);
  scene.column.closed = true;
  scene.effects = {{"drag", "richardson_zaki"}, {"solids_stress", "frictional"}};
  scene.bed.solids_fraction = 0.62;
  scene.bed.static_height = height * solids_fraction / 0.62;
  scene.tfm.integrator =
      core::TfmIntegrator::implicit_steps;  // drag relaxes in 0.5 ms: explicit steps would be as short
  scene.tfm.rtol = 1e-3;
  scene.tfm.frictional_onset = 0.615;
  scene.tfm.max_packing = 0.63;
  return scene;
}

/// phi of layer j.
double fraction_of_layer(const tfm::Model& model, int j) {
  return model.fields().solids_fraction[std::size_t(model.constants().grid.index(0, j))];
}

/// Height, m, at which phi passes a level between layers j - 1 and j; linear between their centres.
double crossing(const tfm::Model& model, int j, double level) {
  const double below = fraction_of_layer(model, j - 1), above = fraction_of_layer(model, j);
  return (j - 0.5 + (below - level) / (below - above)) * cell;
}

/// Height, m, at which phi falls through a level, seen from above.
double front(const tfm::Model& model, double level) {
  for (int j = cells - 1; j > 0; --j)
    if (fraction_of_layer(model, j) < level && fraction_of_layer(model, j - 1) >= level)
      return crossing(model, j, level);
  return 0;
}

/// Height, m, at which phi first rises to a level, seen from below.
double rise(const tfm::Model& model, double level) {
  for (int j = 1; j < cells; ++j)
    if (fraction_of_layer(model, j - 1) < level && fraction_of_layer(model, j) >= level)
      return crossing(model, j, level);
  return 0;
}

/// Speed of a level in the fan at 1.2 mm/s, m/s: U - q'(phi), q' = u_t (1 - phi)^(n - 1) (1 - (n + 1) phi).
double fan_speed(double phi) { return 1.2e-3 - 2.79282e-3 * std::pow(1 - phi, 3.65) * (1 - 5.65 * phi); }

/// The same particles fluidised to a fraction, a bed of a given height, at a velocity that jumps to another one at 1 s.
core::Scene stepped_bed(double solids_fraction, double bed_height, double before, double after) {
  core::Scene scene = suspension(solids_fraction);
  scene.column.closed = false;
  scene.bed.static_height = bed_height * solids_fraction / 0.62;
  scene.inlet.superficial_velocity = {{0.0, before}, {1.0, before}, {1.0, after}};
  scene.tfm.rtol = 3e-4;  // at 1e-3 the steps alone move the width of the fan by 0.05 mm
  return scene;
}

/// 20 s beyond the jump.
void advance_through_the_jump(tfm::Model& model) {
  advance(model, 1.0);
  model.restart();  // as the run does where the inlet jumps
  advance(model, 21.0);
}

TEST(Sedimentation, ADiluteSuspensionSettlesWithTwoShocks) {
  core::Timers timers;
  tfm::Model model(suspension(0.12), timers);
  advance(model, 24.0);
  const double top = front(model, 0.06), bed = front(model, 0.37);
  record("top, mm", top * 1e3);
  record("bed, mm", bed * 1e3);
  EXPECT_NEAR(top, height - 1.5413e-3 * 24, cell);
  EXPECT_NEAR(bed, 0.36991e-3 * 24, cell);
  EXPECT_NEAR(measures::species_volumes(model.constants().grid, model.fields().solids)[0], 0.12 * height * cell * cell,
              1e-12 * height * cell * cell);
}

// Between 8 and 24 s: the top falls at 0.60623, the upper shock, from 0.28 to 0.39564, rises at 0.54899 mm/s; above the
// sediment lies a fan. Speeds, because a shock between two mild levels forms a cell away from where it is born.
TEST(Sedimentation, ADenseSuspensionSettlesWithAFan) {
  core::Timers timers;
  tfm::Model model(suspension(0.28), timers);
  advance(model, 8.0);
  const double top = front(model, 0.14), shock = front(model, 0.33782);
  advance(model, 24.0);
  const double falls = (top - front(model, 0.14)) / 16, rises = (front(model, 0.33782) - shock) / 16;
  record("top falls, mm/s", falls * 1e3);
  record("shock rises, mm/s", rises * 1e3);
  EXPECT_NEAR(falls, 0.60623e-3, cell / 16);
  EXPECT_NEAR(rises, 0.54899e-3, cell / 16);
}

// The same particles fluidised: a bed of 60 mm at 1.2 mm/s, phi 0.16612. When the velocity jumps to 0.6 mm/s the top
// falls by the difference and a shock to 0.28160 rises at 0.86309 mm/s from the distributor.
TEST(Sedimentation, ABedAnswersAStepOfTheVelocityWithAShock) {
  core::Timers timers;
  tfm::Model model(stepped_bed(0.16612, 0.060, 1.2e-3, 0.6e-3), timers);
  advance_through_the_jump(model);
  const double top = front(model, 0.08306), shock = front(model, 0.22386);
  record("top, mm", top * 1e3);
  record("shock, mm", shock * 1e3);
  EXPECT_NEAR(top, 0.060 - 0.6e-3 * 20, cell);
  EXPECT_NEAR(shock, 0.86309e-3 * 20, cell);
  EXPECT_NEAR(model.fields().solids_fraction[std::size_t(model.constants().grid.index(0, 8))], 0.28160, 1e-3);
}

// And back: 35.394 mm at 0.6 mm/s, phi 0.28160, stepped to 1.2 mm/s. The top rises by the difference; from the
// distributor a fan spreads, each phi at U - q'(phi), from 1.1116 mm/s for 0.16612 to 1.6936 mm/s for 0.28160. Half
// way, 0.22386: 1.49326 mm/s by hand. Its corners are rounded over some cells, so that its width is taken between
// levels inside.
TEST(Sedimentation, ABedAnswersAStepBackWithAFan) {
  core::Timers timers;
  tfm::Model model(stepped_bed(0.28160, 0.035394, 0.6e-3, 1.2e-3), timers);
  advance_through_the_jump(model);
  const double top = front(model, 0.14080), middle = rise(model, 0.22386);
  const double ends = rise(model, 0.25) - rise(model, 0.20);
  record("top, mm", top * 1e3);
  record("fan at 0.22386, mm", middle * 1e3);
  record("fan from 0.20 to 0.25, mm", ends * 1e3);
  EXPECT_NEAR(top, 0.035394 + 0.6e-3 * 20, cell);
  EXPECT_NEAR(middle, 1.49326e-3 * 20, cell);
  EXPECT_NEAR(ends, (fan_speed(0.25) - fan_speed(0.20)) * 20, cell);  // a shock would have no width
}

}  // namespace
}  // namespace polybed::scenes
