#include "dem/effects/contact_hertz.hpp"

#include <cmath>
#include <limits>

#include "closures/contact_hertz.hpp"
#include "closures/restitution.hpp"
#include "core/vectors.hpp"
#include "dem/contacts/rows.hpp"

namespace polybed::dem {

namespace {

void hertz(ContactBatch& b, const ContactBatch::Row& radius, const ContactBatch::Row& modulus,
           const ContactBatch::Row& dashpot, double least_force) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double overlap = b.overlap[c] > 0 ? b.overlap[c] : 0;
    const double a = closures::contact_radius(radius[c], overlap), damping = dashpot[c] * std::sqrt(a);
    const closures::NormalForce f = closures::hertz_force(modulus[c], a, overlap, damping, b.speed[c]);
    const double force = closures::normal_kept(f);
    b.contact_radius[c] = a;
    b.elastic[c] = f.elastic;
    b.dashpot[c] = damping;
    b.normal[c] = force > least_force ? force : least_force;
  }
}

}  // namespace

HertzContact::HertzContact(const Materials& materials, core::Tail tail)
    : least_force_(tail == core::Tail::clip ? 0 : -std::numeric_limits<double>::infinity()) {
  for (const PairMaterial& m : materials.kinds()) {
    const double beta = tail == core::Tail::clip ? closures::damping_ratio_clipped(m.restitution)
                                                 : closures::damping_ratio_kept(m.restitution);
    const double damping = closures::hertz_damping(beta, closures::hertz_stiffness(m.youngs_modulus, 1), m.mass);
    constants_.push_back(
        {m.mass, m.radius, m.youngs_modulus, damping, closures::hertz_coefficient(m.youngs_modulus, m.radius), beta});
  }
}

void HertzContact::act(ContactBatch& batch) const {
  alignas(64) ContactBatch::Row radius = {}, modulus = {}, dashpot = {};
  fill_by_kind(batch, constants_, [&](const Constants& k, int c) {
    radius[c] = k.radius;
    modulus[c] = k.modulus;
    dashpot[c] = k.dashpot;
  });
  core::in_vectors<hertz>(batch, radius, modulus, dashpot, least_force_);
}

double HertzContact::energy(int kind, double overlap) const {
  return closures::hertz_stored_energy(constants_[std::size_t(kind)].coefficient, overlap);
}

double HertzContact::force_at(int kind, double overlap) const {
  return closures::hertz_greatest_force(constants_[std::size_t(kind)].coefficient, overlap);
}

double HertzContact::overlap_of_impact(int kind, double speed) const {
  const Constants& k = constants_[std::size_t(kind)];
  return closures::hertz_greatest_overlap(k.coefficient, k.mass, speed);
}

double HertzContact::contact_time(int kind, double speed) const {
  return closures::hertz_contact_time(overlap_of_impact(kind, speed), speed);
}

double HertzContact::stiffness_at(int kind, double overlap) const {
  const Constants& k = constants_[std::size_t(kind)];
  return closures::hertz_stiffness(k.modulus, closures::contact_radius(k.radius, overlap));
}

double HertzContact::damping_ratio(int kind) const {
  return closures::hertz_damping_share * constants_[std::size_t(kind)].beta;
}

}  // namespace polybed::dem
