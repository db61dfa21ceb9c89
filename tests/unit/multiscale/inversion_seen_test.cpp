// What particles see of a mixture, and where they balance in it.
#include "multiscale/inversion/seen.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closures/fluid_properties.hpp"
#include "closures/sphere.hpp"
#include "closures/sphere_neighbours.hpp"

namespace polybed::multiscale {
namespace {

constexpr double pi = std::numbers::pi;

/// Cells of 3 x 2 mm in a column 4 mm deep.
const AveragingKernel flat{{3e-3, 2e-3, 4e-3}, {false, false, true}, 0};

// (2/3 / 3 mm) (2/3 / 2 mm) / 4 mm = 1.85185e7 1/m3.
TEST(AveragingKernel, AtItselfHasTheValueByHand) {
  EXPECT_NEAR(kernel_at_itself(flat), 1e9 / 54, 1e-3);
  AveragingKernel all = flat;
  all.wide = {};
  EXPECT_NEAR(kernel_at_itself(all), 1e9 * 8 / 27 / 24, 1e-3);
  // Wide diffusion makes a Gaussian of variance 2 tau + 2 a^2/6 along an axis: its height but for terms of a^4/tau^2.
  AveragingKernel smooth = flat;
  smooth.time = 4e-4;
  const auto height = [&](double a) { return 1 / std::sqrt(2 * pi * (2 * smooth.time + a * a / 3)); };
  EXPECT_NEAR(kernel_at_itself(smooth) / (height(3e-3) * height(2e-3) / 4e-3), 1, 1e-4);
}

// sinc^4(x) = 1 - 2 x^2/3 + ...: 1 - (k^2/12)(a^2 + b^2) + O(k^4) in the mean over directions of a plane.
TEST(AveragingKernel, SpectrumHasTheValuesByHand) {
  EXPECT_DOUBLE_EQ(kernel_spectrum(flat, 0), 1);
  EXPECT_NEAR(kernel_spectrum(flat, 10), 1 - 100 / 12.0 * 13e-6, 1e-7);
  AveragingKernel line = flat;
  line.wide = {true, false, true};
  EXPECT_NEAR(kernel_spectrum(line, pi / 2e-3), std::pow(2 / pi, 4), 1e-12);  // sinc(pi/2)
}

// Cells that are wide against the particles: V_j T_ij K(0) beside the mean, as the particle model's own share has it.
TEST(SeenAverages, OfWideCellsAreThoseOfTheOwnShare) {
  const std::array<double, 2> phi{0.1, 0.08}, d{1e-5, 2.5e-5};
  const auto seen = SeenAverages(flat, d, Neighbours::percus_yevick).fractions(phi);
  const closures::SphereNeighbours around(phi, d);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const double own = closures::sphere_volume(0.5 * d[j]) * around.excess(d[i], d[j], phi[j], i == j);
      // of a kernel that falls by (k a)^2/12 within the reach of the spheres, 1e-4 here
      EXPECT_NEAR((seen[i][j] - phi[j]) / (own * kernel_at_itself(flat)), 1, 2e-3) << i << j;
    }
}

// One size in cells of a tenth of its diameter: it sees itself and, where it is, nobody else.
TEST(SeenAverages, OfSmallCellsAreTheParticleItself) {
  const AveragingKernel small{{1e-4, 1e-4, 1e-4}, {}, 0};
  const std::array<double, 2> phi{0.1, 0.1}, d{1e-3, 1e-3};
  for (const Neighbours neighbours : {Neighbours::kept_out, Neighbours::percus_yevick}) {
    const auto seen = SeenAverages(small, d, neighbours).fractions(phi);
    EXPECT_NEAR(seen[0][1], 0, 0.1 * 2e-2);  // what the cut at 40/a leaves of -1
    EXPECT_NEAR(seen[0][0], closures::sphere_volume(5e-4) * 8 / 27 * 1e12, 2e-3);
  }
}

struct System {
  const char* name;
  BinaryBed bed;
  AveragingKernel kernel;
  double kept_out, percus_yevick;  ///< mm/s
};

BinaryBed bed_of(std::array<double, 2> d, std::array<double, 2> density, std::array<double, 2> number,
                 relevance::FluidConstants fluid) {
  const double a = number[0] * std::pow(d[0], 3), b = number[1] * std::pow(d[1], 3);
  return {d, density, {a / (a + b), b / (a + b)}, fluid, 9.81};
}

// Computed apart from the program, with the exclusion integrated over B-splines in space and Baxter's factors by
// Gauss's rule; two more digits than are asked.
TEST(SeenInversion, IsThatOfASecondComputation) {
  const BinaryBed c = bed_of({0.214e-3, 0.776e-3}, {2450, 1500}, {36584, 696}, {996.59, 0.85e-3});
  BinaryBed c25 = c;
  c25.fluid = {997.05, 0.89e-3};
  const AveragingKernel cells_of_c{{16.8e-3 / 14, 135.9e-3 / 113, 1.6e-3}, {false, false, true}, 0};
  const System systems[] = {{"A",
                             bed_of({0.645e-3, 1.079e-3}, {3950, 2910}, {9938, 2064}, {1070, 0.14}),
                             {{38.106e-3 / 18, 320e-3 / 195, 2.185e-3}, {false, false, true}, 0},
                             1.3616,
                             1.5329},
                            {"B",
                             bed_of({0.807e-3, 2.010e-3}, {1395, 1170}, {20399, 1001}, {999.19, 1.14e-3}),
                             {{60e-3 / 18, 617e-3 / 198, 4.06e-3}, {false, false, true}, 0},
                             31.330,
                             31.817},
                            {"C", c, cells_of_c, 13.186, 13.604},
                            {"C at 25 degC", c25, cells_of_c, 12.713, 13.122},
                            {"small-binary",
                             bed_of({2e-3, 6e-3}, {2500, 1600}, {500, 18}, {1000, 0.03}),
                             {{9.3e-3, 9.3e-3, 12.4e-3}, {false, false, true}, 0},
                             33.437,
                             35.068}};
  const closures::DragLaw cello = closures::drag_law("cello", closures::Guard::on);
  constexpr double quadrature = 1e-3;  // of the second computation: 60 points across an excluded sphere
  for (const System& system : systems)
    for (const auto& [neighbours, expected] : {std::pair(Neighbours::kept_out, system.kept_out),
                                               std::pair(Neighbours::percus_yevick, system.percus_yevick)}) {
      const auto points =
          seen_inversion_points(system.bed, cello, SeenAverages(system.kernel, system.bed.diameter, neighbours));
      ASSERT_EQ(points.size(), 1u) << system.name;
      EXPECT_NEAR(1e3 * points[0].velocity / expected, 1, quadrature) << system.name;
    }
}

}  // namespace
}  // namespace polybed::multiscale
