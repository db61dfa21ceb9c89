// Shear flows of packed solids that decay by their viscosity: exact solutions between walls of every kind.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using Kind = tfm::StateLayout::Entry::Kind;
constexpr double pi = std::numbers::pi;
constexpr double side = 0.01, solids = 0.6, density = 2500, viscosity = 10;
/// mu_s/(phi rho), with the 1e-4 that the equation adds to the fraction of the only species.
constexpr double kinematic = viscosity / ((solids + 1e-4) * density);

/// Solids at 0.6 in a fluid of 1 kg/m3 without drag and weight, in a closed box. Their frictional pressure is
/// 0.05 0.1^2/0.04^5 = 4883 Pa and the viscosity, at rates far below 1/s, that of its cap.
core::Scene packed_box(int cells, const std::string& wall, const std::string& law) {
  core::Scene scene = uniform_bed(1e-3, density, 1, 1e-5, solids, cells, side);
  scene.column.closed = true;
  scene.column.gravity = 0;
  scene.effects = {{"solids_stress", "frictional"}, {"solids_viscosity", law}};
  scene.tfm.max_packing = 0.64;
  scene.tfm.viscosity_cap = viscosity;
  scene.tfm.solids_wall = core::choice_of<core::SolidsWall>(wall);
  scene.tfm.rtol = 1e-6;
  scene.tfm.pressure_tolerance = 1e-10;
  return scene;
}

/// Velocity of the solids at a place, m/s: component along an axis.
using Flow = std::function<double(int axis, double x, double y)>;

/// The share that is left, after a time, of a flow of the solids through which the fluid does not move.
double share_left(core::Scene scene, const Flow& flow, double time) {
  core::Timers timers;
  tfm::Model model(scene, timers);
  const core::Grid& grid = model.constants().grid;
  core::Checkpoint start = model.checkpoint();
  const tfm::StateLayout layout(grid, 1, scene.tfm.integrator == core::TfmIntegrator::implicit_steps);
  double before = 0;
  for (const auto& entry : layout.entries()) {
    if (entry.kind != Kind::velocity && entry.kind != Kind::flux) continue;
    double* out = start.arrays.at("state").data() + entry.begin;
    for (int j = entry.box.lo[1]; j < entry.box.hi[1]; ++j)
      for (int i = entry.box.lo[0]; i < entry.box.hi[0]; ++i) {
        const double x = (i + (entry.axis == 0 ? 0.0 : 0.5)) * grid.spacing[0],
                     y = (j + (entry.axis == 1 ? 0.0 : 0.5)) * grid.spacing[1];
        const double u = flow(entry.axis, x, y);
        *out++ = entry.kind == Kind::flux ? solids * u : u;
        if (entry.kind == Kind::velocity) before += u * u;
      }
  }
  model.start_from(start);
  advance(model, time);
  double after = 0;
  for (int axis = 0; axis < 2; ++axis)
    core::for_each_row(grid, core::owned_faces(grid, axis), [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c)
        after += std::pow(model.fields().solids.velocity[0][std::size_t(axis)][std::size_t(c)], 2);
    });
  return std::sqrt(after / before);
}

/// Relative error of the rate at which a flow along x decays between walls at y = 0 and H, where it is cos or sin.
double error_of_rate(const core::Scene& scene, const Flow& flow, double rate) {
  const double time = 1 / rate;
  return std::abs(-std::log(share_left(scene, flow, time)) - 1);
}

constexpr double speed = 1e-6;  // m/s: shear rates of 1e-3 to 1e-4 of the least one, and no inertia

class ShearOfSolids : public testing::TestWithParam<std::string> {};

// dU/dt = nu d2U/dy2: cos(pi y/H) between walls of free slip, sin(pi y/H) of no slip, rate nu (pi/H)^2. The scheme's
// own rate is 2 nu (1 - cos(pi h/H))/h^2, second order.
TEST_P(ShearOfSolids, DecaysBetweenWallsInSecondOrder) {
  const Flow free = [](int axis, double, double y) { return axis == 0 ? speed * std::cos(pi * y / side) : 0; };
  const Flow held = [](int axis, double, double y) { return axis == 0 ? speed * std::sin(pi * y / side) : 0; };
  const double rate = kinematic * std::pow(pi / side, 2);
  for (const auto& [wall, flow] : {std::pair{"free_slip", free}, std::pair{"no_slip", held}}) {
    const double coarse = error_of_rate(packed_box(8, wall, GetParam()), flow, rate);
    const double fine = error_of_rate(packed_box(16, wall, GetParam()), flow, rate);
    record(std::string(wall) + ", error of the rate, 16 cells", fine);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05) << wall;    // the next term of 1 - cos: 0.01
    EXPECT_NEAR(fine, std::pow(pi / 16, 2) / 12, 2e-5) << wall;  // a tenth of that term of 1 - cos; ten times rtol
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, ShearOfSolids, testing::Values(std::string("schaeffer"), std::string("mu_i")));

