// Lift in the continuum: the closure's force of a flow of even shear, and its opposite on the fluid, face by face.
#include "tfm/particle_forces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closures/lift_saffman_mei.hpp"
#include "core/numerics/operators.hpp"
#include "scenes/beds.hpp"
#include "tfm/effects.hpp"

namespace polybed::tfm {
namespace {

/// A box of two species, fractions 0.2 and 0.1, in a flow U_f = U_0 + A x past solids that move evenly.
struct Shear {
  static constexpr double from[3] = {0.03, 0.05, -0.02}, slope[3][3] = {{0.5, -2, 1}, {3, -0.4, 0.7}, {-1.5, 2, 0.3}},
                          solid[2][3] = {{0.01, -0.02, 0.015}, {0.04, 0.06, 0.01}};
  core::Scene scene;
  Constants constants;
  fluid::Boundaries boundaries;
  Fields fields;
  Effects effects;

  Shear(int dimensions, bool form_b)
      : scene(with_lift(dimensions, form_b)),
        constants(constants_of(scene)),
        boundaries(constants.grid, fluid::Ends::walls),
        fields(constants),
        effects(make_effects(scene, constants, boundaries, fields)) {
    const core::Grid& grid = constants.grid;
    const auto n = std::size_t(grid.dimensions);
    for (std::size_t j = 0; j < 2; ++j) {
      std::fill(fields.solids.fraction[j].begin(), fields.solids.fraction[j].end(), j == 0 ? 0.2 : 0.1);
      for (std::size_t a = 0; a < n; ++a)
        std::fill(fields.solids.velocity[j][a].begin(), fields.solids.velocity[j][a].end(), solid[j][a]);
    }
    std::fill(fields.fluid.voidage.begin(), fields.fluid.voidage.end(), 0.7);
    for (int k = -grid.ghosts(2); k < grid.cells[2] + grid.ghosts(2); ++k)
      for (int j = -grid.ghosts(1); j < grid.cells[1] + grid.ghosts(1); ++j)
        for (int i = -grid.ghosts(0); i < grid.cells[0] + grid.ghosts(0); ++i)
          for (std::size_t a = 0; a < n; ++a) {
            std::array<double, 3> at{grid.centre(0, i), grid.centre(1, j), n < 3 ? 0 : grid.centre(2, k)};
            at[a] -= 0.5 * grid.spacing[a];
            fields.fluid.velocity[a][std::size_t(grid.index(i, j, k))] = flow(a, at);
          }
  }
  [[nodiscard]] double flow(std::size_t a, const std::array<double, 3>& at) const {
    double u = from[a];
    for (std::size_t d = 0; d < std::size_t(constants.grid.dimensions); ++d) u += slope[a][d] * at[d];
    return u;
  }
  /// By the closure at a point, N/m3 of the species.
  [[nodiscard]] std::array<double, 3> expected(std::size_t j, const std::array<double, 3>& at) const {
    const bool deep = constants.grid.dimensions == 3;
    const closures::Vec3 omega{deep ? slope[2][1] - slope[1][2] : 0, deep ? slope[0][2] - slope[2][0] : 0,
                               slope[1][0] - slope[0][1]},
        slip{flow(0, at) - solid[j][0], flow(1, at) - solid[j][1], deep ? flow(2, at) - solid[j][2] : 0};
    const double d = constants.diameter[j], volume = std::numbers::pi / 6 * d * d * d;
    const closures::Vec3 force = closures::lift_saffman_mei(slip, omega, d, constants.fluid.density,
                                                            constants.fluid.viscosity, closures::lift_least_shear_mei);
    return {force.x / volume, force.y / volume, force.z / volume};
  }

