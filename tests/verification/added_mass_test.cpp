// Added mass in the continuum: accelerations in closed form, and solids lighter than the fluid, which no lagged force
// survives.
#include <gtest/gtest.h>

#include <algorithm>

#include "closures/added_mass.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

constexpr double rho_f = 1000, g = 9.81;

/// Solids at rest in a closed column, filled evenly, whose drag is too small to be felt.
core::Scene released(double density, double fraction, const std::string& integrator, const std::string& law,
                     bool form_b) {
  core::Scene scene = uniform_bed(1e-3, density, rho_f, 1e-9, fraction, 20, 0.2);
  scene.column.closed = true;
  scene.effects = {{"drag", "stokes"}, {"added_mass", law}};
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.tfm.form = form_b ? core::PressureForm::B : core::PressureForm::A;
  scene.tfm.rtol = 1e-5;
  return scene;
}

/// Velocity half-way up after 1 ms over that time, m/s2: nothing has come from the ends, and no convection.
double acceleration(const core::Scene& scene) {
  core::Timers timers;
  tfm::Model model(scene, timers);
  constexpr double until = 1e-3;
  advance(model, until);
  return model.fields().solids.velocity[0][1][std::size_t(model.constants().grid.index(0, 10))] / until;
}

using Case = std::tuple<std::string, double>;

class AddedMass : public testing::TestWithParam<Case> {};

// One particle: (rho_f - rho_p) g/(rho_p + C_m rho_f), C_m 1/2. 0.1 %, of which the fraction of 1e-5 takes 1e-5.
TEST_P(AddedMass, OneParticleIsReleased) {
  const auto [integrator, density] = GetParam();
  for (const bool form_b : {false, true}) {
    const double exact = (rho_f - density) * g / (density + 0.5 * rho_f);
    const double found = acceleration(released(density, 1e-5, integrator, "half", form_b));
    if (exact != 0) record("relative error", found / exact - 1);
    EXPECT_NEAR(found, exact, 1e-3 * std::abs(exact) + 1e-9) << form_b;
  }
}

// A suspension that fills a closed column, J = 0: by elimination of G and a_f = -phi a_p/eps
//   a_p [rho_p + rho_f phi/eps + C rho_f/eps^2] = (rho_f - rho_p) g,   C = (1 + 2 phi)/(2 eps).
// rtol 1e-5 in velocities that grow evenly.
TEST_P(AddedMass, ASuspensionIsReleased) {
  const auto [integrator, density] = GetParam();
  const double phi = 0.3, eps = 0.7, c = closures::added_mass_zuber(phi);
  const double exact = (rho_f - density) * g / (density + rho_f * phi / eps + c * rho_f / (eps * eps));
  const double found = acceleration(released(density, phi, integrator, "zuber", false));
  if (exact != 0) record("relative error", found / exact - 1);
  EXPECT_NEAR(found, exact, 1e-4 * std::abs(exact) + 1e-9);
}

/// A bed of two species, the first as dense as asked for, in a closed box.
core::Scene let_go(const std::string& integrator, double density) {
  core::Scene scene = two_species_box(2, 10, 0.03, 1e-3, 1e-3);
  scene.column.closed = true;
  scene.column.sides = core::Boundary::wall;
  scene.species[0].density = density;
  scene.species[1].density = 1500;
  scene.bed.volume_share = {0.5, 0.5};
  scene.effects["added_mass"] = "zuber";
  scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
  scene.tfm.rtol = 1e-3;
  return scene;
}

// Solids as dense as the fluid and lighter, to a tenth: 0.3 s from an uneven start. Speeds stay below twice sqrt(g H),
// which a body gains by falling through the whole box twice; volumes are kept to round-off.
TEST_P(AddedMass, LightSolidsAreNoTrouble) {
  const auto [integrator, density] = GetParam();
  const core::Scene scene = let_go(integrator, density);
  core::Timers timers;
  tfm::Model model(scene, timers);
  make_uneven(model, [](int i, int j, int) { return 1 - 0.02 * ((3 * i + 5 * j) % 7); });
  model.show(0);
  const core::Grid& grid = model.constants().grid;
  const std::vector<double> before = measures::species_volumes(grid, model.fields().solids);
  advance(model, 0.3);
  const std::vector<double> after = measures::species_volumes(grid, model.fields().solids);
  double fastest = 0;
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(after[j] / before[j], 1, 1e-12);
    for (const core::Field& u : model.fields().solids.velocity[j])
      for (const double v : u) fastest = std::max(fastest, std::isfinite(v) ? std::abs(v) : 1e300);
  }
  record("fastest, m/s", fastest);
  record("steps", double(model.work().steps));
  EXPECT_LT(fastest, 2 * std::sqrt(g * 0.03));
  EXPECT_GT(fastest, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Integrators, AddedMass,
                         testing::Combine(testing::Values(std::string("explicit"), std::string("imex"),
                                                          std::string("implicit")),
                                          testing::Values(1500.0, 1000.0, 500.0, 100.0)));

// What the integrators share is the operator; each keeps its error near 1e-6 per step.
TEST(AddedMassIntegrators, AgreeAtTightTolerance) {
  const auto run = [](const std::string& integrator) {
    core::Scene scene = binary_bed(6, 40, 0.018, 0.12);
    scene.bed.start_solids_fraction = 0.45;
    scene.effects["added_mass"] = "zuber";
    scene.effects["lift"] = "saffman_mei";
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    scene.tfm.rtol = 1e-6;
    core::Timers timers;
    tfm::Model model(scene, timers);
    advance(model, 0.1);
    return std::pair(model.fields().solids.fraction[0], model.constants().grid);
  };
  const auto [by_steps, grid] = run("explicit");
  for (const char* other : {"imex", "implicit"}) {
    const double apart = distance(grid, by_steps, run(other).first);
    record(std::string("distance of ") + other, apart);
    EXPECT_LT(apart, 1e-4) << other;  // a hundred times 1e-6
  }
}

}  // namespace
}  // namespace polybed::scenes
