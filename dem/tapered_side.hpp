// The room for spheres within the side of a round box whose diameter changes with the height.
#pragma once

#include <memory>

#include "core/case/scene.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class TaperedSide {
 public:
  /// Of a column whose diameter does not change: false as a bool.
  TaperedSide() = default;
  explicit TaperedSide(const core::Column& column);

  [[nodiscard]] explicit operator bool() const { return column_ != nullptr; }
  /// How far from the axis the centre of a sphere may be at a height, m. Beyond the ends the side goes on straight.
  [[nodiscard]] double reach(double height, double radius) const;
  /// Moves a sphere that the side cuts along the normals of the walls, as far as the heights allow that its centre may
  /// have, and what is left towards the axis.
  void move_inside(Vector& x, double radius, double low, double high) const;
  /// Volume below a height over the widest cross-section, m, and the inverse.
  [[nodiscard]] double even_height(double height) const { return column_->even_height(height) * per_widest_; }
  [[nodiscard]] double height_of(double even) const { return column_->filled_height(even / per_widest_); }
  /// Radius at a height over the greatest.
  [[nodiscard]] double narrowing(double height) const;

 private:
  struct Part {
    double y, r, along_y, along_r;  ///< one end, and from there to the other, m
  };
  [[nodiscard]] double from_axis(const Vector& x) const;
  void scale_away(Vector& x, double by) const;

  std::shared_ptr<const core::Column> column_;
  std::vector<Part> parts_;  ///< from the bottom, with straight ones below and above
  double per_widest_ = 1;    ///< cross-section at the bottom over the widest
};

}  // namespace polybed::dem
