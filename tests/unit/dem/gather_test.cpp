// What particles see of the fluid's fields, and that giving and taking are each other's transpose.
#include "dem/coupling/gather.hpp"

#include <gtest/gtest.h>

#include <random>

#include "cloud.hpp"
#include "dem/coupling/scatter.hpp"

namespace polybed::dem::test {
namespace {

constexpr std::size_t number = 300;

core::FaceField random_faces(const core::Grid& grid, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  core::FaceField field = core::make_face_field(grid);
  for (core::Field& component : field)
    for (double& x : component) x = value(random);
  return field;
}

// sum_f psi S_f X_f = sum_p I_p . X(x_p): the fluid loses the very work that particles gain.
TEST(Gather, IsTheTransposeOfScatter) {
  for (const int dimensions : {2, 3})
    for (const bool periodic : {false, true}) {
      Cloud cloud(cloud_scene(dimensions, periodic), number);
      Scatter scatter(cloud.grid, cloud.grid, cloud.materials, false, cloud.volume, 0.2);
      fluid::ParticlePhase phase(cloud.grid, false);
      std::vector<core::Field> fraction(2, core::make_field(cloud.grid));
      scatter.collect(cloud.particles, cloud.loads, 1e-3);
      scatter.give(nullptr, nullptr, false, phase, fraction);
      const core::FaceField x = random_faces(cloud.grid, 11);
      const Gather gather(cloud.grid, {0.5e-3, 1.1e-3});
      for (std::size_t a = 0; a < std::size_t(dimensions); ++a) {
        double given = 0, taken = 0, scale = 0;
        for (std::size_t c = 0; c < x[a].size(); ++c) given += phase.impulse[a][c] * x[a][c] * cloud.grid.cell_volume();
        for (std::size_t i = 0; i < number; ++i) {
          const double work = cloud.loads[i].impulse[a] * gather.vector(gather.lines(cloud.particles.place[i].x), x)[a];
          taken += work;
          scale += std::abs(cloud.loads[i].impulse[a]);
        }
        EXPECT_NEAR(given, taken, 1e-13 * scale);  // a few hundred terms of round-off, and whole units of 1e-17
        EXPECT_GT(scale, 0);
      }
    }
}

/// A + B.x, evaluated where each face stands.
double linear(const Vector& x, std::size_t component) {
  return 0.3 + double(component) + 40 * x[0] - 25 * x[1] + 60 * x[2] * (component == 2 ? -1 : 1);
}

// Away from walls, where no share is folded back.
TEST(Gather, ReproducesLinearFields) {
  Cloud cloud(cloud_scene(3, false));
  const core::Grid& grid = cloud.grid;
  core::FaceField field = core::make_face_field(grid);
  for (int axis = 0; axis < 3; ++axis)
    core::for_each_row(grid, core::owned_faces(grid, axis), [&](core::Index begin, core::Index end) {
      for (core::Index f = begin; f < end; ++f) {
        const core::Index i = f % grid.extent(0) - 2, j = f / grid.extent(0) % grid.extent(1) - 2,
                          k = f / grid.stride(2) - 2;
        Vector x{grid.centre(0, int(i)), grid.centre(1, int(j)), grid.centre(2, int(k))};
        x[std::size_t(axis)] -= 0.5 * grid.spacing[std::size_t(axis)];
        field[std::size_t(axis)][std::size_t(f)] = linear(x, std::size_t(axis));
      }
    });
  Gather gather(grid, {0.5e-3, 1.1e-3});
  gather.take({core::make_field(grid), core::make_field(grid)}, field, field);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> place(1e-3, 7e-3);
  for (int n = 0; n < 100; ++n) {
    const Vector x{place(random), place(random), place(random)};
    const Stream stream = gather.stream(gather.lines(x));
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(stream.velocity[k], linear(x, k), 1e-14);
      EXPECT_NEAR(stream.gradient[k], linear(x, k), 1e-14);
    }
  }
}

// By hand: a quarter of the way from a cell with phi (0.2, 0.1) to one with (0, 0.4).
TEST(Gather, SeesTheMixtureAround) {
  Cloud cloud(cloud_scene(2, false));
  const core::Grid& grid = cloud.grid;
  std::vector<core::Field> fraction(2, core::make_field(grid));
  fraction[0][std::size_t(grid.index(2, 2))] = 0.2;
  fraction[1][std::size_t(grid.index(2, 2))] = 0.1;
  fraction[1][std::size_t(grid.index(3, 2))] = 0.4;
  Gather gather(grid, {0.5e-3, 1.1e-3});
  gather.take(fraction, core::make_face_field(grid), core::make_face_field(grid));
  const Lines at = gather.lines({5.5e-3, 5e-3, 1e-3});
  const double fine = 0.75 * 0.2, coarse = 0.75 * 0.1 + 0.25 * 0.4;
  const Surroundings first = gather.solids(at, 0), second = gather.solids(at, 1);
  EXPECT_NEAR(first.fraction, fine + coarse, 1e-15);
  EXPECT_NEAR(first.own, fine, 1e-15);
  EXPECT_NEAR(second.own, coarse, 1e-15);
  EXPECT_NEAR(first.per_mean, fine / 0.5e-3 + coarse / 1.1e-3, 1e-12);  // of 500
  EXPECT_NEAR(first.average, fine * 0.5e-3 + coarse * 1.1e-3, 1e-18);
}

}  // namespace
}  // namespace polybed::dem::test
