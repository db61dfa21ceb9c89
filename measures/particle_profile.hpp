// Vertical profile of particles, with the exact part of each sphere between two planes. measures/bed thus measures a
// bed of particles and a continuum by one definition.
//
// Sums use whole numbers: the result has the same bits for any order of the particles, and for any number of ranks if
// the units (agreed first) and the sums are added up over them.
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

/// The slabs of equal thickness in a column.
struct Slabs {
  double area = 0;    ///< of the column's cross-section, m2
  double height = 0;  ///< of the column, m
  std::size_t count = 0;
  bool joined = false;             ///< the ends of the column are joined
  double image_speed = 0;          ///< along x, of a particle's image one column higher in a sheared box, m/s
  std::vector<double> areas = {};  ///< for a tapered column the mean in each, m2; else empty
  [[nodiscard]] double thickness() const { return height / double(count); }
};

/// Values that set the units of the sums. Over ranks, add up `particles` and take the greatest of the others. In a
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
  std::vector<std::int64_t> sum;  ///< [species][quantity][slab]; add up over ranks
};

/// Computes the sums, particle by particle. A particle pressed into an end of the column is moved to the point where it
/// touches the end: a species' sum of V is then the sum over its particles, each rounded to a unit. Only the part
/// inside counts for a particle whose centre has left through an opening. At joined ends a particle continues at the
/// other end, in a sheared box with its image's velocity.
class ParticleAdder {
 public:
  /// \param all  over the particles on all ranks
  ParticleAdder(std::size_t species, const Slabs& slabs, const ParticleExtremes& all);
  /// \param centre  height, m
  void add(std::size_t species, double radius, double centre, const std::array<double, 3>& velocity);
  [[nodiscard]] ParticleSums take() { return std::move(sums_); }

 private:
  /// Slabs that a particle overlaps, numbered beyond the ends too.
  struct Reach {
    double centre;  ///< m
    std::int64_t first, last;
  };
  [[nodiscard]] Reach reach_of(double radius, double centre) const;

  Slabs slabs_;
  double thickness_;                                       ///< m
  std::array<double, ParticleSums::quantities> per_unit_;  ///< one over the units
  ParticleSums sums_;
  double radius_ = 0;       ///< of the last particle, m
  std::int64_t whole_ = 0;  ///< its volume in units
};

/// Means over slabs; where a species is absent its velocity and temperature are 0.
struct ParticleProfile {
  Profile solids;                                ///< phi_j; without pressure
  std::vector<std::vector<double>> velocity;     ///< vertical, weighted by volume, m/s, [species][slab]
  std::vector<std::vector<double>> temperature;  ///< theta = <|u - <u>|^2>/3, m2/s2; <u> of this slab and species
};
[[nodiscard]] ParticleProfile particle_profile(const ParticleSums& sums, std::size_t species, const Slabs& slabs);

/// A sum that does not depend on the order of its terms, none above `most`.
class SteadySum {
 public:
  SteadySum(std::int64_t count, double most);
  void add(double value) { sum_ += std::llrint(value * per_unit_); }
  /// In whole units; add up over ranks.
  [[nodiscard]] std::int64_t units() const { return sum_; }
  [[nodiscard]] double value_of(std::int64_t units) const { return double(units) / per_unit_; }

 private:
  double per_unit_;  ///< a power of two
  std::int64_t sum_ = 0;
};

}  // namespace polybed::measures