 private:
  static core::Scene with_lift(int dimensions, bool form_b) {
    core::Scene scene = scenes::two_species_box(dimensions, 5, 0.02, 1e-3, 1e-3);
    scene.effects["lift"] = "saffman_mei";
    if (form_b) scene.tfm.form = core::PressureForm::B;
    return scene;
  }
  static Constants constants_of(const core::Scene& scene) {
    core::Timers timers;
    return Model(scene, timers).constants();
  }
};

class Lift : public testing::TestWithParam<std::tuple<int, bool>> {};

// Differences across a cell and means are exact in an even shear: round-off of some tens of sums.
TEST_P(Lift, IsThatOfTheClosureInEvenShear) {
  const auto [dimensions, form_b] = GetParam();
  Shear now(dimensions, form_b);
  ASSERT_EQ(now.effects.forces.size(), 1u);
  const core::Grid& grid = now.constants.grid;
  for (int axis = 0; axis < dimensions; ++axis) {
    const auto a = std::size_t(axis);
    for (core::Field& force : now.fields.force.on_solids) std::fill(force.begin(), force.end(), 0.0);
    now.effects.forces[0]->add(axis, now.fields);
    for (std::size_t species = 0; species < 2; ++species)
      for (const int i : {1, 2, 4})
        for (const int j : {1, 4}) {
          const int k = dimensions == 3 ? 3 : 0;
          std::array<double, 3> at{grid.centre(0, i), grid.centre(1, j), dimensions == 3 ? grid.centre(2, k) : 0};
          at[a] -= 0.5 * grid.spacing[a];
          const auto force = now.expected(species, at);
          const double size = std::hypot(force[0], force[1], force[2]);
          EXPECT_GT(size, 1) << "N/m3: nothing acts, so nothing is compared";
          EXPECT_NEAR(now.fields.force.on_solids[species][std::size_t(grid.index(i, j, k))], force[a], 1e-11 * size);
        }
  }
}

// Streams that rise faster in every second column, past solids at rest: between two columns the force points into the
// faster stream, by the closure with their difference over the width of a cell.
TEST(LiftOnFaces, SeesStreamsThatAlternateFromColumnToColumn) {
  Shear now(2, false);
  const core::Grid& grid = now.constants.grid;
  core::FaceField& u = now.fields.fluid.velocity;
  for (core::FaceField& v : now.fields.solids.velocity) v = core::make_face_field(grid);
  std::fill(u[0].begin(), u[0].end(), 0.0);
  for (int j = -grid.ghosts(1); j < grid.cells[1] + grid.ghosts(1); ++j)
    for (int i = -grid.ghosts(0); i < grid.cells[0] + grid.ghosts(0); ++i)
      u[1][std::size_t(grid.index(i, j))] = i % 2 == 0 ? 0.05 : 0.03;
  now.effects.forces[0]->add(0, now.fields);
  for (std::size_t species = 0; species < 2; ++species) {
    const double d = now.constants.diameter[species];
    const double expected = closures::lift_saffman_mei({0, 0.04, 0}, {0, 0, 0.02 / grid.spacing[0]}, d,
                                                       now.constants.fluid.density, now.constants.fluid.viscosity)
                                .x /
                            (std::numbers::pi / 6 * d * d * d);
    EXPECT_GT(expected, 1);
    for (const int i : {1, 2, 3, 4})
      EXPECT_NEAR(now.fields.force.on_solids[species][std::size_t(grid.index(i, 2))], i % 2 == 0 ? expected : -expected,
                  1e-12 * expected);
  }
}

TEST_P(Lift, IsTakenFromTheFluidOnEachFace) {
  const auto [dimensions, form_b] = GetParam();
  Shear now(dimensions, form_b);
  const core::Grid& grid = now.constants.grid;
  for (int axis = 0; axis < dimensions; ++axis) {
    const auto a = std::size_t(axis);
    for (core::Field& force : now.fields.force.on_solids) std::fill(force.begin(), force.end(), 0.0);
    now.effects.forces[0]->add(axis, now.fields);
    const Fields before = now.fields;
    share_particle_forces(now.constants, now.boundaries, axis, now.fields);
    double greatest = 0, held = 0;
    core::for_each_row(grid, core::owned_faces(grid, axis), [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c) {
        const auto f = std::size_t(c);
        double sum = 0.7 * now.constants.fluid.density * now.fields.fluid_acceleration[a][f], size = std::abs(sum);
        for (std::size_t j = 0; j < 2; ++j) {
          const double part = (j == 0 ? 0.2 : 0.1) * now.constants.density[j] * now.fields.solids.acceleration[j][a][f];
          sum += part;
          size += std::abs(part);
        }
        EXPECT_NEAR(sum, 0, 1e-15 * size);  // round-off of three products
        greatest = std::max(greatest, size);
      }
    });
    EXPECT_GT(greatest, 1);
    for (int side : {0, 1})  // on walls nothing moves
      fluid::for_each_boundary_row(grid, axis, side, [&](core::Index begin, core::Index end) {
        for (core::Index c = begin; c < end; ++c)
          held = std::max(held, std::abs(now.fields.fluid_acceleration[a][std::size_t(c)]));
      });
    EXPECT_EQ(held, 0);
    // In form B with the gradient that the reaction makes.
    const auto face = std::size_t(grid.index(2, 2, dimensions == 3 ? 2 : 0));
    const auto on = [&](std::size_t j) { return before.force.on_solids[j][face]; };
    const double gradient = form_b ? (0.2 * on(0) + 0.1 * on(1)) / 0.7 : 0;
    for (std::size_t j = 0; j < 2; ++j)
      EXPECT_NEAR(now.fields.solids.acceleration[j][a][face] * now.constants.density[j], on(j) + gradient,
                  1e-14 * (std::abs(on(0)) + std::abs(on(1))));
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, Lift, testing::Combine(testing::Values(2, 3), testing::Bool()));

TEST(ParticleForces, AreAbsentWhereNothingIsAskedForAndWhereNothingShears) {
  core::Timers timers;
  core::Scene scene = scenes::two_species_box(2, 5, 0.02, 1e-3, 1e-3);
  const Model without(scene, timers);
  EXPECT_TRUE(without.effects().forces.empty());
  EXPECT_FALSE(without.fields().force.present());
  scene.effects["lift"] = "saffman_mei";
  const Model with(scene, timers);
  EXPECT_EQ(with.effects().forces.size(), 1u);
  EXPECT_GT(bytes_of(with.fields()), bytes_of(without.fields()));
  core::Scene line = scenes::uniform_bed(1e-3, 2500, 1000, 1e-3, 0.3, 10, 0.1);  // one cell across
  line.effects["lift"] = "saffman_mei";
  const Model flat(line, timers);
  EXPECT_TRUE(flat.effects().forces.empty());
  EXPECT_FALSE(flat.fields().force.present());
}

}  // namespace
}  // namespace polybed::tfm
