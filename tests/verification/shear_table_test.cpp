// Tables of sheared particles in the two-fluid model: what they add to pressure and viscosity, and which are refused.
#include <gtest/gtest.h>

#include "../unit/core/scratch.hpp"
#include "core/error.hpp"
#include "scenes/record.hpp"
#include "tfm/solids_table.hpp"

namespace polybed::scenes {
namespace {

constexpr double viscosity = 1e-3, diameter = 1e-3;

/// A table whose ratios are the same everywhere.
tfm::SolidsTable table_of(core::BoxRegime regime, double p, double mu, double gamma) {
  tfm::SolidsTable t;
  t.regime = regime;
  t.reference = regime == core::BoxRegime::wet ? "viscous" : "GD-CS";
  t.phi = {0.1, 0.5};
  t.stokes = {0};
  if (regime == core::BoxRegime::wet) t.stokes = {0.001, 1000};
  t.restitution = {0.9};
  t.friction = {0.3};
  t.share = {0};
  for (std::size_t n = 0; n < t.size(); ++n) {
    t.pressure.value.push_back(p);
    t.viscosity.value.push_back(mu);
    t.dissipation.value.push_back(gamma);
    t.temperature.value.push_back(1);
    t.shear_number.push_back(1);
  }
  for (tfm::TableQuantity* q : {&t.pressure, &t.viscosity, &t.dissipation, &t.temperature})
    q->error = q->seeds = std::vector<double>(t.size(), 1);
  return t;
}

/// Solids of phi 0.4 in a box of equal sides that move as v = gamma x e_y.
core::Scene sheared(const std::string& stress) {
  core::Scene scene = uniform_bed(diameter, 2500, 1000, viscosity, 0.4, 8, 0.1);
  scene.column.cells = {8, 8, 1};
  scene.column.size = {0.1, 0.1, 0.0125};
  scene.column.closed = true;
  scene.effects["solids_stress"] = stress;
  core::set_friction(scene, 0.3);
  scene.tfm.max_packing = 0.62;
  return scene;
}

/// Pressure and viscosity over phi of the cell in the middle, sheared at a rate.
struct Seen {
  double pressure, slope, viscosity;
};
Seen seen(const core::Scene& scene, double rate) {
  core::Timers timers;
  tfm::Model model(scene, timers);
  model.show(0);
  auto& fields = const_cast<tfm::Fields&>(model.fields());
  const core::Grid& grid = model.constants().grid;
  for (int j = -1; j <= 8; ++j)
    for (int i = -1; i <= 8; ++i)
      fields.solids.velocity[0][1][std::size_t(grid.index(i, j))] = rate * (i + 0.5) * grid.spacing[0];
  for (double& s : fields.stress.strain[0]) s = rate * rate;
  for (core::Field* f : {&fields.stress.pressure, &fields.stress.slope, &fields.stress.viscosity})
    std::fill(f->begin(), f->end(), 0.0);
  model.effects().collisions->add(fields);
  const auto c = std::size_t(grid.index(4, 4));
  return {fields.stress.pressure[c], fields.stress.slope[c], fields.stress.viscosity[c]};
}

// mu gamma V(0.4) R, phi_m = 0.596 of friction 0.3: V = (0.4/0.196)^2 = 4.1649313. gamma 20 1/s less 0.01 of the
// rounding at 0: 5e-4 of it. p = 1e-3 20 4.1649 2 = 0.166597 Pa; mu_s/phi = 1e-3 4.1649 3/0.4 = 0.0312370 Pa s.
TEST(ShearTable, WetStressOfOneCell) {
  const test::Scratch scratch;
  const std::string file = (scratch.path() / "wet.h5").string();
  tfm::write_solids_table(file, table_of(core::BoxRegime::wet, 2, 3, 1));
  const Seen s = seen(sheared("table:" + file), 20);
  EXPECT_NEAR(s.pressure, 0.166597, 6e-4 * 0.166597);
  EXPECT_NEAR(s.viscosity, 0.0312370, 1e-6);
  EXPECT_NEAR(s.slope, s.pressure * 2 * 0.596 / (0.4 * 0.196), 1e-9) << "V'/V";
  EXPECT_NEAR(seen(sheared("table:" + file), 0).pressure, 0, 1e-15) << "at rest";
}

// Where all ratios are 1 a dry table is kinetic theory with the g0 of Carnahan and Starling; twice the pressure is
// twice the pressure, and with an inviscid fluid twice viscosity and dissipation leave the temperature and double mu_s.
TEST(ShearTable, DryStressOverKineticTheory) {
  const test::Scratch scratch;
  const auto written = [&](const std::string& name, double p, double mu, double gamma) {
    const std::string file = (scratch.path() / name).string();
    tfm::write_solids_table(file, table_of(core::BoxRegime::dry, p, mu, gamma));
    core::Scene scene = sheared("table:" + file);
    scene.calibrate.regime = core::BoxRegime::dry;
    scene.effects.erase("drag");
    return seen(scene, 20);
  };
  core::Scene kinetic = sheared("kinetic");
  kinetic.effects.erase("drag");
  kinetic.tfm.radial_distribution = core::RadialDistribution::carnahan_starling;
  const Seen reference = seen(kinetic, 20), one = written("one.h5", 1, 1, 1), two = written("two.h5", 2, 1, 1),
             four = written("four.h5", 1, 2, 2);
  EXPECT_GT(reference.pressure, 0);
  EXPECT_EQ(one.pressure, reference.pressure);
  EXPECT_NEAR(one.slope, reference.slope, 1e-12 * reference.slope);
  EXPECT_NEAR(two.pressure, 2 * reference.pressure, 1e-12 * reference.pressure);
  EXPECT_NEAR(four.pressure, reference.pressure, 1e-6 * reference.pressure);  // fluctuations by slip are not doubled
  EXPECT_NEAR(four.viscosity, 2 * reference.viscosity, 1e-6 * reference.viscosity);
}

TEST(ShearTable, TheWrongRegimeIsRefusedWithTheNumbers) {
  const test::Scratch scratch;
  const std::string dry = (scratch.path() / "dry.h5").string(), wet = (scratch.path() / "wet.h5").string();
  tfm::write_solids_table(dry, table_of(core::BoxRegime::dry, 1, 1, 1));
  tfm::write_solids_table(wet, table_of(core::BoxRegime::wet, 1, 1, 1));
  core::Scene liquid = sheared("table:" + dry);
  liquid.column.closed = false;
  liquid.inlet.superficial_velocity = {{0, 0.02}};
  core::Timers timers;
  try {
    tfm::Model model(liquid, timers);
    FAIL() << "accepted";
  } catch (const core::CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("gamma tau_p"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("St*"), std::string::npos) << error.what();
  }
  core::Scene gas = liquid;
  gas.fluid.density = 1.2;
  gas.fluid.viscosity = 1.8e-5;
  gas.inlet.superficial_velocity = {{0, 1.0}};
  gas.effects["solids_stress"] = "table:" + wet;
  EXPECT_THROW(tfm::Model(gas, timers), core::CaseError);
  gas.effects["solids_stress"] = "table:" + dry;
  EXPECT_NO_THROW(tfm::Model(gas, timers));
}

// Beyond the table the edge's ratio is held, and told.
TEST(ShearTable, CountsWhatLiesOutside) {
  const test::Scratch scratch;
  const std::string file = (scratch.path() / "wet.h5").string();
  tfm::SolidsTable t = table_of(core::BoxRegime::wet, 1, 1, 1);
  t.phi = {0.1, 0.3};
  tfm::write_solids_table(file, t);
  core::Timers timers;
  tfm::Model model(sheared("table:" + file), timers);
  model.show(0);
  ASSERT_TRUE(model.effects().collisions->use());
  EXPECT_GT(model.effects().collisions->use()->guarded, 0u);
}

}  // namespace
}  // namespace polybed::scenes
