#include "dem/effects/film.hpp"

#include <algorithm>

#include "closures/lubrication.hpp"
#include "core/vectors.hpp"

namespace polybed::dem {

namespace {

using Row = ContactBatch::Row;

/// Gap up to which a film acts, over R*.
constexpr double reach_over_radius = 0.1;
/// What stands for the films of a particle together, see Film.
constexpr double films = 6;

void squeeze(const ContactBatch& b, const Row& radius, const Row& per_mass, double viscosity, double roughness,
             Row& force) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double gap = -b.overlap[c];
    const double whole = closures::film_resistance(viscosity, radius[c], gap, reach_over_radius * radius[c], roughness);
    force[c] = gap > 0 ? -b.speed[c] * whole / (1 + whole * per_mass[c]) : 0;
  }
}

}  // namespace

Film::Film(const Materials& materials, double viscosity, double roughness)
    : viscosity_(viscosity), roughness_(roughness) {
  for (const PairMaterial& m : materials.kinds()) constants_.push_back({m.radius, m.mass, 0});
}

void Film::set_step(double dt) {
  for (Constants& k : constants_) k.per_mass = films * dt / k.mass;
}

void Film::act(const ContactBatch& batch, Row& force) const {
  alignas(64) Row radius = {}, per_mass = {};
  for (int c = 0; c < batch.count; ++c) {
    const Constants& k = constants_[std::size_t(batch.kind[c])];
    radius[c] = k.radius;
    per_mass[c] = k.per_mass;
  }
  core::in_vectors<squeeze>(batch, radius, per_mass, viscosity_, roughness_, force);
}

double Film::reach() const {
  double reach = 0;
  for (const Constants& k : constants_) reach = std::max(reach, reach_over_radius * k.radius);
  return reach;
}

}  // namespace polybed::dem
