// Vectors in the rows of a batch, for the laws that are written with closures of vectors.
#pragma once

#include "closures/contact_tangential.hpp"
#include "closures/vec3.hpp"
#include "dem/contacts/batch.hpp"

namespace polybed::dem {

[[nodiscard]] inline closures::Vec3 at(const ContactBatch::Row* rows, int c) {
  return {rows[0][c], rows[1][c], rows[2][c]};
}

inline void put(ContactBatch::Row* rows, int c, const closures::Vec3& v) {
  rows[0][c] = v.x;
  rows[1][c] = v.y;
  rows[2][c] = v.z;
}

/// What stands for a stiffness or a radius of nothing when something is divided by it.
inline constexpr double tiny = 1e-300;

/// Whether a neck or bridge between two surfaces is there after this step, 1 or 0: they touch, or it was there and the
/// gap at which it breaks is not reached.
[[nodiscard]] inline double holds(double held, double overlap, double gap) {
  return overlap >= 0 ? 1.0 : (overlap >= -gap ? held : 0.0);
}

/// Part of this step in which a contact has touched, s. With the thesis' integrator the batch has the velocity that
/// moved the bodies, and this is exact. The synchronised one has U'' = U' + F_old dt/(2m), in which F_old is without
/// the force of a contact that is new: of two bodies alone it is exact too, and of more it errs by the share of v_n
/// that other forces change in half a step. An older contact pushes its bodies apart, so it is not taken for a new one
/// unless others press it together by more than its overlap in one step; it then gains a part of that step's way.
[[nodiscard]] inline double time_of_contact(const ContactBatch& b, int c, double dt) {
  return closures::time_since_touch(b.overlap[c] > 0 ? b.overlap[c] : 0, b.speed[c], dt);
}

}  // namespace polybed::dem
