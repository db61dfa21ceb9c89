#include "dem/effects/friction.hpp"

#include <cmath>

#include "closures/contact_tangential.hpp"
#include "core/vectors.hpp"
#include "dem/contacts/rows.hpp"
#include "dem/effects/rows.hpp"

namespace polybed::dem {

namespace {

using closures::Vec3;

void friction_spring(ContactBatch& b, int place, const ContactBatch::Row& friction, const ContactBatch::Row& per_radius,
                     const ContactBatch::Row& constant, const ContactBatch::Row& dashpot, double dt) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const Vec3 v = at(b.velocity, c);
    const Vec3 xi = closures::transported(at(b.memory + place, c), at(b.distance, c)) + time_of_contact(b, c, dt) * v;
    const double stiffness = per_radius[c] * b.contact_radius[c] + constant[c];
    const Vec3 force = closures::spring_force(stiffness, xi, dashpot[c] * b.dashpot[c], v);
    const double divisor = stiffness > tiny ? stiffness : tiny;
    const double share = closures::coulomb_share(closures::dot(force, force), friction[c] * b.normal[c]);
    const Vec3 capped = share * force;
    put(b.memory + place, c, closures::select(share < 1, (-1 / divisor) * capped, xi));
    put(b.tangential, c, capped);
  }
}

void increment(ContactBatch& b, int place, const ContactBatch::Row& friction, const ContactBatch::Row& per_radius,
               const ContactBatch::Row& dashpot, double dt) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const Vec3 v = at(b.velocity, c);
    const Vec3 before = closures::transported(at(b.memory + place, c), at(b.distance, c));
    const double a = b.contact_radius[c], kept = b.memory[place + 3][c], last = kept > tiny ? kept : tiny;
    const double part = kept > 0 ? 1 : closures::first_step_share;
    const Vec3 held = closures::mindlin_force(before, last, a, part * per_radius[c] * a, v, time_of_contact(b, c, dt));
    const Vec3 force = held - (dashpot[c] * b.dashpot[c]) * v;
    const double share = closures::coulomb_share(closures::dot(force, force), friction[c] * b.normal[c]);
    const Vec3 capped = share * force;
    put(b.memory + place, c, closures::select(share < 1, capped, held));
    b.memory[place + 3][c] = a;
    put(b.tangential, c, capped);
  }
}

double square_of_memory(const ContactBatch& b, int place, int c) {
  const Vec3 kept = at(b.memory + place, c);
  return closures::dot(kept, kept);
}

double dashpot_share(const PairMaterial& m) {
  return closures::tangential_damping_ratio(m.shear_modulus, m.youngs_modulus);
}

}  // namespace

SpringFriction::SpringFriction(const Materials& materials, int place) : place_(place) {
  for (const PairMaterial& m : materials.kinds())
    constants_.push_back({m.friction, closures::secant_stiffness_hdd(m.shear_modulus, 1), 0, dashpot_share(m)});
}

SpringFriction::SpringFriction(const Materials& materials, double normal_stiffness, double ratio, int place)
    : place_(place) {
  for (const PairMaterial& m : materials.kinds())
    constants_.push_back({m.friction, 0, ratio * normal_stiffness, std::sqrt(ratio)});
}

void SpringFriction::act(ContactBatch& batch, double dt) const {
  alignas(64) ContactBatch::Row friction = {}, per_radius = {}, constant = {}, dashpot = {};
  fill_by_kind(batch, constants_, [&](const Constants& k, int c) {
    friction[c] = k.friction;
    per_radius[c] = k.per_radius;
    constant[c] = k.constant;
    dashpot[c] = k.dashpot;
  });
  core::in_vectors<friction_spring>(batch, place_, friction, per_radius, constant, dashpot, dt);
}

void SpringFriction::energy(const ContactBatch& batch, ContactBatch::Row& stored) const {
  for (int c = 0; c < batch.count; ++c) {
    const Constants& k = constants_[std::size_t(batch.kind[c])];
    stored[c] = 0.5 * (k.per_radius * batch.contact_radius[c] + k.constant) * square_of_memory(batch, place_, c);
  }
}

MindlinFriction::MindlinFriction(const Materials& materials, int place) : place_(place) {
  for (const PairMaterial& m : materials.kinds())
    constants_.push_back({m.friction, closures::tangential_stiffness(m.shear_modulus, 1), dashpot_share(m)});
}

void MindlinFriction::act(ContactBatch& batch, double dt) const {
  alignas(64) ContactBatch::Row friction = {}, per_radius = {}, dashpot = {};
  fill_by_kind(batch, constants_, [&](const Constants& k, int c) {
    friction[c] = k.friction;
    per_radius[c] = k.per_radius;
    dashpot[c] = k.dashpot;
  });
  core::in_vectors<increment>(batch, place_, friction, per_radius, dashpot, dt);
}

void MindlinFriction::energy(const ContactBatch& batch, ContactBatch::Row& stored) const {
  for (int c = 0; c < batch.count; ++c) {
    const double stiffness = constants_[std::size_t(batch.kind[c])].per_radius * batch.contact_radius[c];
    stored[c] = 0.5 * square_of_memory(batch, place_, c) / (stiffness > tiny ? stiffness : tiny);
  }
}

}  // namespace polybed::dem
