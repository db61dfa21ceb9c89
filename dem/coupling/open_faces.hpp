// The open top of a column, the holes in its faces, and its feeds: how much of a particle that passes them counts for
// the fluid.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "closures/sphere.hpp"
#include "dem/arrivals.hpp"
#include "dem/box.hpp"
#include "dem/coupling/weights.hpp"
#include "measures/particle_profile.hpp"

namespace polybed::dem {

/// A particle counts as far as it is inside; the part beyond a face is dropped. Its share falls from 1 to 0 while its
/// centre moves from a radius before the face to a radius beyond it, so that the voidage has no jump. Beyond the top
/// its weight on the faces mirrors the weight below: the flux through them, summed over the passage of a particle, is
/// then its volume, for any speed and height of the cells. Elsewhere the flux of the mixture is given.
class OpenFaces {
 public:
  /// \param grid  of the whole column
  OpenFaces(const core::Grid& grid, const Box& box) : box_(box), spacing_(grid.size_at_end(1, 1)) {
    for (const Opening& opening : box.openings)
      if (std::none_of(faces_.begin(), faces_.end(), [&](const Opening& face) { return face.is_beside(opening); }))
        faces_.push_back(opening);
  }

  /// From here on particles count as their arrivals say.
  void see(Arrivals arrivals) { arrivals_ = std::move(arrivals); }

  /// Whether a part of the particle, or all of it, is beyond one of them, or is still to come in.
  [[nodiscard]] bool cuts(const Place& place, std::int64_t id) const {
    return id >= arrivals_.first ||
           std::any_of(faces_.begin(), faces_.end(), [&](const Opening& face) { return cuts(face, place); });
  }
  /// Share of its volume that is inside.
  [[nodiscard]] double inside(const Place& place, std::int64_t id) const {
    double share = arrivals_.share(box_, place, id);
    for (const Opening& face : faces_)
      if (cuts(face, place))
        share *= measures::sphere_volume_below(place.radius, face.outward(place.x), face.outward(face.place)) /
                 closures::sphere_volume(place.radius);
    return share;
  }
  /// The remaining part of its shares on faces along y, without those beyond the top.
  [[nodiscard]] double on_faces(const Place& place) const {
    const auto top = std::find_if(faces_.begin(), faces_.end(), [](const Opening& face) { return face.is_top(); });
    return top == faces_.end() ? 1 : std::clamp(1 - (place.x[1] - top->place) / spacing_, 0.0, 1.0);
  }

 private:
  /// A particle pressed into the closed part of a face is inside.
  [[nodiscard]] bool cuts(const Opening& face, const Place& place) const {
    const double out = face.outward(place.x), at = face.outward(face.place);
    return out + place.radius > at && (out > at || box_.in_line(face, place.x));
  }

  Box box_;
  std::vector<Opening> faces_;  ///< one opening for each face with openings
  double spacing_;              ///< height of the topmost cells, m
  Arrivals arrivals_;
};

}  // namespace polybed::dem
