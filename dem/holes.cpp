#include "dem/holes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fluid/exits.hpp"

namespace polybed::dem {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;  // of the box's size

Opening rectangle(const core::Discharge& discharge, const Box& box, int dimensions) {
  const int axis = axis_of(discharge.at), side = side_of(discharge.at);
  Opening hole{axis, side, side * box.size[std::size_t(axis)], {}, {endless, endless, endless}};
  if (box.round && axis != 1) {
    hole.place = 0.5 * box.size[0];
    hole.about = InPlane{0.5 * box.size[0], 0.5 * box.size[2]};
  }
  for (std::size_t n = 0; n < std::min(discharge.from.size(), discharge.to.size()); ++n) {
    const auto k = std::size_t(axis_along(discharge.at, dimensions, n));
    hole.middle[k] = 0.5 * (discharge.from[n] + discharge.to[n]);
    hole.half[k] = 0.5 * (discharge.to[n] - discharge.from[n]);
  }
  return hole;
}

/// From the middle of a to that of b along an axis, m: the shorter way between joined faces.
double between(const Opening& a, const Opening& b, const Box& box, std::size_t k) {
  const double d = b.middle[k] - a.middle[k];
  return box.periodic[k] ? d - box.size[k] * std::round(d / box.size[k]) : d;
}

/// Between their edges along an axis, m; below 0: they overlap. Two without edges there overlap.
double gap(const Opening& a, const Opening& b, const Box& box, std::size_t k) {
  return std::abs(between(a, b, box, k)) - a.half[k] - b.half[k];
}

bool extend_alike(const Opening& a, const Opening& b, const Box& box, std::size_t k) {
  if (a.half[k] == endless || b.half[k] == endless) return a.half[k] == b.half[k];
  const double near = rounding * box.size[k];
  return std::abs(a.half[k] - b.half[k]) < near && std::abs(between(a, b, box, k)) < near;
}

/// Axis along which two holes of a face lie side by side and share an edge, or a part of it; 3: none.
std::size_t axis_of_joint(const Opening& a, const Opening& b, const Box& box) {
  if (a.axis != b.axis || a.side != b.side) return 3;
  const auto across = [&](std::size_t k) { return k != std::size_t(a.axis); };
  for (std::size_t k = 0; k < 3; ++k) {
    if (!across(k) || std::abs(gap(a, b, box, k)) > rounding * box.size[k]) continue;
    bool meet = true;
    for (std::size_t m = 0; m < 3; ++m)
      if (across(m) && m != k) meet = meet && gap(a, b, box, m) < -rounding * box.size[m];
    if (meet) return k;
  }
  return 3;
}

/// Takes b into a where they share a whole edge.
bool join(Opening& a, const Opening& b, const Box& box) {
  const std::size_t k = axis_of_joint(a, b, box);
  if (k == 3) return false;
  for (std::size_t m = 0; m < 3; ++m)
    if (m != k && m != std::size_t(a.axis) && !extend_alike(a, b, box, m)) return false;
  a.middle[k] += std::copysign(b.half[k], between(a, b, box, k));
  a.half[k] += b.half[k];
  return true;
}

void leave_out_rims_at_ends(Opening& hole, const Box& box) {
  constexpr double far = 100;  // sizes of the box
  for (std::size_t k = 0; k < 3; ++k) {
    const double size = box.size[k], near = rounding * size;
    if (k == std::size_t(hole.axis) || hole.half[k] == endless) continue;
    double low = hole.middle[k] - hole.half[k], high = hole.middle[k] + hole.half[k];
    if (2 * hole.half[k] >= size - near) {
      hole.middle[k] = 0;
      hole.half[k] = endless;
    } else if (!box.periodic[k] && (low <= near || high >= size - near)) {
      if (low <= near) low = -far * size;
      if (high >= size - near) high = far * size;
      hole.middle[k] = 0.5 * (low + high);
      hole.half[k] = 0.5 * (high - low);
    }
  }
}

}  // namespace

std::vector<Hole> rectangles_of(const core::Scene& scene, const Box& box) {
  std::vector<Hole> holes;
  for (std::size_t n = 0; n < scene.discharges.size(); ++n)
    holes.push_back({n, rectangle(scene.discharges[n], box, scene.column.dimensions)});
  for (std::size_t a = 0; a < holes.size(); ++a)
    for (std::size_t b = a + 1; b < holes.size();) {
      if (!join(holes[a].opening, holes[b].opening, box)) {
        ++b;
        continue;
      }
      holes.erase(holes.begin() + std::ptrdiff_t(b));
      a = 0;  // a larger hole may share an edge with one looked at before
      b = 1;
    }
  return holes;
}

std::vector<Hole> holes_of(const core::Scene& scene, const Box& box) {
  std::vector<Hole> holes = rectangles_of(scene, box);
  for (Hole& hole : holes) leave_out_rims_at_ends(hole.opening, box);
  return holes;
}

std::vector<Opening> exits_of(const core::Scene& scene, const Box& box) {
  const std::size_t count = fluid::names_of_exits(scene).size();
  std::vector<Opening> exits;
  for (std::size_t n = 0; n < scene.discharges.size() && count > 0; ++n)
    exits.push_back(rectangle(scene.discharges[n], box, scene.column.dimensions));
  if (exits.size() < count) exits.push_back({1, 1, box.size[1], {}, {endless, endless, endless}});
  return exits;
}

std::vector<std::pair<std::size_t, std::size_t>> touching_holes(const core::Scene& scene, const Box& box) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const std::vector<Hole> holes = rectangles_of(scene, box);
  for (std::size_t a = 0; a < holes.size(); ++a)
    for (std::size_t b = a + 1; b < holes.size(); ++b)
      if (axis_of_joint(holes[a].opening, holes[b].opening, box) != 3)
        pairs.emplace_back(holes[a].discharge, holes[b].discharge);
  return pairs;
}

}  // namespace polybed::dem