// Partial slip: mu_s dU/dn = -B U with B = p_f tan(delta_w)/(1 mm/s) far below 1 mm/s. cos(k (y - H/2)) decays at
// nu k^2, where k tan(k H/2) = B/mu_s; with B H/mu_s = 2, k H/2 = 0.8603335890 (x tan x = 1).
TEST(ShearOfSolids, DecaysBetweenWallsOfPartialSlip) {
  const double k = 2 * 0.8603335890193797 / side;
  const Flow flow = [&](int axis, double, double y) { return axis == 0 ? speed * std::cos(k * (y - side / 2)) : 0; };
  const auto error = [&](int cells, const std::string& integrator) {
    core::Scene scene = packed_box(cells, "johnson_jackson", "schaeffer");
    const double pressure = 0.05 * 0.01 / std::pow(0.04, 5);
    scene.tfm.wall_friction = 2 * viscosity / side * 1e-3 / pressure;
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    return error_of_rate(scene, flow, kinematic * k * k);
  };
  const double coarse = error(8, "explicit"), fine = error(16, "explicit");
  record("error of the rate, 16 cells", fine);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
  EXPECT_LT(fine, 0.01);
  EXPECT_NEAR(error(16, "implicit"), fine, 1e-4);  // a hundred times rtol: second order steps
}

// A vortex sin(kx) cos(ky), -cos(kx) sin(ky) in a box of free slip decays at 2 nu k^2: shear and normal stresses.
TEST(VortexOfSolids, DecaysInSecondOrder) {
  const double k = pi / side;
  const Flow flow = [&](int axis, double x, double y) {
    return axis == 0 ? speed * std::sin(k * x) * std::cos(k * y) : -speed * std::cos(k * x) * std::sin(k * y);
  };
  const auto error = [&](int cells) {
    core::Scene scene = packed_box(cells, "free_slip", "schaeffer");
    scene.column.sides = core::Boundary::wall;
    scene.column.size[0] = side;
    scene.column.cells[0] = cells;
    return error_of_rate(scene, flow, 2 * kinematic * k * k);
  };
  const double coarse = error(8), fine = error(16);
  record("error of the rate, 16 cells", fine);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05);  // as above
}

// Without the cap, p_f sin(delta)/|gamma|: the stress is p_f sin(delta) whatever the rate, so that every layer of a
// flow with a shear rate far above the least one slows by the same force at its edges; in the middle of a linear
// profile nothing changes.
TEST(ShearOfSolids, StressOfSchaefferIsThatOfItsAngle) {
  core::Scene scene = packed_box(10, "free_slip", "schaeffer");
  scene.tfm.viscosity_cap = 1e6;
  core::Timers timers;
  tfm::Model model(scene, timers);
  core::Checkpoint start = model.checkpoint();
  const tfm::StateLayout layout(model.constants().grid, 1, false);
  for (const auto& entry : layout.entries())
    if ((entry.kind == Kind::velocity || entry.kind == Kind::flux) && entry.axis == 0)
      for (std::size_t n = 0; n < entry.size; ++n)
        start.arrays.at("state")[entry.begin + n] = (entry.kind == Kind::flux ? solids : 1) * double(n);  // 1000 /s
  model.start_from(start);
  model.show(0);
  const tfm::Fields& fields = model.fields();
  const auto at = [&](int j) { return std::size_t(model.constants().grid.index(0, j)); };
  const double pressure = 0.05 * 0.01 / std::pow(0.04, 5), stress = pressure * std::sin(28.5 * pi / 180);
  EXPECT_NEAR(fields.stress.viscosity[at(5)] * solids * 1000, stress, 1e-6 * stress);  // the least rate: 1/2 (1/1000)^2
  EXPECT_NEAR(fields.solids.acceleration[0][0][at(5)], 0, 1e-9 * stress);              // round-off
  // The lowest layer, phi rho h thick, is held back by the stress above it alone, shared with the cell on the wall,
  // whose viscosity sees the mean square of 0 and 1000 /s: a factor sqrt 2.
  const double above = 0.5 * (1 + std::sqrt(2.0)) * stress;
  EXPECT_NEAR(fields.solids.acceleration[0][0][at(0)], above / ((solids + 1e-4) * density * 1e-3),
              1e-5 * above / (solids * density * 1e-3));
}

}  // namespace
}  // namespace polybed::scenes
