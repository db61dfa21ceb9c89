#include "dem/contacts/pair_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/vectors.hpp"
#include "dem/contacts/rows.hpp"

namespace polybed::dem {

namespace {

/// F = F_n n + F_t and n x F_t on both lever arms, in units.
void count_units(ContactBatch& b, double per_force, double per_torque) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double nx = b.distance[0][c], ny = b.distance[1][c], nz = b.distance[2][c];
    const double tx = b.tangential[0][c], ty = b.tangential[1][c], tz = b.tangential[2][c];
    b.force[0][c] = (b.normal[c] * nx + tx) * per_force;
    b.force[1][c] = (b.normal[c] * ny + ty) * per_force;
    b.force[2][c] = (b.normal[c] * nz + tz) * per_force;
    const double qx = ny * tz - nz * ty, qy = nz * tx - nx * tz, qz = nx * ty - ny * tx;
    const double li = -b.arm_i[c] * per_torque, lj = -b.arm_j[c] * per_torque;
    b.torque_i[0][c] = li * qx;
    b.torque_i[1][c] = li * qy;
    b.torque_i[2][c] = li * qz;
    b.torque_j[0][c] = lj * qx;
    b.torque_j[1][c] = lj * qy;
    b.torque_j[2][c] = lj * qz;
  }
}

void add_moment(ContactBatch& b, double per_torque) {
  const int n = b.padded();
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < n; ++c) {
      const double units = b.moment[k][c] * per_torque;
      b.torque_i[k][c] += units;
      b.torque_j[k][c] -= units;
    }
}

/// Clears the first rows of the memory for pairs within the range of cohesion that do not touch: a new contact has
/// none.
void forget_open(ContactBatch& b, int rows) {
  const int n = b.padded();
  for (int m = 0; m < rows; ++m)
    for (int c = 0; c < n; ++c) b.memory[m][c] = b.overlap[c] > 0 ? b.memory[m][c] : 0;
}

/// Whether a contact is deeper than allowed, or its overlap is NaN.
bool any_deeper(const ContactBatch& b, double max_overlap) {
  int deeper = 0;
  for (int c = 0; c < b.count; ++c) {
    const double least = b.radius_i[c] < b.radius_j[c] ? b.radius_i[c] : b.radius_j[c];
    deeper |= b.overlap[c] <= 2 * max_overlap * least ? 0 : 1;
  }
  return deeper != 0;
}

void store_memory(double* memory, int size, const ContactBatch& b) {
  int m = 0;
  const int fours = b.count & ~3;
  for (; m + 4 <= size; m += 4) {
    for (int c = 0; c < fours; c += 4) {
      Four kept[4];
#pragma GCC unroll 4
      for (int k = 0; k < 4; ++k) get_four(b.memory[m + k] + c, kept[k]);
      transpose(kept);
#pragma GCC unroll 4
      for (int k = 0; k < 4; ++k) put_four(kept[k], memory + std::ptrdiff_t(b.pair[c + k]) * size + m);
    }
    for (int c = fours; c < b.count; ++c)
      for (int k = m; k < m + 4; ++k) memory[std::ptrdiff_t(b.pair[c]) * size + k] = b.memory[k][c];
  }
  for (; m < size; ++m)
    for (int c = 0; c < b.count; ++c) memory[std::ptrdiff_t(b.pair[c]) * size + m] = b.memory[m][c];
}

void add_to_first(const ContactBatch& b, int c, Load& first) {
  for (std::size_t k = 0; k < 3; ++k) {
    add_units(b.force[k][c], first.force[k]);
    add_units(b.torque_i[k][c], first.torque[k]);
  }
}

void add_to_pair(const ContactBatch& b, int c, Load& first, Load& second) {
  add_to_first(b, c, first);
  for (std::size_t k = 0; k < 3; ++k) {
    add_units(-b.force[k][c], second.force[k]);
    add_units(b.torque_j[k][c], second.torque[k]);
  }
}

}  // namespace

PairForces::PairForces(const Box& box, const Materials& materials, const PairLaws& laws, FixedPoint force,
                       FixedPoint torque, double max_overlap)
    : loader_(box, materials, laws.reach()), laws_(laws), force_(force), torque_(torque), max_overlap_(max_overlap) {
  // Loops run beyond the last contact of a batch, over a pair without effect.
  std::fill_n(batch_.distance[0], ContactBatch::width, 1.0);
  std::fill_n(batch_.radius_i, ContactBatch::width, 0.25);
  std::fill_n(batch_.radius_j, ContactBatch::width, 0.25);
}

