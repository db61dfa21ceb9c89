#include "dem/box.hpp"

namespace polybed::dem {

namespace {

/// Bands with equal steps in curvature, which changes along a cone. Within one of them the force of a contact changes
/// by at most 1.6 % at the end of a cone that is two particles wide there, by 0.4 % at five.
constexpr int bands_of_cone = 16;

/// Whether a point lies on a plate, to rounding.
bool lies_on(const Plate& plate, const InPlane& point) {
  const InPlane away = plate.from_middle(point);
  return (away[0] * away[0] + away[1] * away[1]) * plate.per_square < 1e-18;
}

/// Distance of the surfaces of two plates, in their plane; below 0 if they overlap.
double distance_between(const Plate& one, const Plate& other) {
  const auto side = [](const Plate& plate, double x, double y) {
    return plate.along_x * (y - plate.y) - plate.along_y * (x - plate.x);
  };
  const auto crosses = [&](const Plate& a, const Plate& b) {
    return side(a, b.x, b.y) * side(a, b.x + b.along_x, b.y + b.along_y) < 0;
  };
  double least = crosses(one, other) && crosses(other, one) ? 0 : std::numeric_limits<double>::infinity();
  const auto see = [&](const Plate& plate, double x, double y) {
    least = std::min(least, plate.distance_from_middle({x, y}));
  };
  see(one, other.x, other.y);
  see(one, other.x + other.along_x, other.y + other.along_y);
  see(other, one.x, one.y);
  see(other, one.x + one.along_x, one.y + one.along_y);
  return least - one.half - other.half;
}

/// Lengths up to this share of a wall's thickness are round-off.
constexpr double round_off = 1e-9;

}  // namespace

/// Curvatures alternate between inside and outside, band by band from the first edge.
int Plate::curve_at(const Vector& centre) const {
  if (!round && half > 0) return nearest(in_plane(centre)) == Part::face ? 0 : 1 + first_curve;
  if (curve_bands == 0) return 0;
  const InPlane point = in_plane(centre);
  const double at = share(point);
  if (!(at >= 0 && at <= 1)) return 0;
  const double rho = x + at * along_x;
  const double through = rho > 0 ? at * (x + along_x) / rho : 0;  // share of the change in curvature, as 1/rho changes
  const int band = std::min(int(through * curve_bands), curve_bands - 1);
  return 1 + first_curve + 2 * band + (from_middle(point)[0] > 0 ? 1 : 0);
}

Vector Box::wrapped(Vector x) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (periodic[k]) {
      x[k] -= std::floor(x[k] / size[k]) * size[k];
      if (x[k] >= size[k]) x[k] = 0;  // for a tiny negative number, which plus the length rounds to the length
    }
  return x;
}

bool Box::within_side(const Place& sphere) const {
  if (!round) return true;
  const double radius = 0.5 * size[0], dx = sphere.x[0] - radius, dz = sphere.x[2] - radius;
  const double away = std::sqrt(dx * dx + dz * dz);
  return side ? away <= side.reach(sphere.x[1], sphere.radius) : away + sphere.radius <= radius;
}

int Box::joined(const Plate& plate) {
  const auto join = [this](int a, int b) {
    const Plate &one = plates[std::size_t(a)], &other = plates[std::size_t(b)];
    if (const double half = one.half + other.half; half > 0) {
      if (distance_between(one, other) < round_off * half) overlaps.push_back({a, b});
      return;
    }
    const InPlane first{one.x, one.y}, second{one.x + one.along_x, one.y + one.along_y};
    if (lies_on(other, first)) joints.push_back({a, Plate::Part::first_edge, b, other.nearest(first)});
    if (lies_on(other, second)) joints.push_back({a, Plate::Part::second_edge, b, other.nearest(second)});
  };
  const int added = int(plates.size());
  plates.push_back(plate);
  for (int before = 0; before < added; ++before) {
    join(before, added);
    join(added, before);
  }
  return added;
}

Plate Box::about_axis(const InPlane& from, const InPlane& to) const {
  Plate plate(from[0], from[1], to[0], to[1]);
  plate.round = true;
  plate.axis_x = 0.5 * size[0];
  plate.axis_z = 0.5 * size[2];
  return plate;
}

