// One small sphere in a wide box of fluid, against the ordinary differential equation of its motion. It stirs the fluid
// that it feels: what that changes falls with the square of the cell, and is told by the box that is stirred, not by
// the step.
#include "scenes/dem_scenes.hpp"
#include "scenes/wet_beads.hpp"

namespace polybed::scenes {
namespace {

/// The sphere in the middle of a box of equal cells, m, high up.
core::Scene box_of(const Sphere& sphere, double cell, std::array<int, 3> cells) {
  core::Scene scene = wet_box(sphere.diameter, sphere.density, sphere.fluid,
                              {cell * cells[0], cell * cells[1], cell * cells[2]}, cells);
  scene.column.gravity = sphere.gravity;
  scene.effects["drag"] = sphere.law;
  if (sphere.added_mass > 0) scene.effects["added_mass"] = "half";
  return scene;
}

/// In gas that rises: d 0.1 mm, 2000 kg/m3, Schiller and Naumann's drag, g = 9.80665, relaxation time 60 ms.
const Sphere blown{1e-4, 2000, gas, 9.80665, 0.40};
core::Scene rising_gas(int every) {
  core::Scene scene = box_of(blown, 0.2, {5, 5, 5});
  scene.column.closed = false;
  scene.column.sides = core::Boundary::periodic;
  scene.inlet.superficial_velocity = {{0.0, 0.40}};
  scene.dem.fixed_step = 5e-6;
  scene.dem.fluid_every = every;
  return scene;
}

TEST(DemSphere, SettlesAgainstRisingGas) {
  const Sphere& sphere = blown;
  Beads beads(rising_gas(80), {{"a", {0.51, 0.52, 0.49}}});
  for (const auto& [time, published] : {std::pair{0.01, -0.01255261},
                                        {0.05, -0.04078891},
                                        {0.1, -0.05263133},
                                        {0.2, -0.05701036},
                                        {0.32, -0.05738225}}) {
    beads.until(time);
    const double expected = sphere.at(time)[0];
    compare(fmt::format("table at {} s", time), expected, published, 1e-6);  // its digits
    // The drag's coefficient stands for 0.7 % of the relaxation time, to second order; the gas stirred is 1e-6.
    compare(fmt::format("v at {} s", time), beads.motion(0).v[1], published, 1e-5);
  }
}

// The drag coefficient is computed once per fluid step: half the step leaves a quarter of the error.
TEST(DemSphere, FeelsLoadsThatStandToSecondOrderInTheStepOfTheFluid) {
  const auto error = [](int every) {
    Beads beads(rising_gas(every), {{"a", {0.51, 0.52, 0.49}}});
    beads.until(0.0128);
    return beads.motion(0).v[1] - blown.at(0.0128)[0];
  };
  EXPECT_NEAR(std::log2(error(1280) / error(640)), 2, 0.2);
}

/// From rest to its end in still fluid, at some times.
void fall(const std::string& name, const Sphere& sphere, double cell, double step, int every, double end,
          double tolerance) {
  core::Scene scene = box_of(sphere, cell, {5, 5, 5});
  scene.dem.fixed_step = step;
  scene.dem.fluid_every = every;
  Beads beads(scene, {{"a", {2.52 * cell, 3.47 * cell, 2.46 * cell}}});
  const double start = beads.place(0).x[1];
  for (const double share : {0.1, 0.3, 1.0}) {
    beads.until(share * end);
    const auto [v, y] = sphere.at(share * end);
    compare(fmt::format("{}: v at {} of the run", name, share), beads.motion(0).v[1], v, tolerance);
    compare(fmt::format("{}: y at {} of the run", name, share), beads.place(0).x[1] - start, y, tolerance);
  }
}

TEST(DemSphere, FallsInStillLiquid) {
  for (const double added : {0.0, 0.5}) {
    const Sphere glass{5e-4, 2500, water, 9.81, 0, added};
    fall(fmt::format("glass in water, added mass {}", added), glass, 20e-3, 1e-4, 4, 0.3, 1e-3);
  }
}

TEST(DemSphere, FallsInStillGas) {
  const Sphere glass{1e-4, 2500, gas, 9.81};
  fall("glass in air", glass, 50e-3, 1e-5, 100, 0.25, 1e-3);
}

/// Share by which a glass sphere of 0.5 mm falls faster in water than it would alone, at 0.1 s: it rides on what it
/// drags along. \param cells  their width over the diameter  \param width  of the kernel, likewise; 0: bilinear
double stirred(double cells, int n, double width) {
  const Sphere glass{5e-4, 2500, water, 9.81};
  const double cell = cells * glass.diameter;
  core::Scene scene = box_of(glass, cell, {n, n, n});
  scene.dem.fixed_step = 1e-4;
  scene.dem.fluid_every = 4;
  scene.effects["fluid_stress"] = "newtonian";
  if (width > 0) {
    scene.dem.kernel = core::Kernel::diffusion;
    scene.dem.kernel_width = width * glass.diameter;
  }
  Beads beads(scene, {{"a", {0.52 * n * cell, (n - 1) * cell, 0.47 * n * cell}}});
  beads.until(0.1);
  return beads.motion(0).v[1] / glass.at(0.1)[0] - 1;
}

// Measured; the limits are a half more. In cells of 2.5 d the sphere is 4.7 % too fast without a kernel. In cells of 40
// d it has moved by less than a cell and lacks 1e-4: what it is corrected for is a steady wake, longer than its own.
TEST(DemSphere, StirsLittleInWideCellsOrUnderAWideKernel) {
  for (const auto& [cells, n, width, most] :
       {std::tuple{10.0, 9, 0.0, 2e-3}, {20.0, 9, 0.0, 3e-4}, {40.0, 9, 0.0, 1.5e-4}, {2.5, 16, 6.0, 1e-2}}) {
    const double share = stirred(cells, n, width);
    RecordProperty(fmt::format("cells {} d, kernel {} d", cells, width), fmt::format("{:.2g}", share));
    EXPECT_LE(std::abs(share), most) << cells;
  }
}

// A creeping sphere of 5 mm in a box whose walls hold the fluid back: whatever the cells and the kernel, it falls at
// one speed, as its own wake is taken off. 0.957 of Stokes's is the mean of the speeds with kernels of 6 and 9
// diameters less the wake by hand; the walls, 36 radii away, take 4 to 6 % by Faxen's 1.004 R/h for each pair. With its
// wake the sphere is 3 to 14 % too fast, each time differently. 0.015: the fit of the spread, 5 % of a wake of a fifth.
TEST(DemSphere, FallsAtOneSpeedInCellsOfAllSizes) {
  const Sphere ball{5e-3, 7800, {1400, 10}, 9.81, 0, 0, "stokes"};
  const double length = 0.18;
  for (const auto& [n, width] : {std::pair{12, 6.0}, {12, 9.0}, {18, 4.0}, {7, 0.0}}) {
    core::Scene scene = box_of(ball, length / n, {n, n, n});
    scene.dem.fixed_step = 1e-4;
    scene.dem.fluid_every = 8;
    scene.effects["fluid_stress"] = "newtonian";
    if (width > 0) {
      scene.dem.kernel = core::Kernel::diffusion;
      scene.dem.kernel_width = width * ball.diameter;
    }
    Beads beads(scene, {{"a", {0.51 * length, 0.52 * length, 0.49 * length}}});
    beads.until(0.4);
    compare(fmt::format("{} cells, kernel {} d", n, width), beads.motion(0).v[1] / ball.at(0.4)[0], 0.957, 0.015);
  }
}

}  // namespace
}  // namespace polybed::scenes
