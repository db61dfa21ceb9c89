// A compressible fluid alone: sound in a liquid and in a gas, and the weight of a gas.
#include <gtest/gtest.h>

#include <numbers>

#include "core/numerics/operators.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// A pipe of fluid alone, one cell wide: no solids, no wall, no drag.
core::Scene pipe(const char* law, int cells, double length, double density) {
  core::Scene scene = uniform_bed(1e-3, 2000, density, 1e-5, 0.5, cells, length);
  scene.bed.static_height = 0;
  scene.effects.clear();
  scene.column.gravity = 0;
  scene.fluid.equation_of_state = core::choice_of<core::Compressibility>(law);
  return scene;
}

/// Steps of one length up to a time; calls see(model) after each.
template <class See>
void march(tfm::Model& model, double until, double step, See&& see) {
  while (model.time() < until * (1 - 1e-9)) {
    const double next = std::min(until, model.time() + step);
    while (model.time() < next) model.step(next);
    see();
  }
}

struct Hammer {
  double rise = 0;    ///< pressure behind the first wave, Pa
  double period = 0;  ///< between rising passages through zero, s
  double fluid_error = 0;
};

/// Water at rest in a pipe of 1 m, open at the top; from 0.1 ms on it is driven in at the bottom at 0.1 m/s, reached
/// within a fifth of the time that sound takes to the top.
Hammer water_hammer(const char* integrator) {
  constexpr int cells = 80;
  constexpr double length = 1, sound = 1450.683, crossing = length / sound, at = 1e-4;
  core::Scene scene = pipe("tait", cells, length, 998.207);
  scene.inlet.superficial_velocity = {{0.0, 0.0}, {at, 0.0}, {at + 0.2 * crossing, 0.1}};
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  core::Timers timers;
  tfm::Model model(scene, timers);
  const double step = 0.05 * length / cells / sound;
  const auto bottom = std::size_t(model.constants().grid.index(0, 0));
  const auto& p = model.fields().fluid.pressure;
  Hammer result;
  double sum = 0, last_p = 0, last_t = 0, first = 0;
  int samples = 0;
  for (const double breakpoint : {at, at + 0.2 * crossing}) {
    march(model, breakpoint, step, [] {});
    model.restart();
  }
  march(model, at + 9.2 * crossing, step, [&] {
    model.show(model.time());
    const double t = (model.time() - at) / crossing;
    if (t > 0.7 && t < 1.7) {  // the wave has passed and has not come back
      sum += p[bottom];
      ++samples;
    }
    if (last_p < 0 && p[bottom] >= 0) {
      const double passage = last_t + (model.time() - last_t) * last_p / (last_p - p[bottom]);
      if (first == 0)
        first = passage;
      else
        result.period = passage - first;
    }
    last_p = p[bottom];
    last_t = model.time();
  });
  result.rise = sum / samples;
  result.fluid_error =
      model.fluid_account(model.time())->error(fluid::fluid_mass(model.constants().grid, model.fields().fluid));
  return result;
}

class WaterHammer : public testing::TestWithParam<const char*> {};

