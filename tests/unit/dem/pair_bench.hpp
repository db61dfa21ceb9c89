// Two spheres that meet head on: the engine's batches, laws and integrator without a whole model.
#pragma once

#include "bench.hpp"
#include "dem/ledger.hpp"

namespace polybed::dem::test {

inline Box open_box() {
  Box box;
  box.size = {1, 1, 1};
  return box;
}

class PairBench {
 public:
  /// \param gap  between the surfaces, m  \param speed  of approach, m/s, half each
  PairBench(const core::Scene& scene, double time_step, double gap, double speed, bool synchronised = false)
      : box_(open_box()),
        materials(scene),
        laws(make_pair_laws(scene, materials)),
        dt(time_step),
        force(force_unit(scene, materials, laws)),
        torque(torque_unit(force, materials)),
        verlet_(synchronised, time_step, {}, force, torque, 0),
        forces_(box_, materials, laws, force, torque, scene.dem.max_overlap),
        energy_(FixedPoint::for_sums_of(0.5 * materials.kinds()[0].mass * speed * speed, 1024)),
        ledger_(laws, laws.memory_size(), synchronised, energy_) {
    const Species& s = materials.species()[0];
    for (const int side : {-1, 1})
      particles.add({{{0.5 + side * (s.radius + 0.5 * gap), 0.5, 0.5}, s.radius},
                     {{-0.5 * side * speed, 0, 0}, {}, 1 / s.mass, 1 / s.inertia},
                     {},
                     side,
                     0});
    particles.owned = 2;
    pairs.pairs = {{0, 1, Images::here, materials.kind(0, 0)}};
    pairs.inner = 1;
    pairs.memory_size = laws.memory_size() + Ledger::memory_size(laws);
    pairs.memory.resize(std::size_t(pairs.memory_size));
    forces_.keep(ledger_);
    find();
  }
  PairBench(const PairBench&) = delete;
  PairBench& operator=(const PairBench&) = delete;

  void step() {
    verlet_.begin(particles, nullptr);
    find();
    verlet_.end(particles, nullptr);
  }
  [[nodiscard]] double gap() const {
    return particles.place[1].x[0] - particles.place[0].x[0] - 2 * particles.place[0].radius;
  }
  /// Positive on approach.
  [[nodiscard]] double speed() const { return particles.motion[0].v[0] - particles.motion[1].v[0]; }
  [[nodiscard]] double kinetic() const { return 0.5 * kind().mass * speed() * speed(); }
  [[nodiscard]] double dissipated() const { return double(ledger_.units()) * energy_.unit; }
  [[nodiscard]] const PairMaterial& kind() const { return materials.kinds()[std::size_t(materials.kind(0, 0))]; }

 private:
  void find() {
    const Images images{box_, 0, 0};
    forces_.add_inner_pairs(particles, pairs, images, dt);
    forces_.add_outer_pairs(particles, pairs, images, dt);
  }
  Box box_;

 public:
  Materials materials;
  PairLaws laws;
  double dt;
  FixedPoint force, torque;
  Particles particles;
  Contacts pairs;

 private:
  Verlet verlet_;
  PairForces forces_;
  FixedPoint energy_;
  Ledger ledger_;
};

}  // namespace polybed::dem::test
