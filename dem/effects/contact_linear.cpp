#include "dem/effects/contact_linear.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "closures/contact_linear.hpp"
#include "closures/restitution.hpp"
#include "core/vectors.hpp"

namespace polybed::dem {

namespace {

void linear(ContactBatch& b, double stiffness, const ContactBatch::Row& dashpot, double least_force) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double overlap = b.overlap[c] > 0 ? b.overlap[c] : 0;
    const double damping = b.overlap[c] > 0 ? dashpot[c] : 0, elastic = stiffness * overlap;
    const double force = elastic - damping * b.speed[c];
    b.elastic[c] = elastic;
    b.dashpot[c] = damping;
    b.normal[c] = force > least_force ? force : least_force;
  }
}

}  // namespace

LinearContact::LinearContact(const Materials& materials, double stiffness, core::Tail tail)
    : stiffness_(stiffness), least_force_(tail == core::Tail::clip ? 0 : -std::numeric_limits<double>::infinity()) {
  for (const PairMaterial& m : materials.kinds()) {
    const double beta = tail == core::Tail::clip ? closures::damping_ratio_clipped(m.restitution)
                                                 : closures::damping_ratio_kept(m.restitution);
    constants_.push_back({m.mass, closures::linear_damping(beta, stiffness, m.mass), beta});
  }
}

void LinearContact::act(ContactBatch& batch) const {
  alignas(64) ContactBatch::Row dashpot = {};
  for (int c = 0; c < batch.count; ++c) dashpot[c] = constants_[std::size_t(batch.kind[c])].dashpot;
  core::in_vectors<linear>(batch, stiffness_, dashpot, least_force_);
}

double LinearContact::energy(int, double overlap) const { return closures::linear_stored_energy(stiffness_, overlap); }

double LinearContact::contact_time(int kind, double) const {
  const Constants& k = constants_[std::size_t(kind)];
  return closures::linear_contact_time(stiffness_, k.mass, 0);
}

double LinearContact::overlap_of_impact(int kind, double speed) const {
  return speed * std::sqrt(constants_[std::size_t(kind)].mass / stiffness_);
}

}  // namespace polybed::dem