/// The edges of a thick plate curve with half its thickness.
void Box::add_plate(Plate plate, double thickness) {
  plate.half = 0.5 * thickness;
  plate.first_curve = int(curvatures.size());
  if (thickness > 0) curvatures.push_back(-1 / plate.half);
  walls.push_back({0, 0, 0, joined(plate)});
}

/// A cone of half angle a curves with the radius rho/cos(a) about its normal at a distance rho from its axis; its
/// surfaces with half its thickness less or more. The inside of a solid one has no contacts.
void Box::add_cone(const InPlane& from, const InPlane& to, double thickness) {
  Plate plate = about_axis(from, to);
  plate.half = 0.5 * thickness;
  const double cosine = std::abs(plate.along_y) * std::sqrt(plate.per_square);
  plate.first_curve = int(curvatures.size());
  plate.curve_bands = cosine == 0 ? 0 : (plate.along_x == 0 ? 1 : bands_of_cone);
  for (int band = 0; band < plate.curve_bands; ++band) {
    const double through = (band + 0.5) / plate.curve_bands;
    const double curvature = cosine * ((1 - through) / from[0] + through / to[0]);
    const double radius = 1 / curvature, inside = radius - plate.half;
    if (thickness == 0)
      curvatures.insert(curvatures.end(), {curvature, -curvature});
    else
      curvatures.insert(curvatures.end(), {inside > 0 ? 1 / inside : 0, -1 / (radius + plate.half)});
  }
  walls.push_back({0, 0, 0, joined(plate)});
}

/// The rim follows the curved side: two upright edges and two arcs.
std::optional<Vector> Opening::from_curved_rim(const Vector& centre) const {
  const auto a = std::size_t(axis), c = 2 - a;
  const InPlane middle_of_box = *about;
  const double dx = centre[0] - middle_of_box[0], dz = centre[2] - middle_of_box[1],
               away = std::sqrt(dx * dx + dz * dz);
  const double ahead = (side == 0 ? -1 : 1) * (a == 0 ? dx : dz);
  if (!(ahead > 0)) return {};
  const double axis_c = a == 0 ? middle_of_box[1] : middle_of_box[0],
               axis_a = a == 0 ? middle_of_box[0] : middle_of_box[1];
  const double foot = axis_c + place / away * (a == 0 ? dz : dx);  // of the centre on the side
  if (std::abs(foot - middle[c]) >= half[c] || std::abs(centre[1] - middle[1]) >= half[1]) return {};
  Vector nearest{};
  double least = std::numeric_limits<double>::infinity();
  const auto see = [&](const Vector& from) {
    const double square = from[0] * from[0] + from[1] * from[1] + from[2] * from[2];
    if (square >= least) return;
    least = square;
    nearest = from;
  };
  for (const double end : {-1.0, 1.0}) {
    const double edge = middle[c] + end * half[c], chord = edge - axis_c;
    Vector upright{};
    upright[c] = centre[c] - edge;
    upright[a] = centre[a] - axis_a - (side == 0 ? -1 : 1) * std::sqrt(place * place - chord * chord);
    see(upright);
    const double out = 1 - place / away;
    see({out * dx, centre[1] - middle[1] - end * half[1], out * dz});
  }
  return nearest;
}

std::optional<Vector> Opening::from_rim(const Vector& centre) const {
  if (about) return from_curved_rim(centre);
  const auto toward = [&](double to, double away, double width) {
    return away == 0 ? -width : (1 - width / away) * to;
  };
  Vector from{};
  from[std::size_t(axis)] = centre[std::size_t(axis)] - place;
  if (round) {
    const double dx = centre[0] - middle[0], dz = centre[2] - middle[2], away = std::sqrt(dx * dx + dz * dz);
    if (away >= half[0]) return {};
    from[0] = toward(dx, away, half[0]);
    from[2] = away == 0 ? 0 : toward(dz, away, half[0]);
    return from;
  }
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = 3;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == std::size_t(axis)) continue;
    const double gap = half[k] - std::abs(centre[k] - middle[k]);
    if (gap <= 0) return {};
    if (gap < least) {
      least = gap;
      nearest = k;
    }
  }
  if (nearest == 3)
    from[std::size_t(axis)] = least;
  else
    from[nearest] =
        toward(centre[nearest] - middle[nearest], std::abs(centre[nearest] - middle[nearest]), half[nearest]);
  return from;
}

