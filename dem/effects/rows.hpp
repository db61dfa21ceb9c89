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

/// The memory of a neck or bridge between two surfaces, whose force jumps where it forms and where it breaks. It forms
/// where they touch, and is there until the gap at which it breaks is reached. A force acts for half a step before and
/// half a step after the time that it is found for, so that a jump within a step, taken as it is, gives the work of the
/// pull over up to half of that step's way too much or too little, an error of first order. Found a share s of a step
/// after the jump, the force counts 1/2 + s times where it formed, and 1/2 - s times once more where it broke.
/// Positive: it is there, and so many times counts the force. 0: it is not. Negative: it broke in this step.
/// \param before  the memory of the last step   \param gap  at which it breaks, m
/// \param way  v_n dt, of the surfaces in the last step, m, negative on approach; 0: nothing is known
[[nodiscard]] inline double neck_memory(double before, double overlap, double gap, double way) {
  const double formed = way < 0 ? 0.5 + (overlap < -way ? overlap / -way : 1) : 1;
  const double past = -gap - overlap, broke = way > 0 ? -2 + (past < way ? past / way : 1) : -1.5;
  const bool held = before > 0;
  return overlap >= 0 ? (held ? 1 : formed) : held ? (overlap >= -gap ? 1 : broke) : 0;
}
/// How many times its force counts.
[[nodiscard]] inline double neck_weight(double memory) { return memory >= 0 ? memory : -1.5 - memory; }

/// What the second half of a jump's force has still to do, in pull times way: the velocity lacks it until the next
/// step. To be added to the stored energy. \param way  as above
[[nodiscard]] inline double neck_owed(double memory, double way) {
  const double share = memory > 0 ? 1 - memory : neck_weight(memory);
  return -0.5 * share * (way > 0 ? way : -way);
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
