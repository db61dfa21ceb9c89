#include "dem/effects/contact_hertz.hpp"

#include <cmath>
#include <limits>

#include "closures/contact_hertz.hpp"
#include "closures/restitution.hpp"

namespace polybed::dem {

namespace {

POLYBED_ALL_VECTOR_WIDTHS void hertz(ContactBatch& b, const ContactBatch::Row& radius,
                                     const ContactBatch::Row& stiffness, const ContactBatch::Row& dashpot,
                                     double least_force) {
  const int n = b.padded();
  for (int c = 0; c < n; ++c) {
    const double overlap = b.overlap[c] > 0 ? b.overlap[c] : 0;
    const double a = std::sqrt(radius[c] * overlap);
    const double damping = dashpot[c] * std::sqrt(a), elastic = stiffness[c] * a * overlap;
    const double force = elastic - damping * b.speed[c];
    b.contact_radius[c] = a;
    b.elastic[c] = elastic;
    b.dashpot[c] = damping;
    b.normal[c] = force > least_force ? force : least_force;
  }
}

}  // namespace

HertzContact::HertzContact(const Materials& materials, const std::string& tail)
    : least_force_(tail == "clip" ? 0 : -std::numeric_limits<double>::infinity()) {
  for (const PairMaterial& m : materials.kinds()) {
    const double beta =
        tail == "clip" ? closures::damping_ratio_clipped(m.restitution) : closures::damping_ratio_kept(m.restitution);
    constants_.push_back({m.radius, m.mass, m.youngs_modulus, closures::hertz_force(m.youngs_modulus, 1, 1),
                          closures::hertz_dashpot(m.youngs_modulus, m.mass, beta, 1), beta});
  }
}

void HertzContact::act(ContactBatch& batch) const {
  alignas(64) ContactBatch::Row radius = {}, stiffness = {}, dashpot = {};
  for (int c = 0; c < batch.count; ++c) {
    const Constants& k = constants_[std::size_t(batch.kind[c])];
    radius[c] = k.radius;
    stiffness[c] = k.stiffness;
    dashpot[c] = k.dashpot;
  }
  hertz(batch, radius, stiffness, dashpot, least_force_);
}

double HertzContact::energy(int kind, double overlap) const {
  const Constants& k = constants_[std::size_t(kind)];
  return closures::hertz_energy(k.modulus, k.radius, overlap);
}

double HertzContact::force_at(int kind, double overlap) const {
  const Constants& k = constants_[std::size_t(kind)];
  return closures::hertz_force(k.modulus, closures::hertz_contact_radius(k.radius, overlap), overlap);
}

double HertzContact::overlap_of_impact(int kind, double speed) const {
  const Constants& k = constants_[std::size_t(kind)];
  return closures::hertz_impact_overlap(k.modulus, k.radius, k.mass, speed);
}

double HertzContact::contact_time(int kind, double speed) const {
  return closures::hertz_impact_time(overlap_of_impact(kind, speed), speed);
}

double HertzContact::stiffness_at(int kind, double overlap) const {
  const Constants& k = constants_[std::size_t(kind)];
  return closures::hertz_stiffness(k.modulus, closures::hertz_contact_radius(k.radius, overlap));
}

}  // namespace polybed::dem
