// The textbook treatments of the continuum are what they say: beside what each replaces they do as the product does.
#include <gtest/gtest.h>

#include "hard/scenes.hpp"

namespace polybed::hard {
namespace {

using scenes::uniform_bed;

// The runs that textbook treatments ride on are sound: without a treatment they do as the product does, over a jump of
// the inlet, too. Round-off of steps of one length; Newton's tolerance where steps differ.
TEST(Naive, RunsWithoutATreatmentDoAsTheProduct) {
  for (const std::string integrator : {"explicit", "implicit"}) {
    core::Scene scene = two_species(30, 0.09, false);
    scene.inlet.superficial_velocity = {{0.0, 0.02}, {0.05, 0.02}, {0.05, 0.03}};
    scene.bed.static_height = 0.03;
    scene.bed.start_solids_fraction = 0.5;
    if (integrator == "explicit") scene.tfm.fixed_step = 5e-4;
    Trial product({integrator, "limited", ""}), other({integrator, "limited", "nothing " + integrator});
    const auto a = product.begin(scene), b = other.begin(scene);
    product.advance(*a, 0.1);
    other.advance(*b, 0.1);
    const measures::Profile one = profile_of(*a), two = profile_of(*b);
    for (std::size_t k = 0; k < one.slabs(); ++k)
      EXPECT_NEAR(one.fraction[0][k], two.fraction[0][k], integrator == "explicit" ? 1e-9 : 1e-4) << integrator;
  }
}

// Momenta as unknowns are no mistake in themselves: where there are solids everywhere they give the same.
TEST(Naive, MomentaAsUnknownsWorkWhereNothingVanishes) {
  core::Scene scene = uniform_bed(1e-3, 2200, 998.207, 1.00157e-3, 0.36, 30, 0.09);
  scene.inlet.superficial_velocity = {{0.0, 0.035}};
  scene.tfm.rtol = 1e-5;  // each has errors of its own, of the tolerance's order
  Trial product({"implicit", "limited", ""}), other({"implicit", "limited", "divide_by_phi"});
  const auto a = product.begin(scene), b = other.begin(scene);
  product.advance(*a, 0.1);
  other.advance(*b, 0.1);
  const measures::Profile one = profile_of(*a), two = profile_of(*b);
  for (std::size_t k = 0; k < one.slabs(); ++k) EXPECT_NEAR(one.fraction[0][k], two.fraction[0][k], 1e-4);
}

// A lagged added mass is no mistake where it is small, a fifteenth of the solids' own: the first of 40 steps goes
// without it, 7e-2/40 of the velocity.
TEST(Naive, LaggedAddedMassWorksOfHeavySolids) {
  core::Scene scene = uniform_bed(1e-3, 2500, 250, 1.00157e-3, 0.1, 30, 0.09);
  scene.column.closed = true;
  scene.effects["added_mass"] = "zuber";
  scene.tfm.fixed_step = 5e-5;
  Trial product({"explicit", "limited", ""}), other({"explicit", "limited", "added_mass_lagged"});
  const auto a = product.begin(scene), b = other.begin(scene);
  product.advance(*a, 2e-3);
  other.advance(*b, 2e-3);
  const auto middle = std::size_t(a->model().constants().grid.index(0, 15));
  const double velocity = a->fields().solids.velocity[0][1][middle];
  EXPECT_LT(velocity, -0.01);
  EXPECT_NEAR(b->fields().solids.velocity[0][1][middle], velocity, 3e-3 * std::abs(velocity));
}

}  // namespace
}  // namespace polybed::hard
