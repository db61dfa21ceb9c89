// Particles as a vertical profile, by the exact part of each sphere between two planes, so that measures/bed measures
// a bed of particles and a continuum by one definition.
//
// Sums run in whole numbers: the result has the same bits in any order of the particles, and on any number of ranks
// if the units (agreed first) and the sums are added up over them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "measures/profile.hpp"

namespace polybed::measures {

/// Volume, m3, of the part of a sphere below a horizontal plane: the cap pi h^2 (3R - h)/3 of height
/// h = plane - (centre - R), 0 for h < 0 and the whole sphere for h > 2R.
/// \param radius  R, m, >= 0   \param centre  height of the centre, m   \param plane  height of the plane, m
[[nodiscard]] double sphere_volume_below(double radius, double centre, double plane);

/// Slabs of one thickness that a column is cut into.
struct Slabs {
  double area = 0;    ///< of the column's cross-section, m2
  double height = 0;  ///< of the column, m
  std::size_t count = 0;
  bool joined = false;             ///< what lies beyond one end of the column is at the other
  double image_speed = 0;          ///< along x, of the image of a particle one column up: of a sheared box, m/s
  std::vector<double> areas = {};  ///< of a tapered column the mean in each, m2; else empty
  [[nodiscard]] double thickness() const { return height / double(count); }
};

/// What fixes the units of the sums: over ranks, `particles` is added up and of the others the greatest is taken. In a
/// sheared box the images count, too.
struct ParticleExtremes {
  std::int64_t particles = 0;
  double volume = 0;    ///< V, m3
  double momentum = 0;  ///< V |u_a| along any axis a, m4/s
  double energy = 0;    ///< V |u|^2, m5/s2

  void add(double volume_of_one, const std::array<double, 3>& velocity);
};

/// Sums of V, V u_x, V u_y, V u_z and V |u|^2 over the parts of the particles in each slab, in whole units.
struct ParticleSums {
  static constexpr std::size_t quantities = 5;
  std::array<double, quantities> unit{};
  std::vector<std::int64_t> sum;  ///< [species][quantity][slab]; over ranks, to be added up
};

/// Makes them, particle by particle. A particle that is pressed into an end of the column counts where it would touch
/// it: a species' sum of V is that of its particles, each rounded to a unit. Only of one whose centre has left the
/// column, through an opening, the part that is still inside counts. Through joined ends a particle goes on at the
/// other one, in a sheared box with its image's velocity.
class ParticleAdder {
 public:
  /// \param all  of the particles on all ranks
  ParticleAdder(std::size_t species, const Slabs& slabs, const ParticleExtremes& all);
  /// \param centre  height, m
  void add(std::size_t species, double radius, double centre, const std::array<double, 3>& velocity);
  [[nodiscard]] ParticleSums take() { return std::move(sums_); }

 private:
  /// Slabs that a particle reaches into, counted on beyond the ends.
  struct Reach {
    double centre;  ///< m
    std::int64_t first, last;
  };
  [[nodiscard]] Reach reach_of(double radius, double centre) const;

  Slabs slabs_;
  double thickness_;                                       ///< m
  std::array<double, ParticleSums::quantities> per_unit_;  ///< one over the units
  ParticleSums sums_;
  double radius_ = 0;       ///< of the last one, m
  std::int64_t whole_ = 0;  ///< its volume in units
};

/// Means over slabs; where a species is absent its velocity and temperature are 0.
struct ParticleProfile {
  Profile solids;                                ///< phi_j; without pressure
  std::vector<std::vector<double>> velocity;     ///< vertical, weighted by volume, m/s, [species][slab]
  std::vector<std::vector<double>> temperature;  ///< theta = <|u - <u>|^2>/3, m2/s2; <u> of this slab and species
};
[[nodiscard]] ParticleProfile particle_profile(const ParticleSums& sums, std::size_t species, const Slabs& slabs);

/// A sum of numbers no greater than `most` that does not depend on their order.
class SteadySum {
 public:
  SteadySum(std::int64_t count, double most);
  void add(double value) { sum_ += std::llrint(value * per_unit_); }
  /// In whole units: over ranks, to be added up.
  [[nodiscard]] std::int64_t units() const { return sum_; }
  [[nodiscard]] double value_of(std::int64_t units) const { return double(units) / per_unit_; }

 private:
  double per_unit_;  ///< a power of two
  std::int64_t sum_ = 0;
};

}  // namespace polybed::measures
