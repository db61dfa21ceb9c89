// The room for spheres within the side of a round box whose diameter changes with height.
#pragma once

#include <memory>

#include "core/case/scene.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class TaperedSide {
 public:
  /// For a column with constant diameter: false as a bool.
  TaperedSide() = default;
  explicit TaperedSide(const core::Column& column);

  [[nodiscard]] explicit operator bool() const { return column_ != nullptr; }
  /// Greatest distance of a sphere's centre from the axis at a height, m. The side continues straight beyond the ends.
  [[nodiscard]] double reach(double height, double radius) const;
  /// Moves a sphere that the side cuts along the normals of the walls, as far as its range of heights allows, and the
  /// rest towards the axis.
  void move_inside(Vector& x, double radius, double low, double high) const;
  /// Volume below a height over the widest cross-section, m, and its inverse.
  [[nodiscard]] double even_height(double height) const { return column_->even_height(height) * per_widest_; }
  [[nodiscard]] double height_of(double even) const { return column_->filled_height(even / per_widest_); }
  /// Radius at a height over the greatest.
  [[nodiscard]] double narrowing(double height) const;

 private:
  struct Part {
    double y, r, along_y, along_r;  ///< one end, and the vector to the other, m
  };
  [[nodiscard]] double from_axis(const Vector& x) const;
  void scale_away(Vector& x, double by) const;

  std::shared_ptr<const core::Column> column_;
  std::vector<Part> parts_;  ///< from the bottom, with straight ones below and above
  double per_widest_ = 1;    ///< cross-section at the bottom over the widest
};

}  // namespace polybed::dem