void PairForces::act(double dt, bool wall) {
  laws_.normal->act(batch_);
  if (laws_.tangential) laws_.tangential->act(batch_, dt);
  if (laws_.rolling) laws_.rolling->act(batch_, dt);
  if (laws_.reach() > 0) core::in_vectors<forget_open>(batch_, laws_.contact_memory());
  if (ledger_ != nullptr) ledger_->act(batch_, counted_, dt);
  laws_.each_attraction([&](const CohesionLaw& law) { law.act(batch_, dt); });
  if (laws_.film) add_film(dt, wall);
  core::in_vectors<count_units>(batch_, force_.per_unit, torque_.per_unit);
  if (laws_.rolling) core::in_vectors<add_moment>(batch_, torque_.per_unit);
  contact_steps_ += std::uint64_t(batch_.count);
}

void PairForces::add_film(double dt, bool wall) {
  alignas(64) ContactBatch::Row force;
  laws_.film->act(batch_, force);
  if (ledger_ != nullptr) ledger_->act_film(batch_, force, counted_, dt, wall);
  for (int c = 0; c < batch_.padded(); ++c) batch_.normal[c] += force[c];
}

/// A pair across ranks is computed on both ranks, and counted on its first particle's owner.
void PairForces::mark_counted(std::size_t owned) {
  for (int c = 0; c < batch_.count; ++c) counted_[c] = std::size_t(batch_.first[c]) < owned ? 1 : 0;
}

void PairForces::watch_overlap(bool wall) {
  if (!core::in_vectors<any_deeper>(batch_, max_overlap_)) return;
  for (int c = 0; c < batch_.count; ++c) {
    const double excess = batch_.overlap[c] - 2 * max_overlap_ * std::min(batch_.radius_i[c], batch_.radius_j[c]);
    // Written so that two coinciding centres, whose n is NaN, also count as too close.
    if (!(excess <= trouble_.excess))
      trouble_ = {std::isnan(batch_.speed[c]) ? std::numeric_limits<double>::infinity() : excess, batch_.pair[c], wall};
  }
}

/// Applies the laws to a full batch and updates its contacts' memory. Discards an invalid batch, so that no NaN reaches
/// the final checkpoint.
void PairForces::treat(const Particles& particles, Contacts& contacts, bool wall, double dt) {
  watch_overlap(wall);
  if (trouble_.pair >= 0) {
    batch_.count = 0;
    return;
  }
  if (ledger_ != nullptr) mark_counted(particles.owned);
  act(dt, wall);
  core::in_vectors<store_memory>(contacts.memory.data(), contacts.memory_size, batch_);
  contacts.touching.insert(contacts.touching.end(), batch_.pair, batch_.pair + batch_.count);
}

void PairForces::add_inner_pairs(Particles& particles, Contacts& contacts, const Images& images, double dt) {
  contacts.begin_touching();
  add_pairs(particles, contacts, images, 0, contacts.inner, dt);
}

void PairForces::add_outer_pairs(Particles& particles, Contacts& contacts, const Images& images, double dt) {
  add_pairs(particles, contacts, images, contacts.inner, contacts.pairs.size(), dt);
  if (ledger_ != nullptr) ledger_->part(contacts, particles.owned);
  contacts.forget_parted();
  pair_checks_ += contacts.pairs.size();
}

void PairForces::add_pairs(Particles& particles, Contacts& contacts, const Images& images, std::size_t begin,
                           std::size_t end, double dt) {
  for (auto p = std::int32_t(begin); p < std::int32_t(end);) {
    p = loader_.find_pairs(particles, contacts, images, p, std::int32_t(end), batch_);
    loader_.load_pairs(particles, contacts, images, batch_);
    treat(particles, contacts, false, dt);
    if (joined_work_ != nullptr) joined_work_->act(batch_, counted_, contacts, images);
    Load* const load = particles.load.data();
    for (int c = 0; c < batch_.count; ++c) add_to_pair(batch_, c, load[batch_.first[c]], load[batch_.second[c]]);
  }
}

void PairForces::add_walls(Particles& particles, Contacts& contacts, double dt) {
  const auto end = std::int32_t(contacts.pairs.size());
  contacts.begin_touching();
  for (std::int32_t p = 0; p < end;) {
    p = loader_.find_walls(particles, contacts, p, batch_);
    loader_.load_walls(particles, contacts, batch_);
    treat(particles, contacts, true, dt);
    for (int c = 0; c < batch_.count; ++c) add_to_first(batch_, c, particles.load[std::size_t(batch_.first[c])]);
  }
  if (ledger_ != nullptr) ledger_->part(contacts, particles.owned);
  contacts.forget_parted();
  pair_checks_ += contacts.pairs.size();
}

}  // namespace polybed::dem
