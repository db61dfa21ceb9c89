// Drag of a sheared box: one particle against the closed form, many against another program, energy.
#include "scenes/dem_wet_gas.hpp"

namespace polybed::scenes {
namespace {

// w = v_x - gamma y of a particle with v_y = v_0 exp(-t/tau): (w_0 - gamma v_0 t) exp(-t/tau). Two half kicks with the
// flow of the place before and after a drift give just that, whatever the step: 1e-10 is round-off of 500 steps, in
// numbers 40 times as large as w.
TEST(DemShearDrag, OneParticleDecaysTowardsTheFlow) {
  constexpr double rate = 10, drag = 5, time = 0.05, tau = 1 / (drag * rate), w0 = 1e-3;
  for (const double dt : {1e-3, 1e-4})
    for (const double v0 : {0.0, -2e-3}) {
      const Gas gas{.number = 1, .fraction = 1e-3, .shear_rate = rate};
      core::Scene scene = wet_scene_of(gas, drag);
      scene.dem.fixed_step = dt;
      const double y0 = 0.4 * gas.length();
      Beads beads(scene, {{"a", {0.5 * gas.length(), y0, 0.5 * gas.length()}, {rate * y0 + w0, v0, 0}}});
      beads.until(time);
      const double w = beads.motion(0).v[0] - rate * beads.place(0).x[1];
      compare("slip", w, (w0 - rate * v0 * time) * std::exp(-time / tau), 1e-10);
    }
}

// 1/(gamma tau_d) = 1: theta .1998, p .666, mu .340 (N = 2048). 3 %, or three standard errors of this short run. The
// work of the shear goes into contacts, drag and what is stored: 1 %, this project's goal.
TEST(DemShearDrag, OneRowAndItsBalance) {
  const DragRow& row = drag_rows[1];
  constexpr double rate = 100, d = Gas::diameter;
  const Gas gas{.number = 500,
                .fraction = 0.4,
                .restitution = 0.9,
                .temperature = row.expected[theta] * rate * rate * d * d,
                .softness = 0.03,
                .shear_rate = rate};
  GasRun run(gas, wet_scene_of(gas, row.drag));
  run.run_for(5 / rate);
  const dem::Totals before = dem::totals_of(run.model);
  const double heat_before = dem::stress_of(run.model).temperature[0];
  const Blocks<3> mean = averages(run, 16 / rate, 16);
  const dem::Totals after = dem::totals_of(run.model);
  const double unit = Gas::density * d * d * rate * rate;
  const std::array<double, 3> units{d * d * rate * rate, unit, unit};
  const std::array<const char*, 3> name{"theta", "p", "mu"};
  for (const Quantity q : {theta, pressure, shear_stress})
    compare(name[q], mean.mean(q) / units[q], row.expected[q], std::max(0.03, 3 * mean.error(q) / mean.mean(q)));
  const double heat = dem::stress_of(run.model).temperature[0] - heat_before;
  const double stored = 1.5 * gas.number * gas.mass() * heat + after.elastic - before.elastic;
  const double time = 16 / rate, sink = sink_of(gas, row.drag, mean.mean(theta)) * time;
  const double work = mean.mean(shear_stress) * rate * std::pow(gas.length(), 3) * time;
  compare("balance", work, after.dissipated - before.dissipated + sink + stored, 0.01);
  EXPECT_GT(sink, after.dissipated - before.dissipated) << "drag takes more than collisions here";
}

// Kinetic, elastic, dissipated and the work of faces and fluid: at 50 steps per contact to 1e-3, as every run is held
// to. A checkpoint keeps the fluid's work.
TEST(DemShearDrag, EnergyClosesAndResumesToTheBit) {
  const Gas gas{.number = 150, .fraction = 0.4, .restitution = 0.9, .shear_rate = 100, .steps_per_contact = 50};
  GasRun whole(gas, wet_scene_of(gas, 1)), again(gas, wet_scene_of(gas, 1));
  const dem::Totals before = dem::totals_of(whole.model);
  whole.run_for(2 / gas.shear_rate);
  whole.model.restart();
  const dem::Totals after = dem::totals_of(whole.model);
  compare("ledger", after.sum(), before.sum(), 1e-3, after.dissipated + before.kinetic);
  again.model.resume(whole.model.checkpoint());
  for (GasRun* run : {&whole, &again}) run->run_for(0.5 / gas.shear_rate);
  EXPECT_EQ(whole.model.checkpoint().arrays, again.model.checkpoint().arrays);
  EXPECT_EQ(whole.model.checkpoint().integers, again.model.checkpoint().integers);
  EXPECT_NE(whole.model.counted_energy().fluid_work.units(), 0);
}

TEST(DemShearDrag, ABoxWithoutItHasNone) {
  const Gas gas{.number = 50, .shear_rate = 100};
  EXPECT_EQ(GasRun(gas).model.affine_drag(), nullptr);
  EXPECT_NE(GasRun(gas, wet_scene_of(gas, 1)).model.affine_drag(), nullptr);
  EXPECT_EQ(GasRun(gas, wet_scene_of(gas, 1)).model.coupling(), nullptr) << "no fluid is solved for";
}

}  // namespace
}  // namespace polybed::scenes
