#include "dem/measures.hpp"

#include <algorithm>
#include <cmath>

#include "core/messages.hpp"

namespace polybed::dem {

namespace {

/// Sums that are the same in any order: each number in whole units of the greatest there is, and parts of them.
class Sum {
 public:
  explicit Sum(FixedPoint unit) : unit_(unit) {}
  void add(double value) { sum_.add(value * unit_.per_unit); }
  [[nodiscard]] const EnergySum& sum() const { return sum_; }

 private:
  FixedPoint unit_;
  EnergySum sum_;
};

/// Elastic energy and that of attraction, number and extremes of contacts that this rank counts.
void add_contacts(const Model& model, const Contacts& contacts, bool walls, Sum& elastic, Totals& totals) {
  const Images images = model.images();
  ContactBatch batch;
  const Particles& particles = model.particles();
  for (std::size_t begin = 0; begin < contacts.touching.size(); begin += ContactBatch::width) {
    const ContactLoader& loader = model.pair_forces().loader();
    if (walls)
      loader.load_touching_walls(particles, contacts, begin, batch);
    else
      loader.load_touching_pairs(particles, contacts, images, begin, batch);
    alignas(64) ContactBatch::Row stored = {};
    model.laws().normal->act(batch);
    if (model.laws().tangential) model.laws().tangential->energy(batch, stored);
    if (model.laws().rolling) model.laws().rolling->add_energy(batch, stored);
    if (model.laws().cohesion) model.laws().cohesion->add_energy(batch, stored);
    for (int c = 0; c < batch.count; ++c) {
      const Contacts::Pair pair = contacts.pairs[std::size_t(contacts.touching[begin + std::size_t(c)])];
      if (std::size_t(pair.first) >= particles.owned) continue;
      elastic.add(model.laws().normal->energy(batch.kind[c], std::max(batch.overlap[c], 0.0)) + stored[c]);
      if (batch.overlap[c] <= 0) continue;  // held by cohesion across a gap
      ++totals.contacts;
      totals.max_overlap = std::max(totals.max_overlap, batch.overlap[c]);
      totals.max_force = std::max(totals.max_force, batch.elastic[c]);
    }
  }
}

}  // namespace

Totals totals_of(const Model& model) {
  Totals totals;
  const FixedPoint unit = model.energy_unit(), momentum_unit = model.momentum_unit();
  Sum kinetic(unit), rotational(unit), potential(unit), elastic(unit), highest(unit);
  std::array<Sum, 3> momentum{Sum(momentum_unit), Sum(momentum_unit), Sum(momentum_unit)};
  const Particles& particles = model.particles();
  const Vector g = model.gravity(), &size = model.box().size;
  const double far = std::abs(g[0]) * size[0] + std::abs(g[1]) * size[1] + std::abs(g[2]) * size[2];
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const Motion& m = particles.motion[i];
    const Vector& x = particles.place[i].x;
    const double vv = m.v[0] * m.v[0] + m.v[1] * m.v[1] + m.v[2] * m.v[2];
    const double ww = m.w[0] * m.w[0] + m.w[1] * m.w[1] + m.w[2] * m.w[2];
    kinetic.add(0.5 * vv / m.inverse_mass);
    rotational.add(0.5 * ww / m.inverse_inertia);
    potential.add(-(g[0] * x[0] + g[1] * x[1] + g[2] * x[2]) / m.inverse_mass);
    highest.add(far / m.inverse_mass);
    for (std::size_t k = 0; k < 3; ++k) momentum[k].add(m.v[k] / m.inverse_mass);
    totals.greatest_speed = std::max(totals.greatest_speed, std::sqrt(vv));
  }
  add_contacts(model, model.pairs(), false, elastic, totals);
  add_contacts(model, model.walls(), true, elastic, totals);
  EnergySum work = model.flow_work();
  work.add(model.fluid_work());
  std::array<EnergySum, 10> sums{
      kinetic.sum(), rotational.sum(),  potential.sum(),   elastic.sum(),     model.dissipated(),
      work,          momentum[0].sum(), momentum[1].sum(), momentum[2].sum(), highest.sum()};
  add_over_ranks(model.ranks(), sums);
  std::array<std::int64_t, 1> contacts{totals.contacts};
  core::add_over_ranks(model.ranks(), contacts);
  totals.kinetic = sums[0].units() * unit.unit;
  totals.rotational = sums[1].units() * unit.unit;
  totals.potential = sums[2].units() * unit.unit;
  totals.elastic = sums[3].units() * unit.unit;
  totals.dissipated = sums[4].units() * unit.unit;
  totals.work = sums[5].units() * unit.unit;
  totals.rounding = rounding_of_places(sums[9].units() * unit.unit, model.steps());
  totals.contacts = contacts[0];
  for (std::size_t k = 0; k < 3; ++k) totals.momentum[k] = sums[6 + k].units() * momentum_unit.unit;
  totals.max_overlap = core::greatest_of_ranks(model.ranks(), totals.max_overlap);
  totals.max_force = core::greatest_of_ranks(model.ranks(), totals.max_force);
  totals.greatest_speed = core::greatest_of_ranks(model.ranks(), totals.greatest_speed);
  return totals;
}

}  // namespace polybed::dem
