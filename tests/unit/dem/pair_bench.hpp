// Spheres of one species that meet: the engine's batches, laws, ledger and integrator without a whole model.
#pragma once

#include <algorithm>

#include "bench.hpp"
#include "dem/ledger.hpp"

namespace polybed::dem::test {

inline Box open_box() {
  Box box;
  box.size = {1, 1, 1};
  return box;
}

struct Mover {
  Vector x, v;
};

class PairBench {
 public:
  /// Any number of spheres, each a pair with each.
  PairBench(const core::Scene& scene, double time_step, const std::vector<Mover>& movers, bool synchronised = false,
            double resolved_gap = 0)
      : box_(open_box()),
        materials(scene),
        laws(make_pair_laws(scene, materials, effects(), resolved_gap)),
        dt(time_step),
        force(force_unit(scene, materials, laws)),
        torque(torque_unit(force, materials)),
        verlet_(synchronised, time_step, {}, force, torque, 0),
        forces_(box_, materials, laws, force, torque, scene.dem.max_overlap),
        energy_(FixedPoint::for_sums_of(materials.species()[0].mass, 1)),  // of 1.4 m/s
        ledger_(laws, laws.memory_size(), synchronised, energy_, force) {
    if (laws.film) laws.film->set_step(dt);
    const Species& s = materials.species()[0];
    for (std::size_t n = 0; n < movers.size(); ++n) {
      particles.add({{movers[n].x, s.radius}, {movers[n].v, 1 / s.mass, {}, 1 / s.inertia}, {}, std::int64_t(n), 0});
      for (std::size_t m = 0; m < n; ++m)
        pairs.pairs.push_back({std::int32_t(m), std::int32_t(n), Images::here, materials.kind(0, 0)});
    }
    particles.owned = movers.size();
    pairs.inner = pairs.pairs.size();
    pairs.memory_size = laws.memory_size() + Ledger::memory_size(laws);
    pairs.memory.resize(pairs.pairs.size() * std::size_t(pairs.memory_size));
    forces_.keep(ledger_);
    verlet_.keep(ledger_);
    find(0);
  }
  /// Two that meet head on. \param gap  between the surfaces, m  \param speed  of approach, m/s, half each
  PairBench(const core::Scene& scene, double time_step, double gap, double speed, bool synchronised = false,
            double resolved_gap = 0)
      : PairBench(scene, time_step, head_on(scene.species[0].diameter, gap, speed), synchronised, resolved_gap) {}
  PairBench(const PairBench&) = delete;
  PairBench& operator=(const PairBench&) = delete;

  void step() {
    verlet_.begin(particles, {});
    find(dt);
    verlet_.mark(particles);
    verlet_.end(particles, {}, 0);
  }
  /// Of the first two.
  [[nodiscard]] double gap() const {
    return particles.place[1].x[0] - particles.place[0].x[0] - 2 * particles.place[0].radius;
  }
  /// Positive on approach.
  [[nodiscard]] double speed() const { return particles.motion[0].v[0] - particles.motion[1].v[0]; }
  [[nodiscard]] double kinetic() const {
    double sum = 0;
    for (const Motion& m : particles.motion)
      sum += 0.5 / m.inverse_mass * (m.v[0] * m.v[0] + m.v[1] * m.v[1] + m.v[2] * m.v[2]);
    return sum;
  }
  [[nodiscard]] double dissipated() const { return ledger_.lost().units() * energy_.unit; }
  [[nodiscard]] const PairMaterial& kind() const { return materials.kinds()[std::size_t(materials.kind(0, 0))]; }

 private:
  static std::vector<Mover> head_on(double diameter, double gap, double speed) {
    const double half = 0.5 * (diameter + gap);
    return {{{0.5 - half, 0.5, 0.5}, {0.5 * speed, 0, 0}}, {{0.5 + half, 0.5, 0.5}, {-0.5 * speed, 0, 0}}};
  }
  void find(double time) {
    const Images images{box_, 0, 0};
    forces_.add_inner_pairs(particles, pairs, images, time);
    forces_.add_outer_pairs(particles, pairs, images, time);
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
