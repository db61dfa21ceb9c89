#include "dem/tapered_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polybed::dem {

TaperedSide::TaperedSide(const core::Column& column) : column_(std::make_shared<core::Column>(column)) {
  const auto& profile = column.profile;
  const double far = 100 * profile.back().first;
  parts_.push_back({-far, 0.5 * profile.front().second, far, 0});
  for (std::size_t n = 1; n < profile.size(); ++n) {
    const auto& [low, below] = profile[n - 1];
    const auto& [high, above] = profile[n];
    parts_.push_back({low, 0.5 * below, high - low, 0.5 * (above - below)});
  }
  parts_.push_back({profile.back().first, 0.5 * profile.back().second, far, 0});
  const double narrowing = profile.front().second / column.widest();
  per_widest_ = narrowing * narrowing;
}

double TaperedSide::narrowing(double height) const { return column_->diameter_at(height) / column_->widest(); }

double TaperedSide::from_axis(const Vector& x) const {
  return std::hypot(x[0] - 0.5 * column_->size[0], x[2] - 0.5 * column_->size[2]);
}

void TaperedSide::scale_away(Vector& x, double by) const {
  for (const std::size_t k : {0, 2}) x[k] = 0.5 * column_->size[k] + by * (x[k] - 0.5 * column_->size[k]);
}

/// A sphere touches a sloping part at one height, s r/sqrt(1 + s^2) below its centre, s = dR/dy; else it touches an end
/// of the part.
double TaperedSide::reach(double height, double radius) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) {
    const double above = part.y - height;
    if (std::abs(above) < radius) least = std::min(least, part.r - std::sqrt(radius * radius - above * above));
    if (!(part.along_y > 0)) continue;
    const double slope = part.along_r / part.along_y, longer = std::sqrt(1 + slope * slope);
    const double touched = -above - slope * radius / longer;
    if (touched >= 0 && touched <= part.along_y) least = std::min(least, part.r - slope * above - radius * longer);
  }
  return least;
}

/// At a tiny distance from the walls: round-off could otherwise put it in a step, whose rim would push it far inwards.
void TaperedSide::move_inside(Vector& x, double radius, double low, double high) const {
  constexpr double hair = 1 + 0x1p-30;
  if (from_axis(x) <= reach(x[1], radius)) return;
  for (const Part& part : parts_) {
    const double away = from_axis(x), y = x[1] - part.y, r = away - part.r,
                 square = part.along_y * part.along_y + part.along_r * part.along_r, length = std::sqrt(square);
    const double along = y * part.along_y + r * part.along_r, inward = (y * part.along_r - r * part.along_y) / length;
    if (!(along >= 0 && along <= square) || std::abs(inward) >= radius) continue;
    const double push = (hair * radius - inward) / length;
    x[1] += push * part.along_r;
    if (away > 0) scale_away(x, std::max(0.0, 1 - push * part.along_y / away));
  }
  x[1] = std::clamp(x[1], low, high);
  if (const double away = from_axis(x), most = reach(x[1], radius); away > most)
    scale_away(x, std::max(0.0, most / away));
}

}  // namespace polybed::dem
