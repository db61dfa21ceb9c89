// Vectors in the rows of a batch, for laws that use closures of vectors.
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

/// Replaces a zero stiffness or radius as a divisor.
inline constexpr double tiny = 1e-300;

/// The memory of a neck or bridge between two surfaces, whose force jumps when it forms and when it breaks. It forms at
/// first contact and exists until its breaking gap. A force acts for half a step before and half a step after its
/// evaluation, so a jump within a step is in error by the work of the attraction over up to half of that step's path,
/// an error of first order. Evaluated a share s of a step after the jump, the force therefore counts 1/2 + s times when
/// it forms, and 1/2 - s times once more after it broke. Positive: it exists, and the force counts this many times. 0:
/// it does not exist. Negative: it broke in this step.
/// \param before  the memory of the last step   \param gap  breaking gap, m
/// \param way  v_n dt, of the surfaces in the last step, m, negative on approach; 0: unknown
[[nodiscard]] inline double neck_memory(double before, double overlap, double gap, double way) {
  const double formed = way < 0 ? 0.5 + (overlap < -way ? overlap / -way : 1) : 1;
  const double past = -gap - overlap, broke = way > 0 ? -2 + (past < way ? past / way : 1) : -1.5;
  const bool held = before > 0;
  return overlap >= 0 ? (held ? 1 : formed) : held ? (overlap >= -gap ? 1 : broke) : 0;
}
/// Factor of its force.
[[nodiscard]] inline double neck_weight(double memory) { return memory >= 0 ? memory : -1.5 - memory; }

/// Remaining work of the second half of a jump's force, as attraction times path: the velocity lacks it until the next
/// step. Add it to the stored energy. \param way  as above
[[nodiscard]] inline double neck_owed(double memory, double way) {
  const double share = memory > 0 ? 1 - memory : neck_weight(memory);
  return -0.5 * share * (way > 0 ? way : -way);
}

/// Part of this step in which a contact has touched, s. With the thesis' integrator the batch has the velocity that
/// moved the bodies, and this is exact. The synchronised one has U'' = U' + F_old dt/(2m), where F_old lacks the force
/// of a new contact: this too is exact for two bodies alone; otherwise the error is the share of v_n that other forces
/// change in half a step. An older contact pushes its bodies apart, so it counts as new only if others press it
/// together by more than its overlap in one step; it then gains a part of that step's path.
[[nodiscard]] inline double time_of_contact(const ContactBatch& b, int c, double dt) {
  return closures::time_since_touch(b.overlap[c] > 0 ? b.overlap[c] : 0, b.speed[c], dt);
}

}  // namespace polybed::dem
