// Places of hard spheres before the first step: sorted, so that near ones are near in memory, with lists of those that
// may touch.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/box.hpp"
#include "dem/contacts/materials.hpp"
#include "dem/contacts/neighbours.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Where a particle may be as a whole, m; no limit along joined directions that it spans.
struct Region {
  Vector low, high;
};

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
  [[nodiscard]] Vector wrapped(Vector x) const;

  Box box_;
  const Materials& materials_;
  Images images_;
  Particles particles_;
  std::vector<Region> bounds_;
  std::vector<std::int32_t> order_;
  Contacts near_;
};

}  // namespace polybed::dem
