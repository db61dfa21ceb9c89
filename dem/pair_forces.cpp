#include "dem/pair_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polybed::dem {

namespace {

/// n, r and lever arms of pairs of particles; the distance becomes n, the velocity that of the surfaces.
POLYBED_ALL_VECTOR_WIDTHS void shape_pairs(ContactBatch& b, const Images& images) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    double dx = b.distance[0][c], dy = b.distance[1][c], dz = b.distance[2][c];
    b.velocity[0][c] -= images.shorten(dx, dy, dz);
    const double r = std::sqrt(dx * dx + dy * dy + dz * dz), inverse = 1 / r;
    const double ri = b.radius_i[c], rj = b.radius_j[c];
    b.arm_i[c] = 0.5 * (r + (ri - rj) * (ri + rj) * inverse);
    b.arm_j[c] = r - b.arm_i[c];
    b.overlap[c] = ri + rj - r;
    b.distance[0][c] = dx * inverse;
    b.distance[1][c] = dy * inverse;
    b.distance[2][c] = dz * inverse;
  }
}

/// v_c = v_i - v_j - (l_i w_i + l_j w_j) x n, split into v_n and v_t.
POLYBED_ALL_VECTOR_WIDTHS void split_velocity(ContactBatch& b) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double nx = b.distance[0][c], ny = b.distance[1][c], nz = b.distance[2][c];
    const double li = b.arm_i[c], lj = b.arm_j[c];
    const double wx = li * b.spin_i[0][c] + lj * b.spin_j[0][c];
    const double wy = li * b.spin_i[1][c] + lj * b.spin_j[1][c];
    const double wz = li * b.spin_i[2][c] + lj * b.spin_j[2][c];
    const double vx = b.velocity[0][c] - (wy * nz - wz * ny);
    const double vy = b.velocity[1][c] - (wz * nx - wx * nz);
    const double vz = b.velocity[2][c] - (wx * ny - wy * nx);
    const double vn = vx * nx + vy * ny + vz * nz;
    b.speed[c] = vn;
    b.velocity[0][c] = vx - vn * nx;
    b.velocity[1][c] = vy - vn * ny;
    b.velocity[2][c] = vz - vn * nz;
  }
}

/// F = F_n n + F_t and n x F_t on both lever arms, in units.
POLYBED_ALL_VECTOR_WIDTHS void count_units(ContactBatch& b, double per_force, double per_torque) {
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

POLYBED_ALL_VECTOR_WIDTHS void add_moment(ContactBatch& b, double per_torque) {
  const int n = b.padded();
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < n; ++c) {
      const double units = b.moment[k][c] * per_torque;
      b.torque_i[k][c] += units;
      b.torque_j[k][c] -= units;
    }
}

/// Whether a contact is deeper than allowed, or its overlap is not a number.
POLYBED_ALL_VECTOR_WIDTHS bool any_deeper(const ContactBatch& b, double max_overlap) {
  int deeper = 0;
  for (int c = 0; c < b.count; ++c) {
    const double least = b.radius_i[c] < b.radius_j[c] ? b.radius_i[c] : b.radius_j[c];
    deeper |= b.overlap[c] <= 2 * max_overlap * least ? 0 : 1;
  }
  return deeper != 0;
}

/// Distance of a centre from a wall, positive inside the box, m.
double height_over(const Wall& wall, const Place& place) {
  const double s = place.x[std::size_t(wall.axis)] - wall.place;
  return wall.side == 0 ? s : -s;
}

void load_memory(const Contacts& contacts, ContactBatch& b) {
  for (int c = 0; c < b.count; ++c) {
    const double* memory = contacts.memory_of(b.pair[c]);
    for (int m = 0; m < contacts.memory_size; ++m) b.memory[m][c] = memory[m];
  }
}

void store_memory(Contacts& contacts, const ContactBatch& b) {
  for (int c = 0; c < b.count; ++c) {
    double* memory = contacts.memory_of(b.pair[c]);
    for (int m = 0; m < contacts.memory_size; ++m) memory[m] = b.memory[m][c];
  }
}

