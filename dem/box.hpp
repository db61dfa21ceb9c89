// The space of the particles: its size, its walls, and the positions of a particle's images.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#ifdef __x86_64__
#include <emmintrin.h>
#endif

#include "core/numerics/wall_profile.hpp"
#include "dem/particles.hpp"
#include "dem/tapered_side.hpp"

namespace polybed::dem {

using core::InPlane;

/// An opening in a face of the box, or the whole of an open top. The face is a plate without thickness, with a sharp
/// rim: particles beyond it meet it from outside.
struct Opening {
  int axis = 1, side = 0;   ///< of the face, as in Wall
  double place = 0;         ///< of the face, m
  Vector middle{}, half{};  ///< centre and half widths, m; meaningless along the axis; infinite: no rim
  bool round = false;       ///< a hole in the bottom with the radius half[0]; else a rectangle
  /// For a hole in the side of a round box, seen along its axis: `place` is the side's distance from the box's axis.
  std::optional<InPlane> about = {};  ///< x and z of that axis, m

  [[nodiscard]] bool is_bottom() const { return axis == 1 && side == 0; }
  [[nodiscard]] bool is_top() const { return axis == 1 && side == 1; }
  [[nodiscard]] bool is_beside(const Opening& other) const {
    return (about && other.about) || (axis == other.axis && side == other.side);
  }
  /// A coordinate along the outward normal, m, for a centre or for the face.
  [[nodiscard]] double outward(double along) const { return side == 0 && !about ? -along : along; }
  [[nodiscard]] double outward(const Vector& centre) const {
    return about ? std::hypot(centre[0] - (*about)[0], centre[2] - (*about)[1]) : outward(centre[std::size_t(axis)]);
  }
  /// Vector to a centre in line with the opening from the nearest point of the rim, m, infinite without one; nothing if
  /// the centre is not in line.
  [[nodiscard]] std::optional<Vector> from_rim(const Vector& centre) const;

 private:
  [[nodiscard]] std::optional<Vector> from_curved_rim(const Vector& centre) const;
};

/// A wall inside the box, which particles meet from both sides and from its edges. Its middle has a straight profile in
/// a plane: flat plates lie along z from end to end; round ones are cones about an upright axis.
struct Plate : core::WallProfile {
  bool round = false;
  double axis_x = 0, axis_z = 0;         ///< for a round one, m
  int first_curve = 0, curve_bands = 0;  ///< place of its curvatures in the box's list; bands of a round one

  using core::WallProfile::to;
  using core::WallProfile::WallProfile;

  [[nodiscard]] InPlane in_plane(const Vector& centre) const {
    if (!round) return {centre[0], centre[1]};
    const double dx = centre[0] - axis_x, dz = centre[2] - axis_z;
    return {std::sqrt(dx * dx + dz * dz), centre[1]};
  }
  /// Vector to a centre from the nearest point on the surface of the plate, m. On the axis of a round one, along x.
  [[nodiscard]] Vector to(const Vector& centre) const {
    const InPlane point = in_plane(centre), away = to(point);
    if (!round || point[0] == 0) return {away[0], away[1], 0};
    const double outward = away[0] / point[0];
    return {outward * (centre[0] - axis_x), away[1], outward * (centre[2] - axis_z)};
  }
  enum class Part { first_edge, face, second_edge };
  /// The part of it nearest to a point. The width given to edges keeps rounding from finding two faces, or none, at a
  /// joint.
  [[nodiscard]] Part nearest(const InPlane& point) const {
    constexpr double width = 1e-9;
    const double at = share(point);
    return at < width ? Part::first_edge : (at > 1 - width ? Part::second_edge : Part::face);
  }
  /// Number of the curvature at a sphere's contact, from 1; 0: the plate is flat there, or a round one ends.
  [[nodiscard]] int curve_at(const Vector& centre) const;
};

/// An edge of a plate on another plate.
struct Joint {
  int plate = 0;
  Plate::Part edge{};
  int other = 0;
  Plate::Part at{};  ///< part of the other plate
};

/// A wall at rest: a face of the box, or a plate.
struct Wall {
  int axis = 0;      ///< 0, 1, 2
  int side = 0;      ///< 0: at 0, 1: at the far end
  double place = 0;  ///< m
  int plate = -1;    ///< index; -1: a face. For a plate the rest has no meaning, except for a bottom that is one
  [[nodiscard]] bool is_bottom() const { return axis == 1 && side == 0; }
};

struct Box {
  Vector size{};  ///< along x, y (up), z, m
  std::array<bool, 3> periodic{};
  std::vector<Wall> walls;                   ///< whole faces, except periodic and open ones; then plates
  std::vector<Plate> plates;                 ///< inside; flat or round ones, and the side of a round box
  std::vector<Joint> joints;                 ///< between the plates without thickness
  std::vector<std::array<int, 2>> overlaps;  ///< two plates that touch, one of them thick, in both orders
  std::vector<double> curvatures;  ///< of contacts with round plates, 1/m: above 0 from inside, below 0 from outside
  bool round = false;              ///< its cross-section is the circle within its width and depth
  int side_plate = -1;             ///< its side, as a plate
  TaperedSide side;                ///< for a round box whose diameter changes
  std::vector<Opening> openings;   ///< through which particles leave; empty: all faces are closed
  double shear_rate = 0;           ///< Lees and Edwards: d v_x/d y, 1/s; then y is periodic
  double strain_before = 0;        ///< strain before time 0

