#include "dem/effects/friction_partial_slip.hpp"

#include <cmath>

#include "closures/contact_tangential.hpp"
#include "closures/mindlin_deresiewicz.hpp"
#include "dem/effects/rows.hpp"

namespace polybed::dem {

namespace {

using closures::MindlinDeresiewicz;
using closures::Vec3;

/// Stored data of a contact, relative to its loading side: the state's side is always 1.
struct Slip {
  Vec3 direction;
  MindlinDeresiewicz state;
  double normal;  ///< F_n in the last step
  bool fresh;     ///< the first step of the contact
};

Slip recalled(const ContactBatch& b, int place, int c) {
  const ContactBatch::Row* m = b.memory + place;
  // Branches are stored plus one: zero means a new contact.
  const bool fresh = m[6][c] == 0;
  return {closures::transported(at(m, c), at(b.distance, c)),
          {m[3][c], m[4][c], m[5][c], fresh ? 0 : m[6][c] - 1, 1},
          m[7][c],
          fresh};
}

void keep(ContactBatch& b, int place, int c, const Slip& slip) {
  ContactBatch::Row* m = b.memory + place;
  const MindlinDeresiewicz& s = slip.state;
  put(m, c, s.side * slip.direction);
  m[3][c] = s.side * s.force;
  m[4][c] = s.unloaded_at;
  m[5][c] = s.reloaded_at;
  m[6][c] = s.branch + 1;
  m[7][c] = slip.normal;
}

/// Rotates the force by the effect of a transverse displacement, within the limit.
void turn(Slip& slip, const Vec3& across, double limit) {
  const Vec3 force = slip.state.force * slip.direction + across;
  const double size = std::sqrt(closures::dot(force, force)), sign = slip.state.force < 0 ? -1 : 1;
  if (!(size > 0)) return;
  slip.direction = (sign / size) * force;
  slip.state.force = sign * (size < limit ? size : limit);
}

/// Applies one step of a displacement. \param stiffness  8 G* a, or the first step's share of it
void move(Slip& slip, const Vec3& displacement, double stiffness, double friction, double normal) {
  const double distance = std::sqrt(closures::dot(displacement, displacement));
  // Without force there is no direction yet, and the contact loads along its motion.
  if (slip.state.branch == 0 && slip.state.force <= 0 && distance > 0) slip.direction = (1 / distance) * displacement;
  const double along = closures::dot(displacement, slip.direction);
  const Vec3 across = displacement - along * slip.direction;
  slip.state = closures::mindlin_deresiewicz(slip.state, {stiffness, along, friction, normal, normal - slip.normal});
  slip.normal = normal;
  const double limit = friction * normal > 0 ? friction * normal : 0;
  // Round-off of the split does not count as a transverse part.
  if (closures::dot(across, across) > 1e-28 * distance * distance) turn(slip, stiffness * across, limit);
}

}  // namespace

PartialSlipFriction::PartialSlipFriction(const Materials& materials, int place) : place_(place) {
  for (const PairMaterial& m : materials.kinds())
    constants_.push_back({m.friction, closures::tangential_stiffness(m.shear_modulus, 1)});
}

void PartialSlipFriction::act(ContactBatch& batch, double dt) const {
  for (int c = 0; c < batch.count; ++c) {
    const Constants& k = constants_[std::size_t(batch.kind[c])];
    Slip slip = recalled(batch, place_, c);
    const double stiffness = k.per_radius * batch.contact_radius[c] * (slip.fresh ? closures::first_step_share : 1);
    move(slip, time_of_contact(batch, c, dt) * at(batch.velocity, c), stiffness, k.friction, batch.normal[c]);
    put(batch.tangential, c, -slip.state.force * slip.direction);
    keep(batch, place_, c, slip);
  }
}

void PartialSlipFriction::energy(const ContactBatch& batch, ContactBatch::Row& stored) const {
  for (int c = 0; c < batch.count; ++c) {
    const double stiffness = constants_[std::size_t(batch.kind[c])].per_radius * batch.contact_radius[c];
    const double force = batch.memory[place_ + 3][c];
    stored[c] = 0.5 * force * force / (stiffness > tiny ? stiffness : tiny);
  }
}

}  // namespace polybed::dem
