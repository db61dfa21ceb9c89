// Added mass in the continuum: on each face the rows that it stands for, and the fast part of the drag beside it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "closures/added_mass.hpp"
#include "core/numerics/operators.hpp"
#include "scenes/beds.hpp"
#include "tfm/effects.hpp"
#include "tfm/fast_drag.hpp"
#include "tfm/pressure_coupling.hpp"

namespace polybed::tfm {
namespace {

/// Two species, one lighter than the fluid, with fractions, convection, forces and velocities at random.
struct Box {
  core::Scene scene;
  Constants constants;
  fluid::Boundaries boundaries;
  Fields fields;
  Effects effects;
  std::mt19937 random{1};

  Box(const std::string& law, bool form_b)
      : scene(with_added_mass(law, form_b)),
        constants(constants_of(scene)),
        boundaries(constants.grid, fluid::Ends::walls),
        fields(constants),
        effects(make_effects(scene, constants, boundaries, fields)) {
    for (core::Field& phi : fields.solids.fraction) fill(phi, 0.02, 0.3);
    fluid::voidage(fields.solids, fields.fluid.voidage);
    for (core::Field& b : fields.solids.exchange) fill(b, 1e4, 1e6);
    for (core::FaceField& u : fields.solids.velocity) fill(u);
    fill(fields.fluid.velocity);
    accelerate();
    effects.inertia->keep_convection(fields);
    accelerate();
  }
  void accelerate() {
    for (core::FaceField& a : fields.solids.acceleration) fill(a);
    fill(fields.fluid_acceleration);
  }
  void fill(core::Field& field, double low, double high) {
    std::uniform_real_distribution<double> value(low, high);
    for (double& v : field) v = value(random);
  }
  void fill(core::FaceField& field) {
    for (core::Field& along : field) fill(along, -1, 1);
  }
  /// Calls body(axis, face, stride, eps) for the faces where solids move.
  template <class Body>
  void on_faces(Body&& body) {
    for (int axis = 0; axis < 2; ++axis)
      core::for_each_row(constants.grid, boundaries.moving_faces(axis, false), [&](core::Index begin, core::Index end) {
        for (core::Index c = begin; c < end; ++c)
          body(std::size_t(axis), c, constants.grid.stride(axis),
               core::face_mean(fields.fluid.voidage.data(), c, constants.grid.stride(axis)));
      });
  }