/// Fills a batch with the pairs nearer than their reach from place p of the list on; where the answer is no, the place
/// in the batch is overwritten by the next. Returns where to go on.
std::int32_t find_touching(const Particles& particles, const Contacts& contacts, const Images& images, double reach,
                           std::int32_t p, ContactBatch& b) {
  const auto end = std::int32_t(contacts.pairs.size());
  int n = 0;
  for (; p < end && n < ContactBatch::width; ++p) {
    const Contacts::Pair pair = contacts.pairs[std::size_t(p)];
    const Place &i = particles.place[std::size_t(pair.first)], &j = particles.place[std::size_t(pair.second)];
    double dx = i.x[0] - j.x[0], dy = i.x[1] - j.x[1], dz = i.x[2] - j.x[2];
    b.distance[0][n] = dx;
    b.distance[1][n] = dy;
    b.distance[2][n] = dz;
    b.radius_i[n] = i.radius;
    b.radius_j[n] = j.radius;
    b.pair[n] = p;
    b.first[n] = pair.first;
    b.second[n] = pair.second;
    images.shorten(dx, dy, dz);
    const double near = i.radius + j.radius + reach;
    n += dx * dx + dy * dy + dz * dz < near * near ? 1 : 0;
  }
  b.count = n;
  return p;
}

/// The rest of what a contact of particles needs, once its pair is known.
void load_pairs(const Particles& particles, const Contacts& contacts, const Materials& materials, const Images& images,
                ContactBatch& b) {
  for (int c = 0; c < b.count; ++c) {
    const auto i = std::size_t(b.first[c]), j = std::size_t(b.second[c]);
    const Motion &mi = particles.motion[i], &mj = particles.motion[j];
    for (std::size_t k = 0; k < 3; ++k) {
      b.velocity[k][c] = mi.v[k] - mj.v[k];
      b.spin_i[k][c] = mi.w[k];
      b.spin_j[k][c] = mj.w[k];
    }
    b.kind[c] = materials.kind(particles.species[i], particles.species[j]);
  }
  load_memory(contacts, b);
  shape_pairs(b, images);
  split_velocity(b);
}

/// Likewise of contacts with walls.
void load_walls(const Particles& particles, const Contacts& contacts, const Materials& materials, const Box& box,
                ContactBatch& b) {
  for (int c = 0; c < b.count; ++c) {
    const auto i = std::size_t(b.first[c]);
    const Wall& wall = box.walls[std::size_t(b.second[c])];
    const Place& place = particles.place[i];
    for (int k = 0; k < 3; ++k) {
      b.distance[k][c] = k != wall.axis ? 0.0 : (wall.side == 0 ? 1.0 : -1.0);
      b.velocity[k][c] = particles.motion[i].v[std::size_t(k)];
      b.spin_i[k][c] = particles.motion[i].w[std::size_t(k)];
      b.spin_j[k][c] = 0;
    }
    b.radius_i[c] = b.radius_j[c] = place.radius;
    b.arm_i[c] = height_over(wall, place);
    b.arm_j[c] = 0;
    b.overlap[c] = place.radius - b.arm_i[c];
    b.kind[c] = materials.wall_kind(particles.species[i]);
  }
  load_memory(contacts, b);
  split_velocity(b);
}

/// The next pairs of a list that touched at the last force.
void take_touching(const Particles& particles, const Contacts& contacts, std::size_t begin, bool walls,
                   ContactBatch& b) {
  b.count = int(std::min(contacts.touching.size() - begin, std::size_t(ContactBatch::width)));
  for (int c = 0; c < b.count; ++c) {
    b.pair[c] = contacts.touching[begin + std::size_t(c)];
    const Contacts::Pair pair = contacts.pairs[std::size_t(b.pair[c])];
    b.first[c] = pair.first;
    b.second[c] = pair.second;
    if (walls) continue;
    const Place &i = particles.place[std::size_t(pair.first)], &j = particles.place[std::size_t(pair.second)];
    for (std::size_t k = 0; k < 3; ++k) b.distance[k][c] = i.x[k] - j.x[k];
    b.radius_i[c] = i.radius;
    b.radius_j[c] = j.radius;
  }
}

void add_load(Load& load, const ContactBatch::Row* force, int sign, const ContactBatch::Row* torque, int c) {
  for (std::size_t k = 0; k < 3; ++k) {
    load.force[k] += sign * std::int64_t(force[k][c]);
    load.torque[k] += std::int64_t(torque[k][c]);
  }
}

}  // namespace

PairForces::PairForces(const Box& box, const Materials& materials, const PairLaws& laws, FixedPoint force,
                       FixedPoint torque, double max_overlap)
    : box_(box), materials_(materials), laws_(laws), force_(force), torque_(torque), max_overlap_(max_overlap) {
  // Beyond the last contact of a batch its loops run over a pair that does nothing.
  std::fill_n(batch_.distance[0], ContactBatch::width, 1.0);
  std::fill_n(batch_.radius_i, ContactBatch::width, 0.25);
  std::fill_n(batch_.radius_j, ContactBatch::width, 0.25);
}