Vector Box::beside(const Opening& opening, Vector centre) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (periodic[k]) centre[k] -= size[k] * std::round((centre[k] - opening.middle[k]) / size[k]);
  return centre;
}

std::optional<Vector> Box::from_opened(int axis, int side, const Vector& centre) const {
  const Opening* face = nullptr;
  for (const Opening& opening : openings) {
    if (opening.axis != axis || opening.side != side) continue;
    if (const auto from = opening.from_rim(beside(opening, centre))) return from;
    face = &opening;
  }
  if (face == nullptr) return {};
  Vector straight{};
  straight[std::size_t(axis)] = centre[std::size_t(axis)] - face->place;
  return straight;
}

Vector Box::from_plate(int plate, const Vector& centre) const {
  for (std::size_t n = 0; plate == side_plate && n < openings.size(); ++n)
    if (const Opening& opening = openings[n]; opening.about)
      if (const auto from = opening.from_rim(centre)) return *from;
  return plates[std::size_t(plate)].to(centre);
}

bool Box::rim_is_edge(int axis, const Vector& centre, const Vector& from_rim) const {
  Vector point;
  bool straight = true;
  for (std::size_t k = 0; k < 3; ++k) {
    point[k] = centre[k] - from_rim[k];
    straight = straight && (k == std::size_t(axis) || from_rim[k] == 0);
  }
  const double near = 1e-9 * size[1];
  return !straight && std::any_of(plates.begin(), plates.end(), [&](const Plate& plate) {
    const InPlane away = plate.from_middle({point[0], point[1]});
    return !plate.round && std::hypot(away[0], away[1]) < near &&
           (axis == 2 || plate.nearest({point[0], point[1]}) != Plate::Part::face);
  });
}

bool Box::in_line(const Opening& face, const Vector& centre) const {
  return std::any_of(openings.begin(), openings.end(), [&](const Opening& opening) {
    return opening.is_beside(face) && opening.from_rim(beside(opening, centre));
  });
}

/// It extends beyond the corners, so that particles meet only the rim of the opening as an edge.
void Box::make_bottom_a_plate() {
  const auto hole = std::find_if(openings.begin(), openings.end(), [](const Opening& o) { return o.is_bottom(); });
  const double rim = hole != openings.end() ? hole->half[0] : 0, beyond = size[0] + size[2];
  const int plate = joined(about_axis({rim, 0}, {beyond, 0}));
  for (Wall& wall : walls)
    if (wall.plate < 0 && wall.is_bottom()) wall.plate = plate;
}

/// Whether the point of a plate's surface nearest to a point outside lies in another plate, or on it: then the nearer
/// of both plates pushes, of two alike the one with the lower number.
bool Box::is_covered(int plate, const InPlane& point) const {
  const Plate& one = plates[std::size_t(plate)];
  const InPlane away = one.to(point), on_surface{point[0] - away[0], point[1] - away[1]};
  return std::any_of(overlaps.begin(), overlaps.end(), [&](const std::array<int, 2>& pair) {
    if (pair[0] != plate) return false;
    const Plate& other = plates[std::size_t(pair[1])];
    const double length = round_off * (one.half + other.half), inside = other.gap(on_surface);
    if (inside > length) return false;
    const double nearer = one.gap(point) - other.gap(point);
    return inside < -length || nearer > length || pair[1] < plate;
  });
}

bool Box::pushes(int plate, const Vector& centre) const {
  const Plate& one = plates[std::size_t(plate)];
  const InPlane point = one.in_plane(centre);  // the same for all plates that it joins
  if (!overlaps.empty() && is_covered(plate, point)) return false;
  const Plate::Part part = one.nearest(point);
  if (part == Plate::Part::face) return true;
  for (const Joint& joint : joints) {
    if (joint.plate != plate || joint.edge != part) continue;
    const Plate::Part nearest = plates[std::size_t(joint.other)].nearest(point);
    if (nearest == Plate::Part::face || (nearest == joint.at && joint.other < plate)) return false;
  }
  return true;
}

}  // namespace polybed::dem
