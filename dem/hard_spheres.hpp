// Places of hard spheres before the first step: sorted, so that near ones are near in memory, with lists of those that
// may touch.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/contacts/neighbours.hpp"
#include "dem/particles.hpp"
#include "dem/tapered_side.hpp"

namespace polybed::dem {

/// Where a particle may be as a whole, m; no limit along joined directions that it spans.
struct Region {
  Vector low, high;
  bool round = false;    ///< within the upright cylinder that fits between these corners; it is as wide as deep
  TaperedSide side{};    ///< instead of that cylinder
  double of_sphere = 0;  ///< radius for which the tapered side leaves room: of bounds of a centre, m

  [[nodiscard]] double volume() const;
  /// Whether a place between the corners lies within the side of a round one.
  [[nodiscard]] bool within_side(const Vector& x) const {
    return !round || distance_from_axis(x) <= (side ? side.reach(x[1], of_sphere) : radius());
  }
  /// Moves a place outside the side of a round one to it.
  void move_within_side(Vector& x) const;
  /// The box that places are drawn from which are then mapped into a round one: as high as its volume demands.
  [[nodiscard]] Region even() const;
  /// Maps a place in that box into the round one, equal volumes to equal volumes: the concentric map of Shirley and
  /// Chiu (J. Graphics Tools 2 (3), 1997, 45), scaled to the radius at its height.
  [[nodiscard]] Vector mapped_within_side(const Vector& x) const;

 private:
  [[nodiscard]] double radius() const { return 0.5 * (high[0] - low[0]); }
  [[nodiscard]] std::array<double, 2> from_axis(const Vector& x) const {
    return {x[0] - 0.5 * (low[0] + high[0]), x[2] - 0.5 * (low[2] + high[2])};
  }
  [[nodiscard]] double distance_from_axis(const Vector& x) const;
};

/// Places particles in a region, whatever their overlaps. Some lie anywhere; the others, in random order, each in a
/// part of the region as large as its share of the volume. Particles that all lay anywhere would be as uneven as an
/// ideal gas, and what is uneven over many diameters takes longest to even out.
void spread(std::vector<Particle*>& particles, const Region& region, std::uint64_t seed);

class HardSpheres {
 public:
  /// \param region  of each particle
  HardSpheres(const std::vector<Particle>& all, const std::vector<Region>& region, const Box& box,
              const Materials& materials);

  /// Lists pairs whose surfaces are nearer than the reach, m.
  void list(double reach);
  [[nodiscard]] const std::vector<Contacts::Pair>& pairs() const { return near_.pairs; }
  [[nodiscard]] const Vector& shift(std::int32_t image) const { return images_.shift[std::size_t(image)]; }
  /// Overlap of any listed pair at most, over the smaller radius.
  [[nodiscard]] double greatest_overlap() const;

  [[nodiscard]] std::vector<Place>& places() { return particles_.place; }
  [[nodiscard]] double inverse_mass(std::int32_t i) const { return particles_.motion[std::size_t(i)].inverse_mass; }
  /// For the centres.
  [[nodiscard]] const std::vector<Region>& bounds() const { return bounds_; }

  void give_back(std::vector<Particle>& all) const;

 private:
  Box box_;
  const Materials& materials_;
  Images images_;
  Particles particles_;
  std::vector<Region> bounds_;
  std::vector<std::int32_t> order_;
  Contacts near_;
};

/// Moves spheres apart, lighter ones further, until none overlap; in a bed near the densest by less than a thousandth
/// of the smaller radius. Until then each pair is held at a random gap, as in a fluid of hard spheres: pushed to
/// contact alone, most would end in contact.
/// Returns 0, or, if they do not fit, the overlap that is left over the smaller radius. \param gap  m, the largest
[[nodiscard]] double push_apart(HardSpheres& spheres, double gap);

/// Sweeps of Metropolis et al. (J. Chem. Phys. 21, 1953): each sphere in turn tries a random step and takes it if it
/// overlaps none. This leaves the statistics of a fluid of hard spheres as they are, and any others it brings there.
/// \param fraction  of solids
void equilibrate(HardSpheres& spheres, double least_diameter, double fraction, std::uint64_t seed);

}  // namespace polybed::dem
