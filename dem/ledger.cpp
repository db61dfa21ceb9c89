#include "dem/ledger.hpp"

#include "core/vectors.hpp"

namespace polybed::dem {

namespace {

using Row = ContactBatch::Row;

/// Adds load . rate for the last step, from the memory, and for the present one, which it stores.
void add_power(ContactBatch& b, int m, const Row* load, const Row* rate, Row& before, Row& now) {
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < b.padded(); ++c) {
      before[c] += b.memory[m + k][c] * rate[k][c];
      now[c] += load[k][c] * rate[k][c];
      b.memory[m + k][c] = load[k][c];
    }
}

/// Adds a spring's gain since the last step, and its energy.
void add_stored(ContactBatch& b, int m, const Row& stored, Row& gained, Row& held) {
  for (int c = 0; c < b.padded(); ++c) {
    gained[c] += stored[c] - b.memory[m][c];
    held[c] += stored[c];
    b.memory[m][c] = stored[c];
  }
}

void add_counted(const Row& lost, const Row& counted, int count, double per_unit, EnergySum& sum) {
  for (int c = 0; c < count; ++c) sum.add(counted[c] * lost[c] * per_unit);
}

}  // namespace

Ledger::Ledger(const PairLaws& laws, int place, bool synchronised, FixedPoint unit, FixedPoint force)
    : laws_(laws), place_(place), synchronised_(synchronised), unit_(unit), force_(force) {
  // Force is a power of overlap, the same for all pairs: any overlap gives the share.
  constexpr double overlap = 1e-6;
  elastic_share_ = laws.normal->energy(0, overlap) / (laws.normal->force_at(0, overlap) * overlap);
}

void Ledger::act(ContactBatch& batch, const Row& counted, double dt) {
  alignas(64) Row before = {}, now = {}, gained = {}, held = {}, stored = {}, lost = {};
  Row &due = batch.memory[place_], &if_parted = batch.memory[place_ + 1];
  for (int c = 0; c < batch.padded(); ++c) {
    before[c] = due[c] * batch.speed[c];
    now[c] = (batch.normal[c] - batch.elastic[c]) * batch.speed[c];
  }
  int place = place_ + 2;
  if (laws_.tangential) {
    core::in_vectors<add_power>(batch, place, batch.tangential, batch.velocity, before, now);
    laws_.tangential->energy(batch, stored);
    add_stored(batch, place + 3, stored, gained, held);
    place += 4;
  }
  if (laws_.rolling) {
    alignas(64) Row spin[3], turned = {};
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < batch.padded(); ++c) spin[k][c] = batch.spin_i[k][c] - batch.spin_j[k][c];
    core::in_vectors<add_power>(batch, place, batch.moment, spin, before, now);
    laws_.rolling->add_energy(batch, turned);
    add_stored(batch, place + 3, turned, gained, held);
  }
  const double half = -0.5 * dt;
  for (int c = 0; c < batch.padded(); ++c) {
    // An open contact is still listed within the range of cohesion, but it has separated.
    const bool open = batch.overlap[c] <= 0;
    lost[c] = open ? if_parted[c] : half * (synchronised_ ? due[c] : before[c]) + half * now[c] - gained[c];
    due[c] = synchronised_ ? now[c] : batch.normal[c] - batch.elastic[c];
    const bool ended = batch.normal[c] == 0;
    if_parted[c] = (ended ? elastic_share_ * batch.elastic[c] * batch.overlap[c] : half * now[c]) + held[c];
  }
  laws_.each_attraction([&](const CohesionLaw& law) { law.add_loss(batch, lost); });
  add_counted(lost, counted, batch.count, unit_.per_unit, lost_);
}

void Ledger::begin_step(std::size_t particles) {
  if (laws_.film && synchronised_) of_films_.assign(particles, {});
}

double Ledger::work_of_films(std::size_t particle, const Vector& missed) const {
  if (of_films_.empty()) return 0;
  double power = 0;
  for (std::size_t k = 0; k < 3; ++k) power += double(of_films_[particle][k]) * missed[k];
  return power * force_.unit;
}

/// Uses whole units as in the loads: the same in any order of pairs.
void Ledger::add_films(const ContactBatch& batch, const Row& force, bool wall) {
  for (int c = 0; c < batch.count; ++c)
    for (std::size_t k = 0; k < 3; ++k) {
      const double units = force[c] * batch.distance[k][c] * force_.per_unit;
      add_units(units, of_films_[std::size_t(batch.first[c])][k]);
      if (!wall) add_units(-units, of_films_[std::size_t(batch.second[c])][k]);
    }
}

void Ledger::act_film(ContactBatch& batch, const Row& force, const Row& counted, double dt, bool wall) {
  if (!of_films_.empty()) add_films(batch, force, wall);
  Row &due = batch.memory[place_ + before_film(laws_)], &if_parted = batch.memory[place_ + before_film(laws_) + 1];
  alignas(64) Row lost = {};
  const double half = -0.5 * dt;
  for (int c = 0; c < batch.padded(); ++c) {
    const double now = force[c] * batch.speed[c];
    lost[c] = half * (synchronised_ ? due[c] : due[c] * batch.speed[c]) + half * now;
    due[c] = synchronised_ ? now : force[c];
    if_parted[c] = half * now;
  }
  add_counted(lost, counted, batch.count, unit_.per_unit, lost_);
}

void Ledger::part(const Contacts& contacts, std::size_t owned) {
  contacts.each_parted([&](std::int32_t pair) {
    if (std::size_t(contacts.pairs[std::size_t(pair)].first) >= owned) return;
    const double* memory = contacts.memory_of(pair) + place_;
    lost_.add(memory[1] * unit_.per_unit);
    if (laws_.film) lost_.add(memory[before_film(laws_) + 1] * unit_.per_unit);
  });
}

}  // namespace polybed::dem
