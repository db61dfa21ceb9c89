// The budget of energy of colliding solids: what their stress takes from the mean motion is what collisions lose.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "closures/kinetic_theory.hpp"
#include "scenes/box_equations.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

constexpr double restitution = 0.9;
constexpr std::array<double, 2> diameter{1e-3, 1.5e-3}, density{2500, 2000};

/// Grains in next to nothing of a fluid, whose slip and drag add nothing.
core::Scene grains(double solids, std::size_t species, const std::string& stress) {
  core::Scene scene = uniform_bed(diameter[0], density[0], 1e-3, 1e-9, solids, 12, 0.06);
  scene.column.size = {0.06, 0.06, 0.005};
  scene.column.cells = {12, 12, 1};
  scene.column.gravity = 0;
  scene.species[0].restitution = restitution;
  if (species == 2) {
    scene.species.push_back(scene.species[0]);
    scene.species[1].name = "second";
    scene.species[1].diameter = diameter[1];
    scene.species[1].density = density[1];
    scene.bed.volume_share = {0.6, 0.4};
  }
  scene.effects = {{"solids_stress", stress}};
  if (stress == "kinetic") scene.effects["granular_temperature"] = "algebraic";
  scene.tfm.kinetic_theory = core::KineticTheory::lun;
  scene.tfm.radial_distribution = core::RadialDistribution::carnahan_starling;
  scene.tfm.max_packing = 0.64;
  return scene;
}

class Grains : public BoxEquations {
 public:
  explicit Grains(const core::Scene& scene)
      : BoxEquations(scene, joined_box(scene), {tfm::Scheme::upwind, tfm::Scheme::upwind, fluid::WallSlip::free_slip},
                     1e-10) {}

  /// Grains that are compressed here, expand there and are sheared, each species in its own way. \param uneven  of
  /// the solids fraction, from cell to cell: 1 leaves every other cell along a diagonal without solids
  std::vector<double> waves(double solids, double uneven) const {
    const core::Grid& grid = constants().grid;
    tfm::Fields value(constants());
    const double k = 2 * std::numbers::pi / (grid.spacing[0] * grid.cells[0]);
    for (int y = 0; y < grid.cells[1]; ++y)
      for (int x = 0; x < grid.cells[0]; ++x) {
        const auto c = std::size_t(grid.index(x, y));
        const double a = k * grid.centre(0, x), b = k * grid.centre(1, y);
        for (std::size_t j = 0; j < constants().species(); ++j) {
          const double turn = 2.0 * double(j);
          value.solids.fraction[j][c] = constants().bed_share[j] * solids * (1 + uneven * std::sin(a + 2 * b + turn));
          value.solids.velocity[j][0][c] = std::sin(a + turn) + 0.3 * std::sin(2 * b + 1);
          value.solids.velocity[j][1][c] = 0.5 * std::sin(a + b) + 0.2 * std::cos(2 * b - turn);
        }
      }
    std::vector<double> state(layout().size());
    layout().pack(value.solids, value.fluid, state);
    return state;
  }

  /// Accelerations of the solids before the pressure, by species.
  std::vector<core::FaceField> accelerations(double solids, double uneven) {
    std::vector<double> y = waves(solids, uneven), dydt(y.size());
    EXPECT_EQ(rates(0, y, dydt), core::Rate::ok);
    return free_;
  }

 protected:
  void add(tfm::Fields& fields) override { free_ = fields.solids.acceleration; }

 private:
  std::vector<core::FaceField> free_;
};

/// What the stress takes from the mean motion, and what collisions take from fluctuations, both W/m3.
struct Budget {
  double taken = 0, lost = 0;
};

/// g0_j = sum_k x_k g_jk in a cell.
double radial(const tfm::Constants& constants, const tfm::Fields& fields, std::size_t j, std::size_t c, double phi) {
  double surface = 0, sum = 0;
  for (std::size_t k = 0; k < constants.species(); ++k) surface += fields.share[k][c] * phi / constants.diameter[k];
  for (std::size_t k = 0; k < constants.species(); ++k)
    sum +=
        fields.share[k][c] * closures::radial_of_pair(1 - phi, surface, constants.diameter[j], constants.diameter[k]);
  return sum;
}

Budget budget(double solids, std::size_t species, double uneven) {
  Grains with(grains(solids, species, "kinetic")), without(grains(solids, species, "none"));
  const auto all = with.accelerations(solids, uneven), rest = without.accelerations(solids, uneven);
  const core::Grid& grid = with.constants().grid;
  const tfm::Fields& fields = with.fields();
  Budget sum;
  core::for_each_row(grid, [&](core::Index begin, core::Index end) {
    for (core::Index f = begin; f < end; ++f) {
      const auto c = std::size_t(f);
      const double phi = std::max(fields.solids_fraction[c], 0.01);  // collisions are evaluated at no less
      for (std::size_t j = 0; j < species; ++j) {
        const core::Field& own = fields.solids.fraction[j];
        for (int a = 0; a < 2; ++a)
          sum.taken -= core::face_mean(own.data(), f, grid.stride(a)) * density[j] *
                       fields.solids.velocity[j][std::size_t(a)][c] *
                       (all[j][std::size_t(a)][c] - rest[j][std::size_t(a)][c]);
        const double loss = closures::kinetic_dissipation(closures::KineticModel::lun, phi,
                                                          radial(with.constants(), fields, j, c, phi), restitution);
        sum.lost += own[c] * loss * density[j] / (diameter[j] * phi) * std::pow(fields.solids.temperature[j][c], 1.5);
      }
    }
  });
  return sum;
}

// In the algebraic balance nothing is stored: what is taken is lost. Below a solids fraction of 0.01 pressure,
// viscosity and what they do to the temperature must fade together, or grains that fly apart are driven by what they do
// not lose. Tolerance: the viscous force is divided by phi + 1e-4.
TEST(GranularEnergy, IsTakenFromTheMeanMotionAndLostByCollisions) {
  for (const double solids : {0.002, 0.005, 0.02, 0.1, 0.4}) {
    const Budget sum = budget(solids, 1, 0);
    record(fmt::format("taken over lost, solids fraction {}", solids), sum.taken / sum.lost);
    EXPECT_GT(sum.lost, 0);
    EXPECT_NEAR(sum.taken / sum.lost, 1, 1.5e-4 / solids) << solids;
  }
}

// The same of two species that move and are spread each in its own way, and where the solids end from cell to cell.
TEST(GranularEnergy, OfTwoSpeciesAndOfUnevenSolidsIsKeptToo) {
  for (const std::size_t species : {1U, 2U})
    for (const double uneven : {0.5, 0.9}) {
      constexpr double solids = 0.2;
      const Budget sum = budget(solids, species, uneven);
      record(fmt::format("taken over lost, {} species, uneven by {}", species, uneven), sum.taken / sum.lost);
      EXPECT_NEAR(sum.taken / sum.lost, 1, 1.5e-4 / (solids * (1 - uneven))) << species << " " << uneven;
    }
}

}  // namespace
}  // namespace polybed::scenes
