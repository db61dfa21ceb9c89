// Places of hard spheres before the first step: sorted, so that neighbours are close in memory, with lists of possible
// contacts.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/numerics/inner_walls.hpp"
#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/contacts/neighbours.hpp"
#include "dem/particles.hpp"
#include "dem/tapered_side.hpp"

namespace polybed::dem {

/// Range of a whole particle, m; no limit along joined directions that it spans.
struct Region {
  Vector low, high;
  bool round = false;    ///< within the upright cylinder between these corners; it is as wide as deep
  TaperedSide side{};    ///< instead of that cylinder
  double of_sphere = 0;  ///< radius of a sphere that fits the tapered side and the walls: for bounds of a centre, m
  std::shared_ptr<const core::InnerWalls> walls{};  ///< walls inside that spheres lie between; null: none

  [[nodiscard]] double volume() const;
  /// Whether a place between the corners lies within the side of a round region and between walls inside.
  [[nodiscard]] bool within_side(const Vector& x) const {
    if (walls && walls->nearest(x).distance < of_sphere) return false;
    return !round || distance_from_axis(x) <= (side ? side.reach(x[1], of_sphere) : radius());
  }
  /// Moves a place outside the side of a round region onto it, and one in a wall inside out of it.
  void move_within_side(Vector& x) const;
  /// The box in which places are drawn before they are mapped into a round region; its height follows from the volume.
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

/// Places particles in a region, with overlaps. Some lie anywhere; the others, in random order, each in a part of the
/// region as large as its share of the volume. If all particles lay anywhere, they would be as uneven as an ideal gas,
/// and unevenness over many diameters takes longest to disappear.
void spread(std::vector<Particle*>& particles, const Region& region, std::uint64_t seed);

class HardSpheres {
 public:
  /// \param region  for each particle
  HardSpheres(const std::vector<Particle>& all, const std::vector<Region>& region, const Box& box,
              const Materials& materials);

  /// Lists pairs whose surfaces are nearer than the reach, m.
  void list(double reach);
  [[nodiscard]] const std::vector<Contacts::Pair>& pairs() const { return near_.pairs; }
  [[nodiscard]] const Vector& shift(std::int32_t image) const { return images_.shift[std::size_t(image)]; }
  /// Greatest overlap in any listed pair, over the smaller radius.
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

/// Moves spheres apart, lighter ones further, until none overlap; in a bed near the densest until overlaps are below a
/// thousandth of the smaller radius. Until then each pair has a random gap, as in a fluid of hard spheres: most pairs
/// pushed just to contact would stay in contact. Returns 0 or, if they do not fit, the remaining overlap over the
/// smaller radius. \param gap  m, the largest
[[nodiscard]] double push_apart(HardSpheres& spheres, double gap);

/// Sweeps of Metropolis et al. (J. Chem. Phys. 21, 1953): each sphere in turn tries a random step and takes it if it
/// overlaps none. This preserves the statistics of a fluid of hard spheres and drives any other arrangement to them.
/// \param fraction  of solids
void equilibrate(HardSpheres& spheres, double least_diameter, double fraction, std::uint64_t seed);

}  // namespace polybed::dem