void PairForces::gather(const Particles& particles, const Contacts& contacts, const Images& images, std::size_t begin,
                        ContactBatch& b) const {
  take_touching(particles, contacts, begin, false, b);
  load_pairs(particles, contacts, materials_, images, b);
}

void PairForces::gather_walls(const Particles& particles, const Contacts& contacts, std::size_t begin,
                              ContactBatch& b) const {
  take_touching(particles, contacts, begin, true, b);
  load_walls(particles, contacts, materials_, box_, b);
}

void PairForces::act(double dt) {
  laws_.normal->act(batch_);
  if (laws_.tangential) laws_.tangential->act(batch_, dt);
  if (laws_.rolling) laws_.rolling->act(batch_, dt);
  if (ledger_ != nullptr) ledger_->act(batch_, counted_, dt);
  if (laws_.cohesion) laws_.cohesion->act(batch_);
  count_units(batch_, force_.per_unit, torque_.per_unit);
  if (laws_.rolling) add_moment(batch_, torque_.per_unit);
  contact_steps_ += std::uint64_t(batch_.count);
}

/// A pair across ranks is computed on both, and counted where its first particle is at home.
void PairForces::mark_counted(std::size_t owned) {
  for (int c = 0; c < batch_.count; ++c) counted_[c] = std::size_t(batch_.first[c]) < owned ? 1 : 0;
}

void PairForces::watch_overlap(bool wall) {
  if (!any_deeper(batch_, max_overlap_)) return;
  for (int c = 0; c < batch_.count; ++c) {
    const double excess = batch_.overlap[c] - 2 * max_overlap_ * std::min(batch_.radius_i[c], batch_.radius_j[c]);
    // Turned round, so that the distance of two centres at one place, whose n is not a number, is too small as well.
    if (!(excess <= trouble_.excess))
      trouble_ = {std::isnan(batch_.speed[c]) ? std::numeric_limits<double>::infinity() : excess, batch_.pair[c], wall};
  }
}

/// What is done with a batch once it is full: laws, and the memory of its contacts.
void PairForces::treat(const Particles& particles, Contacts& contacts, bool wall, double dt) {
  watch_overlap(wall);
  if (ledger_ != nullptr) mark_counted(particles.owned);
  act(dt);
  store_memory(contacts, batch_);
  contacts.touching.insert(contacts.touching.end(), batch_.pair, batch_.pair + batch_.count);
}

void PairForces::add_pairs(Particles& particles, Contacts& contacts, double time, double dt) {
  const Images images(box_, time);
  const auto end = std::int32_t(contacts.pairs.size());
  std::swap(before_, contacts.touching);
  contacts.touching.clear();
  for (std::int32_t p = 0; p < end;) {
    p = find_touching(particles, contacts, images, laws_.reach(), p, batch_);
    load_pairs(particles, contacts, materials_, images, batch_);
    treat(particles, contacts, false, dt);
    for (int c = 0; c < batch_.count; ++c) {
      add_load(particles.load[std::size_t(batch_.first[c])], batch_.force, 1, batch_.torque_i, c);
      add_load(particles.load[std::size_t(batch_.second[c])], batch_.force, -1, batch_.torque_j, c);
    }
  }
  contacts.forget_parted(before_);
  pair_checks_ += contacts.pairs.size();
}

void PairForces::add_walls(Particles& particles, Contacts& contacts, double dt) {
  const auto end = std::int32_t(contacts.pairs.size());
  std::swap(before_, contacts.touching);
  contacts.touching.clear();
  for (std::int32_t p = 0; p < end;) {
    batch_.count = 0;
    for (; p < end && batch_.count < ContactBatch::width; ++p) {
      const Contacts::Pair pair = contacts.pairs[std::size_t(p)];
      const Place& place = particles.place[std::size_t(pair.first)];
      batch_.pair[batch_.count] = p;
      batch_.first[batch_.count] = pair.first;
      batch_.second[batch_.count] = pair.second;
      if (height_over(box_.walls[std::size_t(pair.second)], place) < place.radius + laws_.reach()) ++batch_.count;
    }
    load_walls(particles, contacts, materials_, box_, batch_);
    treat(particles, contacts, true, dt);
    for (int c = 0; c < batch_.count; ++c)
      add_load(particles.load[std::size_t(batch_.first[c])], batch_.force, 1, batch_.torque_i, c);
  }
  contacts.forget_parted(before_);
  pair_checks_ += contacts.pairs.size();
}

}  // namespace polybed::dem
