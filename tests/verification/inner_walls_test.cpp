// Walls inside the column, with fluid: drag of a cylinder in a channel, flow in an annulus, beds around a rod.
#include <fmt/format.h>

#include "scenes/round_beds.hpp"

namespace polybed::scenes {
namespace {

core::InnerWall rod(double x, double y, double diameter) { return {{x, y}, {x, y}, core::WallShape::rod, diameter}; }

/// Fluid alone in a box.
core::Scene fluid_alone(double width, double height, int nx, int ny, double density, double viscosity) {
  core::Scene scene = uniform_bed(0.2 * width, 2 * density, density, viscosity, 0.5, ny, height);
  scene.column.size = {width, height, 1};
  scene.column.cells = {nx, ny, 1};
  scene.column.sides = core::Boundary::wall;
  scene.bed.static_height = 0;
  scene.bed.start_solids_fraction = 0.5;
  scene.column.gravity = 0;
  scene.effects = {{"drag", "stokes"}, {"fluid_stress", "newtonian"}};
  scene.tfm.rtol = 1e-3;
  scene.tfm.pressure_tolerance = 1e-6;
  return scene;
}

/// Drag coefficient of a cylinder of 0.1 m at (0.2, 0.2) m in a channel 0.41 m wide, behind a parabola of 0.2 m/s on
/// average, at Re 20: by the balance of momentum of the fluid between two levels. Schaefer and Turek 1996 (Notes on
/// Numerical Fluid Mechanics 52, 547), case 2D-1.
double drag_in_a_channel(int per_diameter) {
  constexpr double width = 0.41, velocity = 0.2, viscosity = 1e-3, diameter = 0.1, length = 1.0;
  const int nx = int(std::lround(4.1 * per_diameter));
  core::Scene scene = fluid_alone(width, length, nx, 10 * per_diameter, 1, viscosity);
  scene.walls = {rod(0.2, 0.2, diameter)};
  scene.scheme.momentum = core::Momentum::conservative_limited;
  scene.inlet.superficial_velocity = {{0.0, 0.0}};
  for (int i = 0; i < nx; ++i) {  // the mean of the parabola over each cell
    const auto below = [](double x) { return 3 * x * x - 2 * x * x * x; };
    const double a = double(i) / nx, b = double(i + 1) / nx, u = velocity * (below(b) - below(a)) * nx;
    scene.jets.push_back({{a * width}, {b * width}, {{0.0, u}}});
  }
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 4);  // steady to 2e-4 from here on
  const core::Grid& grid = model.constants().grid;
  const core::Field &p = model.fields().fluid.pressure, &u = model.fields().fluid.velocity[1];
  const auto at = [&](int i, int j) { return std::size_t(grid.index(i, j)); };
  const auto through = [&](int i, int j) { return 0.5 * (p[at(i, j)] + p[at(i, j - 1)]) + u[at(i, j)] * u[at(i, j)]; };
  const int low = per_diameter / 2, high = 9 * per_diameter;
  double force = 0;
  for (int i = 0; i < nx; ++i) force += (through(i, low) - through(i, high)) * grid.spacing[0];
  for (int j = low; j < high; ++j)
    for (const int i : {0, nx - 1})
      force -= viscosity * (u[at(i, j)] + u[at(i, j + 1)]) / grid.spacing[0] * grid.spacing[1];
  return force * 2 / (velocity * velocity * diameter);
}

// 5.5795 in the literature. With 10, 12, 14, 16, 20 and 24 cells to the diameter -0.4, -1.3, -0.3, -0.5, -0.7 and
// -0.8 %: the wall's place in the cells matters more than their number.
TEST(CylinderInAChannel, HasTheDragOfTheBenchmark) {
  for (const int cells : {10, 14}) {
    const double excess = drag_in_a_channel(cells) / 5.5795 - 1;
    record(fmt::format("excess of drag, {} cells to the diameter", cells), excess);
    EXPECT_LT(std::abs(excess), 0.02);
  }
}

/// A rod across a box of 30 mm by 120 mm, inside the bed.
core::Scene with_rod(const char* integrator) {
  core::Scene scene = binary_bed(12, 48, 0.03, 0.12);
  scene.column.sides = core::Boundary::wall;
  scene.tfm.pressure_tolerance = 1e-10;
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.walls = {rod(0.014, 0.026, 0.012)};
  return scene;
}

class BedAroundARod : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Integrators, BedAroundARod, testing::Values("explicit", "imex", "implicit"));

// A millionth of the velocity at which the fine fall, 23 mm/s, and of the weight of the bed.
TEST_P(BedAroundARod, RestsWhereItHasSettled) {
  core::Scene scene = settled_alone(with_rod(GetParam()));
  scene.effects["fluid_stress"] = "newtonian";
  const Finished run(scene, 0.2);
  record("greatest flux of solids, m/s", greatest_flux(run));
  EXPECT_LT(greatest_flux(run), 2.3e-8);
  const double weight = 0.62 * scene.bed.static_height * (1395 - 999) * 9.81;
  double most = 0;
  core::for_each_row(run.grid(), [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c)
      if (run.grid().metric->volume[c] > 0) most = std::max(most, std::abs(run.model.fields().fluid.pressure[c]));
  });
  record("greatest net pressure, of the weight", most / weight);
  EXPECT_LT(most, 1e-6 * weight);
}

TEST_P(BedAroundARod, LetsAsMuchFluidThroughEveryLevel) {
  for (const auto at : {core::ColumnEnd::bottom, core::ColumnEnd::top}) {
    core::Scene scene = with_rod(GetParam());
    scene.inlet.at = at;
    scene.inlet.superficial_velocity = {{0.0, 0.03}};
    scene.bed.static_height = 0;
    scene.effects["fluid_stress"] = "newtonian";
    const Finished run(scene, 0.2);
    const double worst = uneven_flow(run, 0.03 * 0.03 * run.grid().spacing[2]);
    record("greatest difference from what flows in", worst);
    EXPECT_LT(worst, 1e-8);
  }
}

// Fluidised, the solids are those that were placed: the mass of the column's cross-section up to the static height.
TEST_P(BedAroundARod, KeepsItsMass) {
  core::Scene scene = with_rod(GetParam());
  scene.tfm.rtol = 1e-3;
  const double depth = scene.column.size[2];
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  const std::vector<double> start = measures::species_volumes(model.constants().grid, model.fields().solids);
  const double placed = scene.bed.static_height * scene.bed.solids_fraction * 0.03 * depth;
  EXPECT_NEAR((start[0] + start[1]) / placed, 1, 1e-12);
  advance(model, 0.3);
  const std::vector<double> now = measures::species_volumes(model.constants().grid, model.fields().solids);
  for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(now[j] / start[j], 1, 1e-12);
}

TEST_P(BedAroundARod, GoesOnFromACheckpoint) {
  core::Scene scene = with_rod(GetParam());
  scene.tfm.rtol = 1e-3;
  const TwoEnds ends = through_and_resumed(scene, 0.04, 0.08);
  EXPECT_EQ(ends.through.arrays, ends.resumed.arrays);
}

}  // namespace
}  // namespace polybed::scenes
