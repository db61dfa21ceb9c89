// Two species and a fluid that relax to one velocity: the exchange, and that it keeps momentum.
#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

using Kind = tfm::StateLayout::Entry::Kind;

/// 0.8 and 1.5 mm, 2600 and 1800 kg/m3, fractions 0.2 and 0.15, in a fluid of 1100 kg/m3, 0.02 Pa s that moves sideways
/// at 0.1 m/s through them; sides joined, no gravity.
core::Scene sideways() {
  core::Scene scene = uniform_bed(0.8e-3, 2600, 1100, 0.02, 0.35, 4, 0.02);
  scene.species.push_back(scene.species[0]);
  scene.species[1].name = "second";
  scene.species[1].diameter = 1.5e-3;
  scene.species[1].density = 1800;
  scene.bed.volume_share = {0.2 / 0.35, 0.15 / 0.35};
  scene.column.gravity = 0;
  scene.column.closed = true;
  scene.effects = {{"drag", "stokes"}};
  scene.tfm.rtol = 1e-8;
  scene.tfm.pressure_tolerance = 1e-12;
  return scene;
}

struct Velocities {
  double first, second, fluid;
};

Velocities velocities_after(double time, const std::string& integrator) {
  core::Scene scene = sideways();
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  core::Timers timers;
  tfm::Model model(scene, timers);
  core::Checkpoint start = model.checkpoint();
  const tfm::StateLayout layout(model.constants().grid, 2, integrator == "implicit");
  for (const auto& entry : layout.entries())
    if (entry.kind == Kind::flux && entry.axis == 0)  // J = eps U_f, the solids at rest
      std::fill_n(start.arrays.at("state").begin() + std::ptrdiff_t(entry.begin), entry.size, 0.65 * 0.1);
  model.start_from(start);
  advance(model, time);
  const auto at = std::size_t(model.constants().grid.index(0, 2));
  const tfm::Fields& fields = model.fields();
  return {fields.solids.velocity[0][0][at], fields.solids.velocity[1][0][at], fields.fluid.velocity[0][at]};
}

double momentum(const Velocities& u) { return 0.2 * 2600 * u.first + 0.15 * 1800 * u.second + 0.65 * 1100 * u.fluid; }

class SlipRelaxation : public testing::TestWithParam<std::string> {};

// References: the matrix exponential of the 3 x 3 system, computed apart from the code; the common end is the momentum
// over the mass, 0.65 1100 0.1/1505 = 0.0475083 m/s. 1e-6 m/s: a hundred steps of rtol 1e-8 on 0.1 m/s and the printed
// digits.
TEST_P(SlipRelaxation, FollowsTheMatrixExponentialAndKeepsMomentum) {
  const Velocities early = velocities_after(5e-3, GetParam()), late = velocities_after(1.0, GetParam());
  EXPECT_NEAR(early.first, 0.0387198, 1e-6);
  EXPECT_NEAR(early.second, 0.0195292, 1e-6);
  EXPECT_NEAR(early.fluid, 0.0644655, 1e-6);
  for (const double u : {late.first, late.second, late.fluid}) EXPECT_NEAR(u, 0.0475083, 1e-6);
  record("relative error of momentum", momentum(early) / (0.65 * 1100 * 0.1) - 1);
  EXPECT_NEAR(momentum(early), 0.65 * 1100 * 0.1, 1e-13 * 71.5);  // the exchange cancels; round-off
}

INSTANTIATE_TEST_SUITE_P(Integrators, SlipRelaxation,
                         testing::Values(std::string("explicit"), std::string("imex"), std::string("implicit")));

}  // namespace
}  // namespace polybed::scenes
