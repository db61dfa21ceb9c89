#include "dem/box.hpp"

namespace polybed::dem {

namespace {

/// Whether a point lies on a plate, to rounding.
bool lies_on(const Plate& plate, const Vector& point) {
  const Vector away = plate.to(point);
  return plate.per_square * (away[0] * away[0] + away[1] * away[1]) < 1e-18;
}

}  // namespace

Vector Box::wrapped(Vector x) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (periodic[k]) {
      x[k] -= std::floor(x[k] / size[k]) * size[k];
      if (x[k] >= size[k]) x[k] = 0;  // of a tiny negative number, whose sum with the length is the length
    }
  return x;
}

void Box::add_plate(const Plate& plate) {
  const auto join = [this](int a, int b) {
    const Plate &one = plates[std::size_t(a)], &other = plates[std::size_t(b)];
    const Vector first{one.x, one.y, 0}, second{one.x + one.along_x, one.y + one.along_y, 0};
    if (lies_on(other, first)) joints.push_back({a, Plate::Part::first_edge, b, other.nearest(first)});
    if (lies_on(other, second)) joints.push_back({a, Plate::Part::second_edge, b, other.nearest(second)});
  };
  const int added = int(plates.size());
  walls.push_back({0, 0, 0, added});
  plates.push_back(plate);
  for (int before = 0; before < added; ++before) {
    join(before, added);
    join(added, before);
  }
}

bool Box::pushes(int plate, const Vector& centre) const {
  const Plate::Part part = plates[std::size_t(plate)].nearest(centre);
  if (part == Plate::Part::face) return true;
  for (const Joint& joint : joints) {
    if (joint.plate != plate || joint.edge != part) continue;
    const Plate::Part nearest = plates[std::size_t(joint.other)].nearest(centre);
    if (nearest == Plate::Part::face || (nearest == joint.at && joint.other < plate)) return false;
  }
  return true;
}

}  // namespace polybed::dem
