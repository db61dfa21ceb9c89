// Laminar flow between walls: the viscous stress of the fluid and the wall.
#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// Fluid alone that enters evenly between walls H apart and has become a parabola three widths further: relative L1
/// error of the profile there, U = 1.5 <U> (1 - (2x/H - 1)^2), and of the pressure gradient, 12 mu <U>/H^2.
struct Channel {
  double profile, gradient;
};

Channel channel(int nx, int dimensions) {
  constexpr double width = 0.01, velocity = 0.02;  // Re 2 in a fluid of 1000 kg/m3, 0.1 Pa s
  core::Scene scene = uniform_bed(1e-3, 2000, 1000, 0.1, 0.5, 5 * nx, 5 * width);
  scene.column.size = {width, 5 * width, width};
  scene.column.cells = {nx, 5 * nx, 1};
  scene.column.sides = core::Boundary::wall;
  scene.bed.static_height = 0;
  scene.bed.start_solids_fraction = 0.5;
  if (dimensions == 3) {  // the gap along z, the flow even along x
    scene.column.dimensions = 3;
    scene.column.cells = {3, 5 * nx, nx};
    scene.column.size[0] = 1.0;
  }
  scene.inlet.superficial_velocity = {{0.0, velocity}};
  scene.effects = {{"drag", "stokes"}, {"fluid_stress", "newtonian"}};
  scene.tfm.rtol = 1e-4;
  scene.tfm.pressure_tolerance = 1e-8;
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 2.0);  // four times H^2/nu
  const core::Grid& grid = model.constants().grid;
  const auto& u = model.fields().fluid.velocity[1];
  const auto& p = model.fields().fluid.pressure;
  const auto at = [&](int n, int j) { return std::size_t(dimensions == 3 ? grid.index(1, j, n) : grid.index(n, j)); };
  Channel error{0, 0};
  for (int n = 0; n < nx; ++n) {
    const double x = 2 * (n + 0.5) / nx - 1;
    error.profile += std::abs(u[at(n, 3 * nx)] / velocity - 1.5 * (1 - x * x)) / nx;
  }
  const double gradient = (p[at(nx / 2, 3 * nx - 1)] - p[at(nx / 2, 3 * nx + 1)]) / (2 * grid.spacing[1]);
  error.gradient = std::abs(gradient / (12 * 0.1 * velocity / (width * width)) - 1);
  return error;
}

// Second order: halving the cells divides both errors by four. The mean velocity is that of the inlet, exactly, so the
// discrete parabola differs by h^2.
TEST(Channel, ConvergesToPoiseuillesParabolaInSecondOrder) {
  const Channel coarse = channel(8, 2), fine = channel(16, 2);
  record("profile, 8", coarse.profile);
  record("profile, 16", fine.profile);
  record("gradient, 16", fine.gradient);
  EXPECT_NEAR(std::log2(coarse.profile / fine.profile), 2.0, 0.2);
  EXPECT_NEAR(std::log2(coarse.gradient / fine.gradient), 2.0, 0.2);
  EXPECT_LT(fine.gradient, 0.01);
  // The same gap along the depth of a wide column: the walls a metre apart do not reach its middle.
  EXPECT_NEAR(channel(8, 3).profile, coarse.profile, 1e-4);
}

}  // namespace
}  // namespace polybed::scenes
