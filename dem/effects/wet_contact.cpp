#include "dem/effects/wet_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "closures/lubrication.hpp"
#include "core/vectors.hpp"
#include "dem/effects/rows.hpp"

namespace polybed::dem {

namespace {

using Row = ContactBatch::Row;

void damp(ContactBatch& b, int place, const Row& dry, double least_force) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double whole = b.dashpot[c], force = b.elastic[c] - b.memory[place][c] * whole * b.speed[c];
    b.normal[c] = force > least_force ? force : least_force;
    b.dashpot[c] = dry[c] * whole;
  }
}

}  // namespace

WetContact::WetContact(std::unique_ptr<NormalLaw> whole, const Materials& materials, const Fluid& fluid,
                       core::Tail tail, int place)
    : whole_(std::move(whole)),
      table_(tail == core::Tail::clip),
      least_force_(tail == core::Tail::clip ? 0 : -std::numeric_limits<double>::infinity()),
      place_(place) {
  for (const PairMaterial& m : materials.kinds()) {
    const double log = -std::log(std::min(m.restitution, 1.0));
    constants_.push_back({log, closures::stokes_of_pair(m.mass, 1, fluid.viscosity, m.radius), table_(log)});
  }
  for (std::size_t a = 0; a < materials.species().size(); ++a) {
    const Species& s = materials.species()[a];
    constants_[std::size_t(materials.wall_kind(std::int32_t(a)))].stokes =
        closures::stokes_of_impact(s.density, fluid.density, 2 * s.radius, 1, fluid.viscosity);
  }
}

double WetContact::damping_at_touch(int kind, double speed) const {
  const Constants& k = constants_[std::size_t(kind)];
  const double wet = closures::wet_restitution(1, k.stokes * -speed);  // 0 without approach
  // Zero is what stands for a contact that has not begun.
  return std::max(table_(wet > 0 ? k.log - std::log(wet) : std::numeric_limits<double>::infinity()), tiny);
}

void WetContact::act(ContactBatch& batch) const {
  whole_->act(batch);
  Row& damping = batch.memory[place_];
  alignas(64) Row dry = {};
  for (int c = 0; c < batch.count; ++c) {
    if (damping[c] == 0 && batch.overlap[c] > 0) damping[c] = damping_at_touch(batch.kind[c], batch.speed[c]);
    dry[c] = constants_[std::size_t(batch.kind[c])].dry;
  }
  core::in_vectors<damp>(batch, place_, dry, least_force_);
}

}  // namespace polybed::dem
