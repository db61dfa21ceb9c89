// The particles on one rank: first those it owns, then ghosts, copies of others' particles near its own. One record per
// use, so that a force reads few cache lines.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace polybed::dem {

using Vector = std::array<double, 3>;

struct alignas(32) Place {
  Vector x;       ///< centre, m; along periodic directions within the box when the pairs were listed
  double radius;  ///< m
};

struct alignas(64) Motion {
  Vector v;                ///< m/s; during a force, at the integrator's time
  double inverse_mass;     ///< 1/kg
  Vector w;                ///< spin, rad/s
  double inverse_inertia;  ///< 1/(kg m2)
};

/// Sum of forces and torques in whole units, so that it does not depend on the order (see FixedPoint).
struct Load {
  std::array<std::int64_t, 3> force{}, torque{};
};

/// All data of one particle, for moves between ranks.
struct Particle {
  Place place;
  Motion motion;
  Load load;
  std::int64_t id;
  std::int32_t species;
  bool operator==(const Particle&) const = delete;
};

struct Particles {
  std::size_t owned = 0;         ///< number of owned particles; the rest are ghosts, without loads
  std::vector<std::int64_t> id;  ///< 0, 1, ... over all ranks
  std::vector<std::int32_t> species;
  std::vector<Place> place;
  std::vector<Motion> motion;
  std::vector<Load> load;  ///< from the last force

  [[nodiscard]] std::size_t size() const { return id.size(); }
  [[nodiscard]] Particle at(std::size_t i) const { return {place[i], motion[i], load[i], id[i], species[i]}; }
  void resize(std::size_t n) {
    id.resize(n);
    species.resize(n);
    place.resize(n);
    motion.resize(n);
    load.resize(n);
  }
  void set(std::size_t i, const Particle& p) {
    id[i] = p.id;
    species[i] = p.species;
    place[i] = p.place;
    motion[i] = p.motion;
    load[i] = p.load;
  }
  /// Moves the n-th of an order to place n: column by column, so that only one column is copied at a time.
  void arrange(const std::vector<std::int32_t>& order) {
    const auto move = [&](auto& column) {
      const auto before = column;
      for (std::size_t n = 0; n < order.size(); ++n) column[n] = before[std::size_t(order[n])];
    };
    move(id);
    move(species);
    move(place);
    move(motion);
    move(load);
  }
  void add(const Particle& p) {
    resize(size() + 1);
    set(size() - 1, p);
  }
};

}  // namespace polybed::dem
