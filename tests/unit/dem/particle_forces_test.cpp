// Drag, pressure and added mass of particles among others, against the formulas by hand and the laws of a cell.
#include "dem/coupling/particle_forces.hpp"

#include <gtest/gtest.h>

#include "closures/added_mass.hpp"
#include "cloud.hpp"

namespace polybed::dem::test {
namespace {

/// A fluid of even fields around two particles, one of each species, in the middle of a column.
struct Even {
  Cloud cloud;
  Gather gather;
  static constexpr double density = 1000, viscosity = 1e-3;

  Even(core::Scene scene, const std::array<double, 2>& phi, const Vector& velocity, const Vector& gradient)
      : cloud(scene), gather(cloud.grid, {0.5e-3, 1.1e-3}) {
    cloud.add(0, {5.2e-3, 4.1e-3, 4.7e-3}, {0.01, -0.02, 0.03});
    cloud.add(1, {6.6e-3, 6.3e-3, 3.1e-3}, {-0.02, 0.01, 0});
    core::FaceField u = core::make_face_field(cloud.grid), g = u;
    for (std::size_t a = 0; a < 3; ++a) {
      std::fill(u[a].begin(), u[a].end(), velocity[a]);
      std::fill(g[a].begin(), g[a].end(), gradient[a]);
    }
    gather.take({core::make_field(cloud.grid, phi[0]), core::make_field(cloud.grid, phi[1])}, u, g);
  }
  std::vector<FluidLoad> loads() {
    ParticleForces forces(cloud.scene, cloud.materials, density, viscosity);
    std::vector<FluidLoad> found(2);
    forces.find(cloud.particles, gather, found);
    return found;
  }
  [[nodiscard]] double slip(std::size_t i, const Vector& velocity) const {
    const Vector& v = cloud.particles.motion[i].v;
    return std::hypot(velocity[0] - v[0], velocity[1] - v[1], velocity[2] - v[2]);
  }
};

core::Scene with(const std::string& drag, const std::string& added_mass = "none") {
  core::Scene scene = cloud_scene(3, true);
  scene.effects = {{"drag", drag}, {"added_mass", added_mass}};
  return scene;
}

// One size, Wen and Yu at Re < 1000: f = (1 + 0.15 Re^0.687) eps^-3.65, Re by the superficial slip. k = 3 pi mu D eps
// f.
TEST(ParticleForces, DragOfOneSizeByHand) {
  const Vector u{0.1, 0.05, 0};
  Even even(with("wen_yu"), {0, 0.3}, u, {});
  const double eps = 0.7, d = 1.1e-3, re = Even::density * eps * even.slip(1, u) * d / Even::viscosity;
  const double f = (1 + 0.15 * std::pow(re, 0.687)) * std::pow(eps, -3.65);
  const double expected = 3 * std::numbers::pi * Even::viscosity * d * eps * f;
  EXPECT_NEAR(even.loads()[1].drag, expected, 1e-13 * expected);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(even.loads()[1].velocity[k], u[k], 1e-16);
}

TEST(ParticleForces, InAMixtureAreThoseOfTheCellsLaw) {
  const std::array<double, 2> phi{0.25, 0.2}, diameter{0.5e-3, 1.1e-3};
  const Vector u{0.1, 0.05, -0.02};
  for (const std::string& name : closures::drag_law_names()) {
    Even even(with(name), phi, u, {});
    const double eps = 0.55;
    const std::array<double, 2> share{0.25 / 0.45, 0.2 / 0.45}, slip{eps * even.slip(0, u), eps * even.slip(1, u)};
    std::array<double, 2> f{}, slope{};
    closures::drag_of_mixture(closures::drag_law(name, closures::Guard::on), eps, share, diameter, slip, Even::density,
                              Even::viscosity, f, slope);
    const std::vector<FluidLoad> loads = even.loads();
    for (std::size_t j = 0; j < 2; ++j) {
      const double expected = 3 * std::numbers::pi * Even::viscosity * diameter[j] * eps * f[j];
      EXPECT_NEAR(loads[j].drag, expected, 1e-12 * expected) << name;  // vector forms of exp and log: 1e-13
    }
  }
}

TEST(ParticleForces, APartitionSharesTheMeanLaw) {
  const std::array<double, 2> phi{0.25, 0.2}, diameter{0.5e-3, 1.1e-3};
  const Vector u{0.1, 0.05, -0.02};
  for (const char* partition : {"cello", "brinkman_oseen"}) {
    core::Scene scene = with("wen_yu");
    scene.effects["partition"] = partition;
    Even even(scene, phi, u, {});
    const double eps = 0.55;
    const std::array<double, 2> share{0.25 / 0.45, 0.2 / 0.45}, slip{eps * even.slip(0, u), eps * even.slip(1, u)};
    std::array<double, 2> f{}, slope{};
    closures::drag_of_mixture(closures::drag_law("wen_yu", partition, closures::Guard::on), eps, share, diameter, slip,
                              Even::density, Even::viscosity, f, slope);
    const std::vector<FluidLoad> loads = even.loads();
    for (std::size_t j = 0; j < 2; ++j) {
      const double expected = 3 * std::numbers::pi * Even::viscosity * diameter[j] * eps * f[j];
      EXPECT_NEAR(loads[j].drag, expected, 1e-12 * expected) << partition;  // round-off of Re
    }
  }
}

// The law of each species times its factor at its own Re, by superficial slip and own diameter.
TEST(ParticleForces, AShapeMultipliesTheDragOfItsSpecies) {
  const Vector u{0.1, 0.05, -0.02};
  core::Scene scene = with("brinkman_oseen");
  const std::vector<FluidLoad> spheres = Even(scene, {0.25, 0.2}, u, {}).loads();
  scene.species[1].sphericity = 0.7;
  scene.effects["shape"] = "ergun";
  Even even(scene, {0.25, 0.2}, u, {});
  const double re = Even::density * 0.55 * even.slip(1, u) * 1.1e-3 / Even::viscosity;
  const double factor = closures::ShapeFactor{closures::ergun(0.7), closures::ergun(1), true}(0.55, re);
  EXPECT_GT(factor, 1.1);
  EXPECT_EQ(even.loads()[0].drag, spheres[0].drag);
  EXPECT_NEAR(even.loads()[1].drag, factor * spheres[1].drag, 1e-14 * even.loads()[1].drag);  // round-off of Re
}

// -V grad p; no drag, nothing else.
TEST(ParticleForces, PressureActsOnTheVolume) {
  const Vector gradient{100, -9810, 30};
  Even even(with("none"), {0.25, 0.2}, {}, gradient);
  const std::vector<FluidLoad> loads = even.loads();
  for (std::size_t i = 0; i < 2; ++i) {
    const double volume = Cloud::volume_of(even.cloud.particles.place[i].radius);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(loads[i].force[k], -volume * gradient[k], 1e-14 * volume * 9810);
    EXPECT_EQ(loads[i].drag, 0);
    EXPECT_EQ(loads[i].added, 0);
  }
}

// C_m rho_f V with C_m = 1/2, or (1 + 2 phi)/(2 (1 - phi)) = 1.9/1.1 at phi 0.45.
TEST(ParticleForces, AddedMassByHand) {
  for (const auto& [law, coefficient] : {std::pair{"half", 0.5}, {"zuber", 1.9 / 1.1}}) {
    Even even(with("none", law), {0.25, 0.2}, {}, {});
    const std::vector<FluidLoad> loads = even.loads();
    for (std::size_t i = 0; i < 2; ++i) {
      const double expected = coefficient * 1000 * Cloud::volume_of(even.cloud.particles.place[i].radius);
      EXPECT_NEAR(loads[i].added, expected, 1e-14 * expected) << law;
    }
  }
}

// Where no solids are on the grid, and where they are denser than any bed: finite, positive, counted.
TEST(ParticleForces, AtTheEndsOfVoidage) {
  Even alone(with("cello"), {0, 0}, {0.1, 0, 0}, {});
  const double re = 1000 * alone.slip(0, {0.1, 0, 0}) * 0.5e-3 / 1e-3;
  const std::vector<FluidLoad> single = alone.loads();
  EXPECT_GT(single[0].drag, 3 * std::numbers::pi * 1e-3 * 0.5e-3);
  EXPECT_LT(single[0].drag, 3 * std::numbers::pi * 1e-3 * 0.5e-3 * (1 + 0.3 * std::pow(re, 0.687)));
  Even crowd(with("cello"), {0.5, 0.4}, {0.1, 0, 0}, {});
  ParticleForces forces(crowd.cloud.scene, crowd.cloud.materials, 1000, 1e-3);
  std::vector<FluidLoad> found(2);
  forces.find(crowd.cloud.particles, crowd.gather, found);
  EXPECT_TRUE(std::isfinite(found[0].drag) && found[0].drag > 0);
  EXPECT_EQ(forces.use().clamped_voidage, 2U);
  EXPECT_EQ(forces.use().evaluations, 2U);
}

}  // namespace
}  // namespace polybed::dem::test
