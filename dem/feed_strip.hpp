// The particles near an end of the box, of all ranks: what those that enter there must not overlap.
#pragma once

#include <array>
#include <vector>

#include "dem/box.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class Model;

/// Spheres in bins across the end, as wide as the largest of them. The same on every rank.
class FeedStrip {
 public:
  /// Collective. \param top  the end at the top, or that at the bottom
  FeedStrip(const Model& model, bool top);

  /// Whether a sphere would overlap none of those in the strip, no image of one, no plate inside the box, and not the
  /// side of a round one.
  [[nodiscard]] bool has_room_for(const Place& sphere) const;
  void add(const Place& sphere);

 private:
  [[nodiscard]] std::size_t bin(int i, int k) const;
  [[nodiscard]] int place_of(double x, std::size_t n) const;
  [[nodiscard]] bool overlap(const Place& a, const Place& b) const;

  const Box& box_;
  std::array<int, 2> bins_{};               ///< along x and z
  std::vector<std::vector<Place>> inside_;  ///< of each bin
};

}  // namespace polybed::dem
