// Simple shear with drag against the figures of another code: a minute of CPU time each.
#include "scenes/dem_wet_gas.hpp"

namespace polybed::scenes {
namespace {

class ShearWithDrag : public testing::TestWithParam<DragRow> {};

// 2 %, or three standard errors; beside that half of the last digit that the other code's figures are known to.
TEST_P(ShearWithDrag, AgreesWithTheTable) {
  const DragRow& row = GetParam();
  constexpr double rate = 100, d = Gas::diameter;
  const Gas gas{.number = 1000,
                .fraction = 0.4,
                .restitution = 0.9,
                .temperature = row.expected[theta] * rate * rate * d * d,
                .softness = 0.03,
                .shear_rate = rate};
  GasRun run(gas, wet_scene_of(gas, row.drag));
  run.run_for(6 / rate);
  const Blocks<3> mean = averages(run, 20 / rate, 20);
  const double unit = Gas::density * d * d * rate * rate;
  const std::array<double, 3> units{d * d * rate * rate, unit, unit};
  const std::array<const char*, 3> name{"theta", "p", "mu"};
  for (const Quantity q : {theta, pressure, shear_stress}) {
    const double digit = row.expected[q] < 0.19 || row.drag == 0.1 ? 0.0005 : 0.00005;
    compare(name[q], mean.mean(q) / units[q], row.expected[q],
            std::max(0.02, 3 * mean.error(q) / mean.mean(q)) + digit / row.expected[q]);
  }
}

INSTANTIATE_TEST_SUITE_P(DemRows, ShearWithDrag, testing::ValuesIn(drag_rows),
                         [](const auto& info) { return fmt::format("Drag{:.0f}Tenths", 10 * info.param.drag); });

}  // namespace
}  // namespace polybed::scenes
