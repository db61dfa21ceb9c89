// Three dimensions: the same operators as in two, and no direction that is treated in its own way.
#include <gtest/gtest.h>

#include "scenes/record.hpp"

namespace polybed::scenes {
namespace {

/// A small bed of two species in a box of width x height x depth; not uniform along any horizontal axis: the side
/// walls act on the fluid.
core::Scene box_bed(int nx, int ny, int nz, const std::string& sides) {
  core::Scene scene = binary_bed(nx, ny, 3e-3 * nx, 4e-3 * ny);
  scene.column.dimensions = nz > 1 ? 3 : 2;
  scene.column.cells[2] = nz;
  scene.column.size[2] = 3e-3 * nz;
  scene.column.sides = core::choice_of<core::Boundary>(sides);
  scene.tfm.fixed_step = 2.5e-4;
  scene.tfm.pressure_tolerance = 1e-13;
  scene.tfm.bulk_viscosity = 1;  // its default knows the number of directions
  return scene;
}

/// A run of 0.1 s from an uneven start; phi of a species at a cell.
struct FromUneven {
  core::Timers timers;
  tfm::Model model;
  template <class Factor>
  FromUneven(const core::Scene& scene, Factor&& factor) : model(scene, timers) {
    make_uneven(model, factor);
    advance(model, 0.1);
  }
  [[nodiscard]] double phi(std::size_t species, int i, int j, int k) const {
    return model.fields().solids.fraction[species][std::size_t(model.constants().grid.index(i, j, k))];
  }
};

/// Looser at a cell and around it.
auto lump(int at, int width) {
  return
      [=](int i, int j) { return 1 - 0.1 * std::exp(-0.5 * std::pow((i - at) % width, 2) - 0.1 * std::pow(j - 4, 2)); };
}

// Round-off of 100 steps, and the pressure solver's tolerance of 1e-13.
TEST(ThreeDimensions, AColumnThatIsEvenInDepthIsTheTwoDimensionalOne) {
  const auto uneven = [f = lump(2, 6)](int i, int j, int) { return f(i, j); };
  const FromUneven flat(box_bed(6, 24, 1, "periodic"), uneven), deep(box_bed(6, 24, 4, "periodic"), uneven);
  double worst = 0, spread = 0;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 6; ++i) {
        worst = std::max(worst, std::abs(deep.phi(0, i, j, k) - flat.phi(0, i, j, 0)));
        spread = std::max(spread, std::abs(flat.phi(0, i, j, 0) - flat.phi(0, 0, j, 0)));
      }
  record("greatest difference", worst);
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(spread, 1e-3) << "the bed must be uneven, or the test says nothing";
}

TEST(ThreeDimensions, WidthAndDepthMayChangePlaces) {
  const auto along_x = [f = lump(2, 6)](int i, int j, int) { return f(i, j); };
  const auto along_z = [f = lump(2, 6)](int, int j, int k) { return f(k, j); };
  const FromUneven wide(box_bed(6, 24, 4, "wall"), along_x), deep(box_bed(4, 24, 6, "wall"), along_z);
  double worst = 0, spread = 0;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 6; ++i) {
        worst = std::max(worst, std::abs(wide.phi(1, i, j, k) - deep.phi(1, k, j, i)));
        spread = std::max(spread, std::abs(wide.phi(1, i, j, k) - wide.phi(1, 0, j, k)));
      }
  record("greatest difference", worst);
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(spread, 1e-3);
}

// The same with lift, which no one of its three directions is alike in, and added mass.
TEST(ThreeDimensions, LiftAndAddedMassKnowNoDirection) {
  const auto along_x = [f = lump(2, 6)](int i, int j, int) { return f(i, j); };
  const auto along_z = [f = lump(2, 6)](int, int j, int k) { return f(k, j); };
  const FromUneven wide(with_particle_forces(box_bed(6, 24, 4, "wall")), along_x),
      deep(with_particle_forces(box_bed(4, 24, 6, "wall")), along_z), without(box_bed(6, 24, 4, "wall"), along_x);
  double worst = 0, moved = 0;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 6; ++i) {
        worst = std::max(worst, std::abs(wide.phi(1, i, j, k) - deep.phi(1, k, j, i)));
        moved = std::max(moved, std::abs(wide.phi(1, i, j, k) - without.phi(1, i, j, k)));
      }
  record("greatest difference", worst);
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(moved, 1e-5) << "the forces must be felt, or the test says nothing";
}

// Joined sides have no beginning: a bed that starts shifted stays shifted.
TEST(JoinedSides, TheOriginDoesNotMatter) {
  const auto at_0 = [f = lump(0, 1000)](int i, int j, int) { return f(std::min(i, 6 - i), j); };
  const auto at_2 = [f = lump(0, 1000)](int i, int j, int) {
    return f(std::min(std::abs(i - 2), 6 - std::abs(i - 2)), j);
  };
  for (const char* integrator : {"explicit", "implicit"}) {
    core::Scene scene = box_bed(6, 24, 1, "periodic");
    scene.tfm.integrator = core::choice_of<core::TfmIntegrator>(integrator);
    if (scene.tfm.integrator == core::TfmIntegrator::implicit_steps) {
      scene.tfm.fixed_step.reset();
      scene.tfm.rtol = 1e-7;
    }
    const FromUneven here(scene, at_0), there(scene, at_2);
    double worst = 0, spread = 0;
    for (int j = 0; j < 24; ++j)
      for (int i = 0; i < 6; ++i) {
        worst = std::max(worst, std::abs(here.phi(0, i, j, 0) - there.phi(0, (i + 2) % 6, j, 0)));
        spread = std::max(spread, std::abs(here.phi(0, i, j, 0) - here.phi(0, 3, j, 0)));
      }
    record(std::string("greatest difference, ") + integrator, worst);
    // Explicit: round-off. Implicit: Newton stops at its tolerance, with a preconditioner that knows an origin.
    EXPECT_LT(worst, scene.tfm.fixed_step ? 1e-12 : 1e-5) << integrator;
    EXPECT_GT(spread, 1e-3);
  }
}

TEST(ThreeDimensions, BothIntegratorsAgreeAndKeepMass) {
  const auto even = [](int, int, int) { return 1.0; };
  core::Scene scene = box_bed(5, 20, 4, "wall");
  scene.tfm.fixed_step.reset();
  scene.bed.start_solids_fraction = 0.45;
  scene.tfm.rtol = 1e-5;
  const FromUneven by_steps(scene, even);
  scene.tfm.integrator = core::TfmIntegrator::implicit_steps;
  const FromUneven by_newton(scene, even);
  const core::Grid& grid = by_steps.model.constants().grid;
  const double apart =
      distance(grid, by_steps.model.fields().solids.fraction[0], by_newton.model.fields().solids.fraction[0]);
  record("distance", apart);
  EXPECT_LT(apart, 1e-3);  // a hundred times rtol
  for (const FromUneven* run : {&by_steps, &by_newton}) {
    const std::vector<double> volume = measures::species_volumes(grid, run->model.fields().solids);
    const double solids =
        scene.bed.static_height * scene.bed.solids_fraction * scene.column.size[0] * scene.column.size[2];
    for (std::size_t j = 0; j < 2; ++j) EXPECT_NEAR(volume[j] / (solids * scene.bed.volume_share[j]), 1, 1e-12);
  }
}

}  // namespace
}  // namespace polybed::scenes
