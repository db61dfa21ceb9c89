// Spheres over a floor, each alone with it: the engine's batches, laws and integrator without a whole model.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dem/contacts/materials.hpp"
#include "dem/contacts/pair_forces.hpp"
#include "dem/effects.hpp"
#include "dem/particles.hpp"
#include "dem/scene.hpp"
#include "dem/verlet.hpp"

namespace polybed::dem::test {

using Effects = std::vector<std::pair<std::string, std::string>>;

/// One species of 5 mm and 5 MPa; contact = hertz_mindlin unless said otherwise.
inline core::Scene scene_of(const Effects& effects) {
  core::Scene scene;
  core::Species sphere;
  sphere.name = "a";
  sphere.diameter = 5e-3;
  sphere.density = 2500;
  scene.species.push_back(sphere);
  scene.effects["contact"] = "hertz_mindlin";
  for (const auto& [role, law] : effects) scene.effects[role] = law;
  scene.dem.max_overlap = 0.1;
  return scene;
}

inline Box floor_box() {
  Box box;
  box.size = {1, 1, 1};
  box.walls.push_back({1, 0, 0});
  return box;
}

class Bench {
 public:
  Bench(const core::Scene& scene, double time_step, Vector gravity = {}, bool synchronised = false)
      : box(floor_box()),
        materials(scene),
        laws(make_pair_laws(scene, materials)),
        dt(time_step),
        force(force_unit(scene, materials, laws)),
        torque(torque_unit(force, materials)),
        verlet(synchronised, time_step, gravity, force, torque, 0),
        forces(box, materials, laws, force, torque, scene.dem.max_overlap) {
    if (laws.film) laws.film->set_step(time_step);
    walls.memory_size = laws.memory_size();
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  [[nodiscard]] double radius() const { return materials.species()[0].radius; }
  [[nodiscard]] const PairMaterial& kind() const { return materials.kinds()[std::size_t(materials.wall_kind(0))]; }

  void add(double overlap, const Vector& velocity, const Vector& spin = {}) {
    const Species& s = materials.species()[0];
    const auto id = std::int64_t(particles.size());
    particles.add({{{0.5, s.radius - overlap, 0.5}, s.radius}, {velocity, 1 / s.mass, spin, 1 / s.inertia}, {}, id, 0});
    particles.owned = particles.size();
    walls.pairs.push_back({std::int32_t(id), 0, 0, materials.wall_kind(0)});
    walls.memory.resize(walls.pairs.size() * std::size_t(walls.memory_size));
  }
  void step() {
    verlet.begin(particles, {});
    forces.add_walls(particles, walls, dt);
    verlet.mark(particles);
    verlet.end(particles, {}, 0);
  }
  /// The force on particle 0 with prescribed overlap and motion, after a step dt.
  Vector press(double overlap, const Vector& velocity, const Vector& spin = {}) {
    particles.place[0].x[1] = radius() - overlap;
    particles.motion[0].v = velocity;
    particles.motion[0].w = spin;
    particles.load[0] = {};
    forces.add_walls(particles, walls, dt);
    return in_units(particles.load[0].force, force.unit);
  }
  [[nodiscard]] Vector torque_now() const { return in_units(particles.load[0].torque, torque.unit); }
  [[nodiscard]] double overlap(std::size_t i) const { return radius() - particles.place[i].x[1]; }
  [[nodiscard]] double* memory(std::size_t i) { return walls.memory_of(std::int32_t(i)); }

  Box box;
  Materials materials;
  PairLaws laws;
  double dt;
  FixedPoint force, torque;
  Verlet verlet;
  PairForces forces;
  Particles particles;
  Contacts walls;

 private:
  static Vector in_units(const std::array<std::int64_t, 3>& sum, double unit) {
    return {double(sum[0]) * unit, double(sum[1]) * unit, double(sum[2]) * unit};
  }
};

}  // namespace polybed::dem::test