  /// Whether all its walls are whole faces; an open top is not.
  [[nodiscard]] bool plain() const {
    return plates.empty() && std::all_of(openings.begin(), openings.end(), [](const Opening& o) { return o.is_top(); });
  }
  /// Vector to a centre from the nearest point of a face with openings, m: perpendicular, or from the rim; nothing if
  /// the face is whole. A sphere that fits through an opening touches one part of its rim at a time.
  [[nodiscard]] std::optional<Vector> from_opened(int axis, int side, const Vector& centre) const;
  /// Vector to a centre from the nearest point of a plate; for the side of a round box, of what its holes leave.
  [[nodiscard]] Vector from_plate(int plate, const Vector& centre) const;
  /// Whether a flat plate ends where a centre is nearest to a rim, or lies along it: the plate pushes, the rim does not
  /// push again.
  /// \param from_rim  as of from_opened
  [[nodiscard]] bool rim_is_edge(int axis, const Vector& centre, const Vector& from_rim) const;
  /// Whether a centre is in line with one of the openings that a face has.
  [[nodiscard]] bool in_line(const Opening& face, const Vector& centre) const;

  /// A place wrapped between the joined faces of a box at rest.
  [[nodiscard]] Vector wrapped(Vector x) const;
  /// Distance of a place from the upright axis in the middle of the box, m.
  [[nodiscard]] double from_axis(const Vector& x) const {
    return std::hypot(x[0] - 0.5 * size[0], x[2] - 0.5 * size[2]);
  }
  /// Whether a sphere lies wholly within the side of a round box; always true for another box.
  [[nodiscard]] bool within_side(const Place& sphere) const;
  /// Adds a flat plate and the corresponding wall.
  void add_plate(Plate plate, double thickness = 0);
  /// The same for a cone about the axis of the box: half its diameter and height at both ends, m.
  void add_cone(const InPlane& from, const InPlane& to, double thickness = 0);
  /// Replaces the bottom by a plate with the opening in it, so that round plates ending on it push once with it.
  void make_bottom_a_plate();
  /// Whether a plate pushes a centre near it. It does not push with an edge if the centre is nearer to the face of the
  /// plate joined there; of two plates with the same nearest edge, the one with the lower number pushes. Plates that
  /// continue each other thus push once. A thick plate does not push where another one covers its surface.
  [[nodiscard]] bool pushes(int plate, const Vector& centre) const;
  [[nodiscard]] bool has_joints() const { return !joints.empty() || !overlaps.empty(); }

  /// Added to x and v_x of a particle's image one box higher, at a time, m and m/s. The first within +-L/2.
  [[nodiscard]] double image_shift(double time) const {
    const double shift = std::fmod(shear_rate * size[1] * time + strain_before * size[1], size[0]);
    return shift > 0.5 * size[0] ? shift - size[0] : (shift < -0.5 * size[0] ? shift + size[0] : shift);
  }
  [[nodiscard]] double image_speed() const { return shear_rate * size[1]; }

