// The budget of momentum: in a box joined on all sides, without gravity, nothing may change the sum over phases.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "scenes/box_equations.hpp"
#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// The second species is thin, but nowhere below the floors.
core::Scene joined(int dimensions, int cells) {
  core::Scene scene = two_species_box(dimensions, cells, 0.05, 1e-3, 1e-3);
  scene.column.gravity = 0;
  scene.bed.volume_share = {0.75, 0.25};
  return scene;
}

class Box : public BoxEquations {
 public:
  Box(const core::Scene& scene, tfm::Scheme momentum)
      : BoxEquations(scene, joined_box(scene), {tfm::Scheme::limited, momentum, fluid::WallSlip::free_slip}, 1e-12) {}

  /// Waves of fractions and of velocities that run across each other. J is that of an even flow: free of divergence.
  std::vector<double> waves() const {
    const core::Grid& grid = constants().grid;
    tfm::Fields value(constants());
    const double k = 2 * std::numbers::pi / (grid.spacing[0] * grid.cells[0]);
    for (int z = 0; z < grid.cells[2]; ++z)
      for (int y = 0; y < grid.cells[1]; ++y)
        for (int x = 0; x < grid.cells[0]; ++x) {
          const auto c = std::size_t(grid.index(x, y, z));
          const double a = k * grid.centre(0, x), b = k * grid.centre(1, y), d = k * grid.centre(2, z);
          for (std::size_t j = 0; j < 2; ++j) {
            const double sign = j == 0 ? 1 : -1;
            value.solids.fraction[j][c] = (j == 0 ? 0.24 : 0.08) * (1 + 0.6 * sign * std::sin(a + 2 * b));
            for (std::size_t axis = 0; axis < std::size_t(grid.dimensions); ++axis)
              value.solids.velocity[j][axis][c] = 0.1 * sign * std::sin(a - b + d + double(axis));
          }
          for (std::size_t axis = 0; axis < std::size_t(grid.dimensions); ++axis)
            value.fluid.flux[axis][c] = 0.05 * double(axis + 1);
        }
    std::vector<double> y(layout().size());
    layout().pack(value.solids, value.fluid, y);
    return y;
  }

  /// Momentum along each axis and what changes it, per volume.
  struct Budget {
    std::array<double, 3> momentum{}, rate{}, scale{};
    /// Greatest rate relative to the sum of its parts' magnitudes.
    [[nodiscard]] double imbalance() const {
      double worst = 0;
      for (std::size_t a = 0; a < 3; ++a)
        if (scale[a] > 0) worst = std::max(worst, std::abs(rate[a]) / scale[a]);
      return worst;
    }
  };
  Budget budget(std::vector<double> y) {
    std::vector<double> dydt(y.size());
    EXPECT_EQ(rates(0, y, dydt), core::Rate::ok);
    Budget sum;
    for (int axis = 0; axis < constants().grid.dimensions; ++axis)
      core::for_each_row(constants().grid, [&](core::Index begin, core::Index end) {
        for (core::Index c = begin; c < end; ++c) add_face(axis, c, sum);
      });
    return sum;
  }

 protected:
  void add(tfm::Fields&) override {}

 private:
  /// The fluid's momentum is rho_f (J - sum phi_j U_j), by the definition of J.
  void add_face(int axis, core::Index c, Budget& sum) {
    const auto a = std::size_t(axis), f = std::size_t(c);
    const core::Index s = constants().grid.stride(axis);
    const tfm::Fields& now = fields();
    const double rho_f = constants().fluid.density;
    const auto count = [&](double momentum, double rate) {
      sum.momentum[a] += momentum;
      sum.rate[a] += rate;
      sum.scale[a] += std::abs(rate);
    };
    count(rho_f * now.fluid.flux[a][f], rho_f * now.flux_rate.free[a][f]);
    for (std::size_t j = 0; j < 2; ++j) {
      const double phi = core::face_mean(now.solids.fraction[j].data(), c, s), u = now.solids.velocity[j][a][f],
                   phi_rate = core::face_mean(now.solids.fraction_rate[j].data(), c, s),
                   excess = constants().density[j] - rho_f;
      count(excess * phi * u, excess * (phi_rate * u + phi * now.solids.acceleration[j][a][f]));
    }
  }
};

double imbalance(int dimensions, int cells, tfm::Scheme momentum,
                 const std::map<std::string, std::string>& besides = {}) {
  core::Scene scene = joined(dimensions, cells);
  scene.effects.insert(besides.begin(), besides.end());
  Box box(scene, momentum);
  return box.budget(box.waves()).imbalance();
}

// What is left is round-off of some thousand faces and the pressure's tolerance of 1e-12, which is all of div J.
TEST(MomentumBudget, ClosesInSpace) {
  for (const tfm::Scheme scheme : {tfm::Scheme::upwind, tfm::Scheme::limited})
    for (const int dimensions : {2, 3}) {
      const double left = imbalance(dimensions, 12, scheme);
      record(fmt::format("left over, {}-D, {}", dimensions, scheme == tfm::Scheme::limited ? "limited" : "upwind"),
             left);
      EXPECT_LT(left, 1e-12) << dimensions;
    }
}

// What lift and added mass give to the solids they take from the fluid, in the same cells.
TEST(MomentumBudget, ClosesWithLiftAndAddedMass) {
  for (const std::map<std::string, std::string>& besides : {std::map<std::string, std::string>{{"lift", "saffman_mei"}},
                                                            {{"added_mass", "zuber"}},
                                                            {{"lift", "saffman_mei"}, {"added_mass", "half"}}})
    for (const int dimensions : {2, 3}) {
      const double left = imbalance(dimensions, 12, tfm::Scheme::limited, besides);
      record(fmt::format("left over, {}-D, {}", dimensions, besides.size() == 2 ? "both" : besides.begin()->first),
             left);
      EXPECT_LT(left, 1e-12) << dimensions << besides.begin()->first;
    }
}

// In time phi U is a product of unknowns: the sum is kept to the tolerance, 1e-7 of it.
TEST(MomentumBudget, IsKeptInTimeToTheTolerance) {
  Box box(joined(2, 16), tfm::Scheme::upwind);
  std::vector<double> y = box.waves();
  const Box::Budget begin = box.budget(y);
  box.advance(y, 0.02, 1e-7);
  const Box::Budget end = box.budget(y);
  double lost = 0;
  for (std::size_t a = 0; a < 2; ++a) lost = std::max(lost, std::abs(end.momentum[a] / begin.momentum[a] - 1));
  record("lost in 20 ms", lost);
  EXPECT_LT(lost, 1e-6);  // some tens of steps of 1e-7
}

}  // namespace
}  // namespace polybed::scenes
