#include "dem/measures.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/messages.hpp"

namespace polybed::dem {

namespace {

/// Sums that are the same in any order: each number in whole units of the greatest one, and fractions of them. The
/// carry is done once, at the end: a particle adds less than 2^31 fractions, and a rank has fewer than 2^32 particles.
class Sum {
 public:
  explicit Sum(FixedPoint unit) : per_unit_(unit.per_unit) {}
  void add(double value, std::int64_t times = 1) {
    const double units = value * per_unit_;
    const auto whole = std::int64_t(units);
    whole_ += whole * times;
    part_ += std::int64_t((units - double(whole)) * EnergySum::parts) * times;
  }
  [[nodiscard]] EnergySum sum() const { return {whole_, part_}; }

 private:
  double per_unit_;
  std::int64_t whole_ = 0, part_ = 0;
};

/// Calls see for each contact that this rank counts, with its pair, its energies of springs and of attraction, J, and
/// its batch and row.
template <class See>
void each_contact(const Model& model, const Contacts& contacts, bool walls, See&& see) {
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
    model.laws().each_attraction([&](const CohesionLaw& law) { law.add_energy(batch, stored, model.limits().dt); });
    for (int c = 0; c < batch.count; ++c) {
      const Contacts::Pair& pair = contacts.pairs[std::size_t(contacts.touching[begin + std::size_t(c)])];
      if (std::size_t(pair.first) >= particles.owned) continue;
      see(pair, model.laws().normal->energy(batch.kind[c], std::max(batch.overlap[c], 0.0)) + stored[c], batch, c);
    }
  }
}

/// Work of an attraction from first contact to the overlap at which the normal force balances it, J.
double work_until_held(const NormalLaw& normal, int kind, double pull) {
  constexpr double overlap = 1e-6;  // any value: force is a power of it
  const double force = normal.force_at(kind, overlap);
  const double power = force * overlap / normal.energy(kind, overlap) - 1;
  return pull * overlap * std::pow(pull / force, 1 / power);
}

/// Adds elastic and attractive energy, number and extremes of contacts that this rank counts.
void add_contacts(const Model& model, const Contacts& contacts, bool walls, Sum& elastic, Totals& totals) {
  const PairLaws& laws = model.laws();
  each_contact(model, contacts, walls, [&](const Contacts::Pair&, double energy, const ContactBatch& batch, int c) {
    elastic.add(energy);
    if (batch.overlap[c] <= 0) return;  // cohesion across a gap
    laws.each_attraction([&](const CohesionLaw& law) {
      totals.pull = std::max(totals.pull, work_until_held(*laws.normal, batch.kind[c], law.pull_off(batch.kind[c])));
    });
    ++totals.contacts;
    totals.max_overlap = std::max(totals.max_overlap, batch.overlap[c]);
    totals.max_force = std::max(totals.max_force, batch.elastic[c]);
  });
}

double square(const Vector& a) { return a[0] * a[0] + a[1] * a[1] + a[2] * a[2]; }
double product(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

TotalsOfRanks::TotalsOfRanks(const Model& model) : model_(model) {
  const FixedPoint unit = model.energy_unit(), momentum_unit = model.momentum_unit();
  Sum kinetic(unit), rotational(unit), potential(unit), elastic(unit), highest(unit);
  std::array<Sum, 3> momentum{Sum(momentum_unit), Sum(momentum_unit), Sum(momentum_unit)};
  const Particles& particles = model.particles();
  const Vector g = model.gravity(), &size = model.box().size;
  const double far = std::abs(g[0]) * size[0] + std::abs(g[1]) * size[1] + std::abs(g[2]) * size[2];
  std::vector<std::int64_t> number(model.materials().species().size(), 0);
  double fastest = 0;
  for (std::size_t i = 0; i < particles.owned; ++i) {
    const Motion& m = particles.motion[i];
    const double vv = square(m.v);
    kinetic.add(0.5 * vv / m.inverse_mass);
    rotational.add(0.5 * square(m.w) / m.inverse_inertia);
    potential.add(-product(g, particles.place[i].x) / m.inverse_mass);
    ++number[std::size_t(particles.species[i])];
    for (std::size_t k = 0; k < 3; ++k) momentum[k].add(m.v[k] / m.inverse_mass);
    fastest = std::max(fastest, vv);
  }
  greatest_.greatest_speed = std::sqrt(fastest);
  for (std::size_t j = 0; j < number.size(); ++j)
    highest.add(far / (1 / model.materials().species()[j].mass), number[j]);
  add_contacts(model, model.pairs(), false, elastic, greatest_);
  add_contacts(model, model.walls(), true, elastic, greatest_);
  const CountedEnergy counted = model.counted_energy();
  EnergySum work = counted.joined_work;
  work.add(counted.fluid_work);
  const std::array<EnergySum, energies> sums{
      kinetic.sum(), rotational.sum(),  potential.sum(),   elastic.sum(),     counted.dissipated,
      work,          momentum[0].sum(), momentum[1].sum(), momentum[2].sum(), highest.sum()};
  for (std::size_t n = 0; n < energies; ++n) {
    sums_[2 * n] = sums[n].whole();
    sums_[2 * n + 1] = sums[n].part();
  }
  sums_.back() = greatest_.contacts;
}

void TotalsOfRanks::put_greatest_into(core::Reduction& all) {
  for (double* value : {&greatest_.max_overlap, &greatest_.max_force, &greatest_.greatest_speed, &greatest_.pull})
    all.greatest(*value);
}

Totals TotalsOfRanks::totals() const {
  const auto units = [this](std::size_t n) { return EnergySum(sums_[2 * n], sums_[2 * n + 1]).units(); };
  const double unit = model_.energy_unit().unit, momentum_unit = model_.momentum_unit().unit;
  Totals totals = greatest_;
  totals.kinetic = units(0) * unit;
  totals.rotational = units(1) * unit;
  totals.potential = units(2) * unit;
  totals.elastic = units(3) * unit;
  totals.dissipated = units(4) * unit;
  totals.work = units(5) * unit;
  if (model_.outflow() != nullptr) totals.carried_out = model_.outflow()->energy.units() * unit;
  if (model_.feeding() != nullptr) totals.carried_in = model_.feeding()->energy.units() * unit;
  constexpr double sums_of_particles = 3;  // kinetic, rotational, potential: each cut to fractions of a unit
  const double cut = sums_of_particles * double(model_.particle_count()) * unit / EnergySum::parts;
  totals.rounding = rounding_of_places(units(9) * unit, model_.steps()) + cut;
  totals.contacts = sums_.back();
  for (std::size_t k = 0; k < 3; ++k) totals.momentum[k] = units(6 + k) * momentum_unit;
  return totals;
}

Totals totals_of(const Model& model) {
  TotalsOfRanks of_ranks(model);
  core::Reduction all;
  of_ranks.put_greatest_into(all);
  of_ranks.put_sums_into(all);
  all.over(model.ranks());
  return of_ranks.totals();
}

EnergySum energy_leaving(const Model& model) {
  const Particles& particles = model.particles();
  const Outflow& outflow = *model.outflow();
  Sum sum(model.energy_unit());
  for (std::size_t i = 0; i < particles.owned; ++i) {
    if (!outflow.takes(particles.place[i])) continue;
    const Motion& m = particles.motion[i];
    const double still = product(model.gravity(), particles.place[i].x);
    sum.add((0.5 * square(m.v) - still) / m.inverse_mass + 0.5 * square(m.w) / m.inverse_inertia);
  }
  const auto add = [&](const Contacts& contacts, bool walls) {
    each_contact(model, contacts, walls, [&](const Contacts::Pair& pair, double energy, const ContactBatch&, int) {
      const bool second = !walls && outflow.takes(particles.place[std::size_t(pair.second)]);
      if (second || outflow.takes(particles.place[std::size_t(pair.first)])) sum.add(energy);
    });
  };
  add(model.pairs(), false);
  add(model.walls(), true);
  return sum.sum();
}

}  // namespace polybed::dem
