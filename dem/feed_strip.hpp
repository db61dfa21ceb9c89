// The particles on all ranks near an end or a side of the box, which entering particles must not overlap.
#pragma once

#include <array>
#include <vector>

#include "core/case/choices.hpp"
#include "dem/box.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class Model;

/// Axes across a face of the column, along which a feed draws places.
[[nodiscard]] constexpr std::array<std::size_t, 2> across(core::ColumnFace at) {
  return {axis_of(at) == 0 ? std::size_t(1) : 0, axis_of(at) == 2 ? std::size_t(1) : 2};
}

/// Spheres in bins across the face, as wide as the largest sphere. The same on every rank.
class FeedStrip {
 public:
  /// Collective.
  FeedStrip(const Model& model, core::ColumnFace at);

  /// Whether a sphere overlaps neither a sphere in the strip or its image, nor a plate inside the box, nor the side of
  /// a round one.
  [[nodiscard]] bool has_room_for(const Place& sphere) const;
  void add(const Place& sphere);

 private:
  [[nodiscard]] std::size_t bin(int i, int k) const;
  [[nodiscard]] int place_of(double x, std::size_t n) const;
  [[nodiscard]] bool overlap(const Place& a, const Place& b) const;

  const Box& box_;
  std::array<std::size_t, 2> across_;       ///< axes of the bins
  std::array<int, 2> bins_{};               ///< along them
  std::vector<std::vector<Place>> inside_;  ///< for each bin
};

}  // namespace polybed::dem
