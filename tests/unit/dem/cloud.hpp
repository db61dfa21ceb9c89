// Two species of particles strewn at random over a column, with loads of a fluid, without a whole model.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/case/scene.hpp"
#include "core/numerics/blocks.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/coupling/fluid_motion.hpp"
#include "dem/particles.hpp"

namespace polybed::dem::test {

/// 12 x 10 (x 8) mm in cells of 2 mm, but 8 mm of depth in one cell in 2-D.
inline core::Scene cloud_scene(int dimensions, bool periodic) {
  core::Scene scene;
  scene.column.dimensions = dimensions;
  scene.column.size = {12e-3, 10e-3, 8e-3};
  scene.column.cells = {6, 5, dimensions == 3 ? 4 : 1};
  scene.column.sides = periodic ? core::Boundary::periodic : core::Boundary::wall;
  scene.column.closed = true;
  scene.column.gravity = 0;
  scene.fluid.name = "test fluid";
  scene.fluid.density = 1000;
  scene.fluid.viscosity = 1e-3;
  scene.species.resize(2);
  scene.species[0].name = "fine";
  scene.species[0].diameter = 0.5e-3;
  scene.species[0].density = 2500;
  scene.species[1].name = "coarse";
  scene.species[1].diameter = 1.1e-3;
  scene.species[1].density = 1400;
  return scene;
}

struct Cloud {
  core::Scene scene;
  core::Grid grid;
  Materials materials;
  Particles particles;
  std::vector<FluidLoad> loads;
  double volume = 0;  ///< of all particles, m3

  explicit Cloud(const core::Scene& given, std::size_t number = 0, bool added_mass = false)
      : scene(given), grid(core::grid_of(scene.column, nullptr)), materials(scene) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> one(0, 1), speed(-0.1, 0.1);
    for (std::size_t i = 0; i < number; ++i) {
      Vector x;
      for (std::size_t k = 0; k < 3; ++k) x[k] = one(random) * scene.column.size[k];
      add(std::int32_t(i % 3 == 0), x, {speed(random), speed(random), speed(random)});
      FluidLoad& f = loads.back();
      const double mass = 1 / particles.motion.back().inverse_mass;
      f.velocity = {speed(random), speed(random), speed(random)};
      f.impulse = {mass * speed(random), mass * speed(random), mass * speed(random)};
      f.drag = 50 * mass * one(random);
      f.added = added_mass ? 0.5 * mass * one(random) : 0;
    }
  }
  void add(std::int32_t species, const Vector& x, const Vector& velocity = {}) {
    const Species& s = materials.species()[std::size_t(species)];
    particles.add(
        {{x, s.radius}, {velocity, 1 / s.mass, {}, 1 / s.inertia}, {}, std::int64_t(particles.size()), species});
    particles.owned = particles.size();
    loads.emplace_back();
    volume += volume_of(s.radius);
  }
  static double volume_of(double radius) { return 4.0 / 3 * std::numbers::pi * radius * radius * radius; }
};

}  // namespace polybed::dem::test