// Joukowsky: rho c dU = 998.207 * 1450.683 * 0.1 = 1.44808e5 Pa; a pipe closed at one end and open at the other
// returns after 4 L/c = 2.75732 ms. p = 0 lies half a cell above the top: 80 cells make that 0.6 % longer.
TEST_P(WaterHammer, HasJoukowskysPressureAndThePeriodOfThePipe) {
  const Hammer hammer = water_hammer(GetParam());
  record("pressure", hammer.rise);
  record("period, ms", 1e3 * hammer.period);
  record("fluid mass", hammer.fluid_error);
  EXPECT_NEAR(hammer.rise, 1.44808e5, 0.02 * 1.44808e5);
  EXPECT_NEAR(hammer.period, 2.75732e-3, 0.01 * 2.75732e-3);
  EXPECT_LT(hammer.fluid_error, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Compressible, WaterHammer, testing::Values("explicit", "implicit"));

/// Replaces the vertical flux and the pressure that a model starts from by functions of the height, m.
template <class Flux, class NetPressure>
void start_with(tfm::Model& model, Flux&& flux, NetPressure&& pressure) {
  const core::Grid& grid = model.constants().grid;
  const int n = grid.cells[1];
  core::Checkpoint start = model.checkpoint();
  std::vector<double>& state = start.arrays.at("state");  // phi, U_x, U_y, J_x, J_y, p in a column one cell wide
  ASSERT_EQ(state.size(), std::size_t(6 * n + 2));
  for (int j = 1; j < n; ++j) state[std::size_t(4 * n + 1 + j)] = flux(j * grid.spacing[1]);
  for (int j = 0; j < n; ++j) state[std::size_t(5 * n + 2 + j)] = pressure(grid.centre(1, j));
  model.start_from(start);
}

/// Air at 20 degC and 1 atm: R T = 287.05 * 293.15 = 84148.7, c = 290.084 m/s, 101325/84148.7 = 1.204118 kg/m3.
constexpr double atmosphere = 101325, gas_rt = 84148.7, air_density = 1.204118, air_sound = 290.084;

core::Scene closed_pipe_of_air(int cells, double length) {
  core::Scene scene = pipe("ideal_gas", cells, length, air_density);
  scene.column.closed = true;
  return scene;
}

class StandingWave : public testing::TestWithParam<const char*> {};

// The lowest tone of a closed pipe, u = u_0 sin(pi y/L): period 2 L/c = 6.89455 ms (isothermal sound). The grid of 32
// cells makes it (pi/32)^2/24 = 4.0e-4 longer; the tenth period is timed to much less. Nothing damps it but the upwind
// convection, u_0 k^2 h/4 = 0.008 per second, and the steps.
TEST_P(StandingWave, OfAGasHasTheIsothermalToneAndLasts) {
  constexpr double period = 2 / air_sound;
  core::Scene scene = closed_pipe_of_air(32, 1);
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(GetParam());
  scene.tfm.rtol = 1e-6;
  core::Timers timers;
  tfm::Model model(scene, timers);
  start_with(
      model, [](double y) { return 0.1 * std::sin(std::numbers::pi * y); }, [](double) { return 0.0; });
  const auto middle = std::size_t(model.constants().grid.index(0, 16));
  const auto& u = model.fields().fluid.flux[1];
  double last_u = 0.1, last_t = 0, tenth = 0, greatest = 0;
  int passages = 0;  // downward, at 1/4, 5/4 ... of a period
  march(model, 10 * period, period / 400, [&] {
    model.show(model.time());
    if (last_u > 0 && u[middle] <= 0 && ++passages == 10)
      tenth = last_t + (model.time() - last_t) * last_u / (last_u - u[middle]);
    if (model.time() > 8.5 * period) greatest = std::max(greatest, u[middle]);
    last_u = u[middle];
    last_t = model.time();
  });
  const double measured = tenth / 9.25;
  record("period over 2 L/c, less 1", measured / period - 1);
  record("amplitude left", greatest / 0.1);
  EXPECT_NEAR(measured / period - 1, 4.0e-4, 1e-4);  // the steps' own (2 pi/400)^2/3 = 8e-5, implicit
  EXPECT_NEAR(greatest, 0.1, 0.1 * 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Compressible, StandingWave, testing::Values("explicit", "implicit"));

// A column of air of 1 km at rest: P = P_out exp(g (H - y)/(R T)), which differs from the outlet's density by 12 % at
// the bottom: with rho_0 in place of rho_f the fluid would fall at 0.12 g. The grid of 20 cells leaves
// g (g h/(R T))^2/12 = 2.8e-5 m/s2 of imbalance.
TEST(Compressible, AnIsothermalAtmosphereIsAtRest) {
  constexpr double height = 1000, gravity = 9.81;
  core::Scene scene = closed_pipe_of_air(20, height);
  scene.column.gravity = gravity;
  core::Timers timers;
  tfm::Model model(scene, timers);
  start_with(
      model, [](double) { return 0.0; },
      [&](double y) {
        const double above = height - y;
        return atmosphere * (std::exp(gravity * above / gas_rt) - 1) - air_density * gravity * above;
      });
  advance(model, 1.0);
  double greatest = 0;
  for (const double u : model.fields().fluid.flux[1]) greatest = std::max(greatest, std::abs(u));
  const auto& density = model.fields().fluid.compression.density;
  record("greatest velocity after 1 s", greatest);
  EXPECT_LT(greatest, 4e-5);  // 2.8e-5 m/s2 over 1 s, and R T to six digits: 1e-6 * 0.12 g
  EXPECT_NEAR(density[std::size_t(model.constants().grid.index(0, 0))], air_density * std::exp(gravity * 975 / gas_rt),
              1e-5);  // six digits of R T and rho_0
}

// The same in a cone of rings and of cut cells, as high and up to 400 m wide, whose walls bear the weight above them;
// of the gas nothing is lost.
TEST(Compressible, AnIsothermalAtmosphereIsAtRestInACone) {
  constexpr double height = 1000, gravity = 9.81, widest = 400;
  for (const core::ColumnShape shape : {core::ColumnShape::axisymmetric, core::ColumnShape::cylinder}) {
    const bool cut = shape == core::ColumnShape::cylinder;
    core::Scene scene = closed_pipe_of_air(20, height);
    scene.column.gravity = gravity;
    scene.column.shape = shape;
    scene.column.sides = core::Boundary::wall;
    scene.column.profile = {{0, 0.5 * widest}, {500, widest}, {height, widest}};
    scene.column.dimensions = cut ? 3 : 2;
    scene.column.size = {cut ? widest : 0.5 * widest, height, cut ? widest : 0.5 * widest * std::numbers::pi};
    scene.column.cells = {cut ? 10 : 6, 20, cut ? 10 : 1};
    core::Timers timers;
    tfm::Model model(scene, timers);
    const core::Grid& grid = model.constants().grid;
    core::Checkpoint start = model.checkpoint();
    std::vector<double>& state = start.arrays.at("state");  // the pressures are its last numbers
    std::size_t at = state.size() - grid.cell_count();
    for (int k = 0; k < grid.cells[2]; ++k)
      for (int j = 0; j < grid.cells[1]; ++j)
        for (int i = 0; i < grid.cells[0]; ++i, ++at) {
          const double above = height - grid.centre(1, j);
          state[at] = atmosphere * (std::exp(gravity * above / gas_rt) - 1) - air_density * gravity * above;
        }
    model.start_from(start);
    const double mass = fluid::fluid_mass(grid, model.fields().fluid);
    advance(model, 1.0);
    double greatest = 0;
    for (std::size_t a = 0; a < std::size_t(grid.dimensions); ++a)
      for (const double u : model.fields().fluid.flux[a]) greatest = std::max(greatest, std::abs(u));
    const double lost = fluid::fluid_mass(grid, model.fields().fluid) / mass - 1;
    record("greatest velocity after 1 s", greatest);
    record("gas lost", lost);
    EXPECT_LT(greatest, 4e-5);  // as in a pipe
    EXPECT_LT(std::abs(lost), 1e-8);
  }
}

}  // namespace
}  // namespace polybed::scenes
