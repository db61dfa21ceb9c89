// What two species exchange by a table of dry boxes: its value in a cell, its range, and what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "../unit/core/scratch.hpp"
#include "core/error.hpp"
#include "scenes/record.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::scenes {
namespace {

/// Ratios of 1 but for the exchange, which is `ratio` at every phi of 0.1 to 0.5.
tfm::SolidsTable table_of(core::BoxRegime regime, double ratio) {
  tfm::SolidsTable t;
  t.regime = regime;
  t.reference = "GD-CS";
  t.phi = {0.1, 0.5};
  t.stokes = {0};
  t.restitution = {0.9};
  t.friction = {0.3};
  t.share = {0.5};
  t.size_ratio = 2;
  t.shear_number = {1, 1};
  for (tfm::TableQuantity* q : {&t.pressure, &t.viscosity, &t.dissipation, &t.temperature})
    q->value = q->error = q->seeds = {1, 1};
  t.exchange = {{ratio, ratio}, {0, 0}, {1, 1}};
  t.exchange_drift = 0.5;
  return t;
}

/// Two species of 2500 kg/m3, 1 and 2 mm, each at a solids fraction of half of `phi`, in a gas.
core::Scene gas(const std::string& exchange, double phi) {
  core::Scene scene = two_species_box(2, 8, 0.1, 1e-3, 1.8e-5);
  scene.fluid.density = 1.2;
  scene.species[1].density = 2500;
  scene.bed.volume_share = {0.5, 0.5};
  scene.bed.solids_fraction = scene.bed.start_solids_fraction = phi;
  scene.column.closed = true;
  core::set_friction(scene, 0.3);
  core::set_restitution(scene, 0.9);
  scene.calibrate.regime = core::BoxRegime::dry;
  scene.effects = {{"drag", "gidaspow"}, {"solids_stress", "kinetic"}, {"species_exchange", exchange}};
  return scene;
}

/// Sets the temperatures of both species and has the first drift along y; returns how many cells the exchange counts as
/// outside its table.
std::uint64_t stir(tfm::Model& model, double theta_1, double theta_2, double drift) {
  model.show(0);
  auto& fields = const_cast<tfm::Fields&>(model.fields());
  for (std::size_t j = 0; j < 2; ++j) {
    std::fill(fields.solids.temperature[j].begin(), fields.solids.temperature[j].end(), j == 0 ? theta_1 : theta_2);
    for (core::Field& u : fields.solids.velocity[j]) std::fill(u.begin(), u.end(), 0.0);
  }
  std::fill(fields.solids.velocity[0][1].begin(), fields.solids.velocity[0][1].end(), drift);
  tfm::SolidsExchange& law = *model.effects().species_exchange;
  const std::uint64_t before = law.use()->guarded;
  law.evaluate(fields);
  return law.use()->guarded - before;
}

/// K_12/(phi_1 phi_2) of the middle cell.
double exchange(tfm::Model& model, double theta_1, double theta_2, double drift) {
  (void)stir(model, theta_1, theta_2, drift);
  return model.fields().species_exchange[0][std::size_t(model.constants().grid.index(4, 4))];
}

// phi_j 0.15, theta 1e-3 and 5e-4 m2/s2, drift 0.02 m/s, e 0.9. q = (2/3) mm 0.225 1/mm/0.7 = 0.2142857, g_12 = (1 + 3
// q + 2 q^2)/0.7 = 2.4781341; s = 0.02/sqrt(3e-3) = 0.3651484, its factor 1.0264164; m_1 m_2/((m_1 + m_2) V_1 V_2)
// = 5.3051648e11 kg/m6; (2/3) 1.9 5.3051648e11 2.25e-6 2.4781341 sqrt(8 pi 1.5e-3) 1.0264164 = 746719.8 kg/(m3 s),
// times the ratio 0.8.
TEST(ExchangeTable, ValueOfOneCell) {
  const test::Scratch scratch;
  const std::string file = (scratch.path() / "dry.h5").string();
  tfm::write_solids_table(file, table_of(core::BoxRegime::dry, 0.8));
  core::Timers timers;
  tfm::Model model(gas("table:" + file, 0.3), timers);
  EXPECT_NEAR(exchange(model, 1e-3, 5e-4, 0.02), 0.8 * 746719.8, 0.1);
  EXPECT_NEAR(exchange(model, 0, 0, 0), 0, 0) << "at rest";
  EXPECT_GT(exchange(model, 0, 0, 0.02), 0) << "streams that meet";
  EXPECT_NEAR(exchange(model, -1e-9, 0, 0.02), exchange(model, 0, 0, 0.02), 0) << "a temperature just below 0";
  EXPECT_TRUE(model.fields().stress.contact.empty()) << "without C_s";
}

// 64 cells; a drift of half of sqrt(theta) is the fastest of the boxes, theta the mean by mass, which is (1e-3 +
// 5e-4)/2.
TEST(ExchangeTable, CountsWhatLiesOutsideAndHoldsTheEdge) {
  const test::Scratch scratch;
  const std::string file = (scratch.path() / "dry.h5").string();
  tfm::write_solids_table(file, table_of(core::BoxRegime::dry, 0.8));
  core::Timers timers;
  tfm::Model inside(gas("table:" + file, 0.3), timers), beyond(gas("table:" + file, 0.56), timers);
  const double limit = 0.5 * std::sqrt(7.5e-4);
  EXPECT_EQ(stir(inside, 1e-3, 5e-4, 0.99 * limit), 0u);
  EXPECT_EQ(stir(inside, 1e-3, 5e-4, 1.01 * limit), 64u);
  EXPECT_EQ(stir(beyond, 1e-3, 5e-4, 0.99 * limit), 64u);
  tfm::write_solids_table(file, table_of(core::BoxRegime::dry, 1.6));
  tfm::Model twice(gas("table:" + file, 0.56), timers);
  EXPECT_NEAR(exchange(twice, 1e-3, 5e-4, 0), 2 * exchange(beyond, 1e-3, 5e-4, 0), 1e-6) << "the ratio of the edge";
}

// C_s p_f/phi^2 with the pressure of friction alone, without that of collisions.
TEST(ExchangeTable, ContactOfAPackedBedIsAddedIfAskedFor) {
  const test::Scratch scratch;
  const std::string file = (scratch.path() / "dry.h5").string();
  tfm::write_solids_table(file, table_of(core::BoxRegime::dry, 0.8));
  core::Timers timers;
  core::Scene scene = gas("table:" + file, 0.3);
  scene.tfm.frictional_onset = 0.2;
  tfm::Model without(scene, timers);
  scene.tfm.exchange_pressure = 50;
  tfm::Model with(scene, timers);
  const double more = exchange(with, 1e-3, 5e-4, 0) - exchange(without, 1e-3, 5e-4, 0);
  const double friction = with.fields().stress.contact[std::size_t(with.constants().grid.index(4, 4))];
  EXPECT_GT(friction, 0);
  EXPECT_NEAR(more, 50 * friction / 0.09, 1e-9 * more);
}

void refused(const core::Scene& scene, const std::string& told) {
  core::Timers timers;
  try {
    tfm::Model model(scene, timers);
    FAIL() << "accepted: " << told;
  } catch (const core::CaseError& error) {
    EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
  }
}

TEST(ExchangeTable, WhatCannotBeIsRefused) {
  const test::Scratch scratch;
  const auto file = [&](const std::string& name, const tfm::SolidsTable& table) {
    const std::string path = (scratch.path() / name).string();
    tfm::write_solids_table(path, table);
    return "table:" + path;
  };
  const std::string dry = file("dry.h5", table_of(core::BoxRegime::dry, 0.8)),
                    wet = file("wet.h5", table_of(core::BoxRegime::wet, 0.8));
  tfm::SolidsTable none = table_of(core::BoxRegime::dry, 1);
  none.exchange = {};
  refused(gas(wet, 0.3), "dry boxes alone");
  refused(gas(file("none.h5", none), 0.3), "holds no beta_12");
  core::Scene scene = gas(dry, 0.3);
  scene.effects["solids_stress"] = "frictional";
  refused(scene, "granular temperatures");
  scene = gas(dry, 0.3);
  scene.species.pop_back();
  scene.bed.volume_share = {1};
  refused(scene, "of two species, the case has 1");
  scene = gas(dry, 0.3);
  scene.calibrate.regime = core::BoxRegime::automatic;
  scene.column.closed = false;
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 1e-3;
  scene.inlet.superficial_velocity = {{0, 0.02}};
  scene.effects["drag"] = "cello";
  refused(scene, "gamma tau_p");
}

// A case of other sizes and shares than the boxes is run with the edge, which is told.
TEST(ExchangeTable, AnotherCompositionIsTold) {
  const test::Scratch scratch;
  const std::string file = (scratch.path() / "dry.h5").string();
  tfm::write_solids_table(file, table_of(core::BoxRegime::dry, 0.8));
  core::Timers timers;
  core::Scene scene = gas("table:" + file, 0.3);
  EXPECT_TRUE(tfm::Model(scene, timers).effects().warnings.empty());
  scene.bed.volume_share = {0.25, 0.75};
  const tfm::Model model(scene, timers);
  ASSERT_EQ(model.effects().warnings.size(), 1u);
  EXPECT_NE(model.effects().warnings[0].find("species exchange " + file + ": share"), std::string::npos);
}

}  // namespace
}  // namespace polybed::scenes
