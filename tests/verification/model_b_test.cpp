// The pressure gradient on every phase (model A, T(1.16)) and on the fluid alone (model B, T(1.22)) are one set of
// equations once T(1.17) is inserted: the same state has the same accelerations.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/numerics/operators.hpp"
#include "scenes/record.hpp"
#include "tfm/explicit_problem.hpp"

namespace polybed::scenes {
namespace {

using core::face_mean;

/// Greatest difference over all faces between dU_j/dt as the model has it and as T(1.22) gives it, and the greatest
/// acceleration, m/s2.
struct Difference {
  double greatest = 0, scale = 0;
};

/// T(1.22), per unit mass: phi_j grad P is replaced by what the fluid's own momentum T(1.17) says it is, so that only
/// the fluid's acceleration and its drag appear; dU_f/dt follows from the rates of J, U_j and phi_j.
Difference compare(const tfm::Constants& constants, const fluid::Boundaries& boundaries, tfm::Fields& fields) {
  const std::size_t n = constants.species();
  const core::FaceField convection_and_drag = fields.fluid_acceleration;  // a_f: grad p is not in it
  const std::vector<core::FaceField> without_pressure = fields.solids.acceleration;
  tfm::subtract_pressure_gradient(constants, boundaries, fields);
  Difference d;
  for (int axis = 0; axis < constants.grid.dimensions; ++axis) {
    const auto a = std::size_t(axis);
    const core::Index s = constants.grid.stride(axis);
    core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](core::Index begin, core::Index end) {
      for (core::Index c = begin; c < end; ++c) {
        const auto f = std::size_t(c);
        const double u_f = fields.fluid.velocity[a][f];
        double fluid_rate = fields.flux_rate.free[a][f];  // now dJ/dt
        for (std::size_t j = 0; j < n; ++j) {
          fluid_rate -= face_mean(fields.solids.fraction[j].data(), c, s) * fields.solids.acceleration[j][a][f];
          fluid_rate -=
              (fields.solids.velocity[j][a][f] - u_f) * face_mean(fields.solids.fraction_rate[j].data(), c, s);
        }
        fluid_rate /= face_mean(fields.fluid.voidage.data(), c, s);
        const double gradient = constants.fluid.density * (convection_and_drag[a][f] - fluid_rate);  // by T(1.17)
        for (std::size_t j = 0; j < n; ++j) {
          const double model_b = without_pressure[j][a][f] - gradient / constants.density[j];
          d.greatest = std::max(d.greatest, std::abs(model_b - fields.solids.acceleration[j][a][f]));
          d.scale = std::max(d.scale, std::abs(fields.solids.acceleration[j][a][f]));
        }
      }
    });
  }
  return d;
}

// All terms on, unsteady: what differs is the order of sums. 1e-12 of the greatest acceleration.
TEST(ModelB, GivesTheSameAccelerationsAsModelA) {
  core::Scene scene = binary_bed(10, 40, 0.03, 0.12);
  scene.effects["fluid_stress"] = "newtonian";
  core::Timers timers;
  tfm::Model model(scene, timers);
  make_uneven(model, [](int i, int j, int) { return 1 - 0.02 * ((3 * i + 5 * j) % 7); });
  advance(model, 0.05);
  tfm::Fields fields = model.fields();
  const Difference d = compare(model.constants(), model.boundaries(), fields);
  record("difference over greatest acceleration", d.greatest / d.scale);
  EXPECT_GT(d.scale, 0.1) << "m/s2: nothing moves, so nothing is compared";
  EXPECT_LT(d.greatest, 1e-12 * d.scale);
}

/// Particles as dense as the fluid, without drag, in a column whose inlet speeds up evenly to 0.05 m/s in 0.1 s: their
/// velocity half way up after that, where nothing has come from the ends.
double neutral_velocity(double gravity) {
  core::Scene scene = uniform_bed(1e-3, 1000, 1000, 1e-3, 0.4, 40, 0.4);
  scene.effects.clear();
  scene.column.gravity = gravity;
  scene.inlet.superficial_velocity = {{0.0, 0.0}, {0.1, 0.05}};
  scene.tfm.rtol = 1e-8;
  scene.tfm.pressure_tolerance = 1e-12;
  core::Timers timers;
  tfm::Model model(scene, timers);
  advance(model, 0.1);
  return model.fields().solids.velocity[0][1][std::size_t(model.constants().grid.index(0, 20))];
}

// Buoyancy once: the gradient that speeds the fluid up does the same to what it displaces, and weight cancels it at
// rest. Twice, or not at all, would give twice the velocity or none. Tolerance: that of the steps, 1e-8, and of the
// pressure.
TEST(ModelB, NeutralParticlesGoWithTheFluid) {
  for (const double gravity : {0.0, 9.81}) {
    const double velocity = neutral_velocity(gravity);
    record(fmt::format("velocity at gravity {}", gravity), velocity);
    EXPECT_NEAR(velocity, 0.05, 1e-8);
  }
}

}  // namespace
}  // namespace polybed::scenes
