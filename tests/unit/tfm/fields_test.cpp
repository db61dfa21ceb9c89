// Rows without the solids' equations keep no older results: the rates are those of a model that never had any there.
#include "tfm/fields.hpp"

#include <gtest/gtest.h>

#include "scenes/record.hpp"
#include "tfm/right_hand_side.hpp"

namespace polybed::scenes {
namespace {

TEST(Fields, KeepNoResultsOfSolidsAboveTheRowsOfTheirEquations) {
  core::Timers timers;
  core::Scene scene = with_particle_forces(binary_bed(6, 20, 0.03, 0.1));
  scene.effects["solids_viscosity"] = "schaeffer";
  tfm::Model model(scene, timers);
  const tfm::StateLayout layout(model.constants().grid, 2, false);
  std::vector<double> y(layout.size());
  layout.pack(model.fields().solids, model.fields().fluid, y);
  for (std::size_t n = 0; n < y.size(); ++n) y[n] += 1e-3 * double(n % 5);  // uneven, and moving
  const auto make = [&] {
    return std::make_unique<tfm::RightHandSide>(scene, model.constants(), model.boundaries(), model.inlet(),
                                                tfm::Discretisation{}, timers);
  };
  const auto late = make(), early = make();
  ASSERT_TRUE(late->evaluate(0, layout, y));
  constexpr int row = 4;  // within the bed, so that the rows above have results
  late->hold_solids_above(row);
  early->hold_solids_above(row);
  ASSERT_TRUE(late->evaluate(0, layout, y) && early->evaluate(0, layout, y));
  const tfm::Fields &a = late->fields(), &b = early->fields();
  EXPECT_EQ(a.solids_flux, b.solids_flux);
  EXPECT_EQ(a.solids.fraction_rate, b.solids.fraction_rate);
  EXPECT_EQ(a.solids.acceleration, b.solids.acceleration);
  EXPECT_EQ(a.solids.exchange, b.solids.exchange);
  EXPECT_EQ(a.stress.pressure, b.stress.pressure);
  EXPECT_EQ(a.inertia.response, b.inertia.response);
  EXPECT_EQ(a.flux_rate.free, b.flux_rate.free);
}

}  // namespace
}  // namespace polybed::scenes