 private:
  static core::Scene with_added_mass(const std::string& law, bool form_b) {
    core::Scene scene = scenes::two_species_box(2, 6, 0.02, 1e-3, 1e-3);
    scene.species[1].density = 100;
    scene.effects["added_mass"] = law;
    if (form_b) scene.tfm.form = core::PressureForm::B;
    return scene;
  }
  static Constants constants_of(const core::Scene& scene) {
    core::Timers timers;
    return Model(scene, timers).constants();
  }
};

class AddedMass : public testing::TestWithParam<std::tuple<std::string, bool>> {};

// What is solved for satisfies the equations, written out, with a gradient of pressure of 700 Pa/m on each face:
//   rho_j A_j - C rho_f (A_f - A_j) = rho_j a_j - s_j G,   eps rho_f A_f + sum phi_j C rho_f (A_f - A_j) = eps rho_f
//   a_f - s_f G
// A = dU/dt + (U.grad)U. Round-off of terms up to 5e3 N/m3.
TEST_P(AddedMass, SatisfiesTheEquationsOfEachFace) {
  const auto [law, form_b] = GetParam();
  Box box(law, form_b);
  const Fields before = box.fields;
  box.effects.inertia->couple(box.fields);
  const double rho_f = box.constants.fluid.density, gradient = 700;
  int faces = 0;
  box.on_faces([&](std::size_t a, core::Index c, core::Index s, double eps) {
    const auto f = std::size_t(c);
    const Inertia& inertia = box.fields.inertia;
    const double coefficient =
        rho_f * (law == "half" ? closures::added_mass_of_one : closures::added_mass_zuber(1 - eps));
    const double fluid =
        box.fields.fluid_acceleration[a][f] - inertia.convection[2][a][f] - inertia.fluid_response[a][f] * gradient;
    double on_fluid = eps * rho_f * (fluid - before.fluid_acceleration[a][f] + inertia.convection[2][a][f]) +
                      (form_b ? 1 : eps) * gradient;
    for (std::size_t j = 0; j < 2; ++j) {
      const double solid =
          box.fields.solids.acceleration[j][a][f] - inertia.convection[j][a][f] - inertia.response[j][a][f] * gradient;
      const double force = before.solids.acceleration[j][a][f] - inertia.convection[j][a][f];
      EXPECT_NEAR(box.constants.density[j] * (solid - force) - coefficient * (fluid - solid) + (form_b ? 0 : gradient),
                  0, 1e-10);
      on_fluid += core::face_mean(box.fields.solids.fraction[j].data(), c, s) * coefficient * (fluid - solid);
    }
    EXPECT_NEAR(on_fluid, 0, 1e-10);
    ++faces;
  });
  EXPECT_EQ(faces, 66);  // 36 across joined sides, 30 upward
}

TEST_P(AddedMass, ItsMobilityIsWhatAGradientDoesToTheTotalFlux) {
  const auto [law, form_b] = GetParam();
  Box box(law, form_b);
  box.effects.inertia->couple(box.fields);
  box.effects.inertia->set_mobility(box.fields);
  box.on_faces([&](std::size_t a, core::Index c, core::Index s, double eps) {
    double sum = eps * box.fields.inertia.fluid_response[a][std::size_t(c)];
    for (std::size_t j = 0; j < 2; ++j)
      sum += core::face_mean(box.fields.solids.fraction[j].data(), c, s) *
             box.fields.inertia.response[j][a][std::size_t(c)];
    EXPECT_NEAR(box.fields.flux_rate.mobility[a][std::size_t(c)] / sum, 1, 1e-15);
  });
}

struct Split {
  Box box;
  StateLayout layout{box.constants.grid, 2, false};
  FastDrag fast{box.constants, box.boundaries, layout};
  std::vector<double> state;
  Split(const std::string& law, bool form_b) : box(law, form_b) {
    box.effects.inertia->couple(box.fields);
    fast.hold(box.fields);
    state.resize(layout.size());
    std::uniform_real_distribution<double> velocity(-0.1, 0.1);
    for (double& value : state) value = velocity(box.random);
  }
};

// As in fast_drag_test: x - gamma A x = r with A x from add(); gamma times the rates is up to 1e3 times the velocities.
TEST_P(AddedMass, TheFastDragIsSolvedWithIt) {
  const auto [law, form_b] = GetParam();
  Split split(law, form_b);
  for (const double gamma : {0.0, 1e-4, 1e-2, 1.0}) {
    std::vector<double> solution = split.state, left;
    split.fast.solve(gamma, solution);
    left = solution;
    split.fast.add(-gamma, solution, left);
    double most = 0;
    for (std::size_t n = 0; n < left.size(); ++n) most = std::max(most, std::abs(left[n] - split.state[n]));
    EXPECT_LT(most, 1e-11) << gamma;
  }
}

// The rates of the fast part are those that drag alone has in the equations of each face, at the gradient of pressure
// that holds the total flux.
TEST_P(AddedMass, TheFastDragIsThatOfTheEquations) {
  const auto [law, form_b] = GetParam();
  Split split(law, form_b);
  Box& box = split.box;
  split.layout.unpack(split.state, box.fields.solids, box.fields.fluid);
  fluid::fluid_velocity(box.constants.grid, box.fields.solids, box.fields.fluid);
  split.fast.hold(box.fields);  // the drag of a face depends on the sign of its slip
  for (core::FaceField& a : box.fields.inertia.convection) a = core::make_face_field(box.constants.grid);
  for (core::FaceField& a : box.fields.solids.acceleration) a = core::make_face_field(box.constants.grid);
  box.fields.fluid_acceleration = core::make_face_field(box.constants.grid);
  add_exchange(box.constants, box.boundaries, box.fields);
  fluid::subtract_exchange(box.constants.grid, box.boundaries, box.fields.solids, box.fields.fluid,
                           box.constants.fluid.density, box.fields.fluid_acceleration);
  box.effects.inertia->couple(box.fields);
  box.effects.inertia->set_mobility(box.fields);
  std::vector<double> rates(split.state.size());
  split.fast.add(1, split.state, rates);
  Fields fast(box.constants);
  split.layout.unpack(rates, fast.solids, fast.fluid);
  box.on_faces([&](std::size_t a, core::Index c, core::Index s, double eps) {
    const auto f = std::size_t(c);
    double flux = eps * box.fields.fluid_acceleration[a][f];
    for (std::size_t j = 0; j < 2; ++j)
      flux += core::face_mean(box.fields.solids.fraction[j].data(), c, s) * box.fields.solids.acceleration[j][a][f];
    const double gradient = flux / box.fields.flux_rate.mobility[a][f];
    for (std::size_t j = 0; j < 2; ++j) {
      const double whole = box.fields.solids.acceleration[j][a][f] - box.fields.inertia.response[j][a][f] * gradient;
      EXPECT_NEAR(fast.solids.velocity[j][a][f], whole, 1e-11 * (1 + std::abs(whole)));
    }
  });
}

INSTANTIATE_TEST_SUITE_P(Laws, AddedMass,
                         testing::Combine(testing::Values(std::string("half"), std::string("zuber")), testing::Bool()));

TEST(AddedMassAbsent, HasNoFields) {
  core::Timers timers;
  core::Scene scene = scenes::two_species_box(2, 5, 0.02, 1e-3, 1e-3);
  const Model without(scene, timers);
  EXPECT_EQ(without.effects().inertia, nullptr);
  EXPECT_FALSE(without.fields().inertia.present());
  scene.effects["added_mass"] = "zuber";
  const Model with(scene, timers);
  EXPECT_GT(bytes_of(with.fields()), bytes_of(without.fields()));
}

}  // namespace
}  // namespace polybed::tfm
