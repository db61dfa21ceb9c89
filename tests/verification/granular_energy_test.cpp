// The budget of energy of colliding solids: what their stress takes from the mean motion is what collisions lose.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "box_equations.hpp"
#include "closures/kinetic_theory.hpp"

namespace polybed::verification {
namespace {

constexpr double diameter = 1e-3, density = 2500, restitution = 0.9;

/// Grains in next to nothing of a fluid, whose slip and drag add nothing.
core::Scene grains(double solids, const std::string& stress) {
  core::Scene scene = uniform_bed(diameter, density, 1e-3, 1e-9, solids, 12, 0.06);
  scene.column.size = {0.06, 0.06, 0.005};
  scene.column.cells = {12, 12, 1};
  scene.column.gravity = 0;
  scene.species[0].restitution = restitution;
  scene.effects = {{"solids_stress", stress}};
  if (stress == "kinetic") scene.effects["granular_temperature"] = "algebraic";
  scene.tfm.kinetic_theory = "lun";
  scene.tfm.radial_distribution = "carnahan_starling";
  scene.tfm.max_packing = "0.64";
  return scene;
}

class Grains : public BoxEquations {
 public:
  explicit Grains(const core::Scene& scene)
      : BoxEquations(scene, joined_box(scene),
                     {tfm::Scheme::upwind, tfm::Scheme::upwind, fluid::WallSlip::free_slip, true}, 1e-10) {}

  /// Grains that are compressed here, expand there and are sheared, evenly many everywhere.
  std::vector<double> waves(double solids) const {
    const core::Grid& grid = constants().grid;
    tfm::Fields value(constants());
    const double k = 2 * std::numbers::pi / (grid.spacing[0] * grid.cells[0]);
    for (int y = 0; y < grid.cells[1]; ++y)
      for (int x = 0; x < grid.cells[0]; ++x) {
        const auto c = std::size_t(grid.index(x, y));
        const double a = k * grid.centre(0, x), b = k * grid.centre(1, y);
        value.solids.fraction[0][c] = solids;
        value.solids.velocity[0][0][c] = std::sin(a) + 0.3 * std::sin(2 * b + 1);
        value.solids.velocity[0][1][c] = 0.5 * std::sin(a + b) + 0.2 * std::cos(2 * b);
      }
    std::vector<double> state(layout().size());
    layout().pack(value.solids, value.fluid, state);
    return state;
  }

  /// Accelerations of the solids before the pressure.
  core::FaceField accelerations(double solids) {
    std::vector<double> y = waves(solids), dydt(y.size());
    EXPECT_EQ(rates(0, y, dydt), core::Rate::ok);
    return free_;
  }

 protected:
  void add(tfm::Fields& fields) override { free_ = fields.solids.acceleration[0]; }

 private:
  core::FaceField free_;
};

/// What the stress takes from the mean motion, and what collisions take from fluctuations, both W/m3.
struct Budget {
  double taken = 0, lost = 0;
};

Budget budget(double solids) {
  Grains with(grains(solids, "kinetic")), without(grains(solids, "none"));
  const core::FaceField all = with.accelerations(solids), rest = without.accelerations(solids);
  const core::Grid& grid = with.constants().grid;
  const double phi = std::max(solids, 0.01);  // collisions are evaluated at no less
  const double g0 = closures::radial_carnahan_starling(phi).value;
  const double loss =
      closures::kinetic_dissipation(closures::KineticModel::lun, phi, g0, restitution) * density / (diameter * phi);
  Budget sum;
  core::for_each_row(grid, [&](core::Index begin, core::Index end) {
    for (auto c = std::size_t(begin); c < std::size_t(end); ++c) {
      for (std::size_t a = 0; a < 2; ++a)
        sum.taken -= solids * density * with.fields().solids.velocity[0][a][c] * (all[a][c] - rest[a][c]);
      sum.lost += solids * loss * std::pow(with.fields().solids.temperature[0][c], 1.5);
    }
  });
  return sum;
}

// In the algebraic balance nothing is stored: what is taken is lost. Below a solids fraction of 0.01 pressure,
// viscosity and what they do to the temperature must fade together, or grains that fly apart are driven by what they do
// not lose. Tolerance: the viscous force is divided by phi + 1e-4.
TEST(GranularEnergy, IsTakenFromTheMeanMotionAndLostByCollisions) {
  for (const double solids : {0.002, 0.005, 0.02, 0.1, 0.4}) {
    const Budget sum = budget(solids);
    record(fmt::format("taken over lost, solids fraction {}", solids), sum.taken / sum.lost);
    EXPECT_GT(sum.lost, 0);
    EXPECT_NEAR(sum.taken / sum.lost, 1, 1.5e-4 / solids) << solids;
  }
}

}  // namespace
}  // namespace polybed::verification