 private:
  /// The image of a centre that is nearest to an opening.
  [[nodiscard]] Vector beside(const Opening& opening, Vector centre) const;
  /// Adds a plate and its joints; returns its number.
  int joined(const Plate& plate);
  [[nodiscard]] bool is_covered(int plate, const InPlane& point) const;
  [[nodiscard]] Plate about_axis(const InPlane& from, const InPlane& to) const;
};

/// The images at one instant. An image has a number: its distance in boxes, -1, 0 or 1, along each axis.
struct Images {
  static constexpr int here = 13, count = 27;
  std::array<Vector, count> shift{};  ///< displacement of the image, m
  std::array<double, count> speed{};  ///< its additional velocity along x, m/s
  Vector period{}, half{};            ///< infinite half: no images along that axis

  /// \param time   s  \param since  s, from the time of the image numbers: a sheared box has moved on
  Images(const Box& box, double time, double since) {
    const double sheared = box.image_shift(time - since) + box.image_speed() * since;
    for (std::size_t k = 0; k < 3; ++k) {
      period[k] = box.periodic[k] ? box.size[k] : 0;
      half[k] = box.periodic[k] ? 0.5 * box.size[k] : std::numeric_limits<double>::infinity();
    }
    for (int n = 0; n < count; ++n) {
      const std::array<int, 3> boxes{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      for (std::size_t k = 0; k < 3; ++k) shift[std::size_t(n)][k] = boxes[k] * period[k];
      shift[std::size_t(n)][0] += boxes[1] * sheared;
      speed[std::size_t(n)] = boxes[1] * box.image_speed();
    }
  }

  /// Number of boxes between two particles at a distance d along an axis: -1, 0 or 1.
  [[nodiscard]] int boxes(double d, std::size_t axis) const {
    return (d > half[axis] ? 1 : 0) - (d < -half[axis] ? 1 : 0);
  }

  /// The image of j nearest to i. \param d  x_i - x_j
  [[nodiscard]] int nearest(const Vector& d) const {
    const int up = boxes(d[1], 1);
    const int aside = boxes(d[0] - shift[std::size_t(here + 3 * up)][0], 0);
    return here + aside + 3 * up + 9 * boxes(d[2], 2);
  }

  /// Calls act with the images of j on the other side of i from the nearest one, along one axis or several. Not in a
  /// sheared box, whose images move along each other. \param d  x_i - x_j  \param nearest  result of nearest(d)
  template <class Act>
  void each_other(const Vector& d, int nearest, Act&& act) const {
    constexpr std::array<int, 3> stride{1, 3, 9};
    const Vector from = seen(d, nearest);
    for (int sides = 1; sides < 8; ++sides) {
      int image = nearest;
      bool there = true;
      for (std::size_t k = 0; k < 3; ++k) {
        if ((sides >> k & 1) == 0) continue;
        there = there && period[k] > 0;
        image += from[k] > 0 ? stride[k] : -stride[k];
      }
      if (there) act(image);
    }
  }

  /// The image of i nearest to j, from the image of j nearest to i.
  [[nodiscard]] static constexpr int opposite(int image) { return 2 * here - image; }

  /// x_i - x_j for an image of j.
  [[nodiscard]] Vector seen(Vector d, int image) const {
    for (std::size_t k = 0; k < 3; ++k) d[k] -= shift[std::size_t(image)][k];
    return d;
  }
};

/// Unit for sums of forces in whole numbers, from the greatest number and range of the forces. Sums of int64 do not
/// depend on their order, so neither ranks nor the order of pairs change a bit.
struct FixedPoint {
  double per_unit = 1, unit = 1;  ///< 1/unit and unit, a power of two; N, or N m, or J

  /// Unit for at most `terms` numbers of at most `most` each: the largest power 2^q with most terms 2^q < 2^62;
  /// 1 if they are all 0.
  static FixedPoint for_sums_of(double most, double terms) {
    if (most == 0) return {};
    const int q = int(std::floor(62 - std::log2(most * terms)));
    return {std::ldexp(1.0, q), std::ldexp(1.0, -q)};
  }
};

/// Adds a force in whole units. A force out of range wraps: its cause, an overlap or a speed, ends the run before the
/// next step. The C++ conversion is undefined for it; the processor's instruction is not.
inline void add_units(double units, std::int64_t& sum) {
#ifdef __x86_64__
  const std::int64_t whole = _mm_cvttsd_si64(_mm_set_sd(units));
#else
  const std::int64_t whole = std::abs(units) < 0x1p63 ? std::int64_t(units) : std::numeric_limits<std::int64_t>::min();
#endif
  sum = std::int64_t(std::uint64_t(sum) + std::uint64_t(whole));
}

}  // namespace polybed::dem
