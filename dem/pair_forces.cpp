#include "dem/pair_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polybed::dem {

namespace {

/// n, r and lever arms of pairs of particles; the distance becomes n, the velocity that of the surfaces.
POLYBED_ALL_VECTOR_WIDTHS void shape_pairs(ContactBatch& b, const Images& images) {
  const int n = b.padded();
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

/// F = F_n n + F_t and n x F_t on both lever arms, in whole units.
POLYBED_ALL_VECTOR_WIDTHS void count_units(ContactBatch& b, double per_force, double per_torque) {
  const int n = b.padded();
  for (int c = 0; c < n; ++c) {
    const double nx = b.distance[0][c], ny = b.distance[1][c], nz = b.distance[2][c];
    const double tx = b.tangential[0][c], ty = b.tangential[1][c], tz = b.tangential[2][c];
    b.force[0][c] = std::int64_t((b.normal[c] * nx + tx) * per_force);
    b.force[1][c] = std::int64_t((b.normal[c] * ny + ty) * per_force);
    b.force[2][c] = std::int64_t((b.normal[c] * nz + tz) * per_force);
    const double qx = ny * tz - nz * ty, qy = nz * tx - nx * tz, qz = nx * ty - ny * tx;
    const double li = -b.arm_i[c] * per_torque, lj = -b.arm_j[c] * per_torque;
    b.torque_i[0][c] = std::int64_t(li * qx);
    b.torque_i[1][c] = std::int64_t(li * qy);
    b.torque_i[2][c] = std::int64_t(li * qz);
    b.torque_j[0][c] = std::int64_t(lj * qx);
    b.torque_j[1][c] = std::int64_t(lj * qy);
    b.torque_j[2][c] = std::int64_t(lj * qz);
  }
}

POLYBED_ALL_VECTOR_WIDTHS void add_moment(ContactBatch& b, double per_torque) {
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < b.padded(); ++c) {
      const auto units = std::int64_t(b.moment[k][c] * per_torque);
      b.torque_i[k][c] += units;
      b.torque_j[k][c] -= units;
    }
}

/// Pairs of a list nearer than their reach, rising; where the answer is no, the place is overwritten by the next.
POLYBED_ALL_VECTOR_WIDTHS void find_touching_pairs(const Particles& particles, Contacts& contacts, const Images& images,
                                                   double reach) {
  contacts.touching.resize(contacts.pairs.size() + 1);
  std::int32_t* out = contacts.touching.data();
  const Place* place = particles.place.data();
  const auto count = std::int32_t(contacts.pairs.size());
  for (std::int32_t p = 0; p < count; ++p) {
    const Contacts::Pair pair = contacts.pairs[std::size_t(p)];
    const Place &i = place[pair.first], &j = place[pair.second];
    double dx = i.x[0] - j.x[0], dy = i.x[1] - j.x[1], dz = i.x[2] - j.x[2];
    images.shorten(dx, dy, dz);
    const double near = i.radius + j.radius + reach;
    *out = p;
    out += dx * dx + dy * dy + dz * dz < near * near ? 1 : 0;
  }
  contacts.touching.resize(std::size_t(out - contacts.touching.data()));
}

/// Distance of a centre from a wall, positive inside the box, m.
double height_over(const Wall& wall, const Place& place) {
  const double s = place.x[std::size_t(wall.axis)] - wall.place;
  return wall.side == 0 ? s : -s;
}

void gather_memory(const Contacts& contacts, std::size_t begin, ContactBatch& b) {
  for (int c = 0; c < b.count; ++c) {
    const double* memory = contacts.memory_of(contacts.touching[begin + std::size_t(c)]);
    for (int m = 0; m < contacts.memory_size; ++m) b.memory[m][c] = memory[m];
  }
}

void scatter_memory(Contacts& contacts, std::size_t begin, const ContactBatch& b) {
  for (int c = 0; c < b.count; ++c) {
    double* memory = contacts.memory_of(contacts.touching[begin + std::size_t(c)]);
    for (int m = 0; m < contacts.memory_size; ++m) memory[m] = b.memory[m][c];
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
  b.count = int(std::min(contacts.touching.size() - begin, std::size_t(ContactBatch::width)));
  for (int c = 0; c < b.count; ++c) {
    const Contacts::Pair pair = contacts.pairs[std::size_t(contacts.touching[begin + std::size_t(c)])];
    const auto i = std::size_t(pair.first), j = std::size_t(pair.second);
    const Place &pi = particles.place[i], &pj = particles.place[j];
    const Motion &mi = particles.motion[i], &mj = particles.motion[j];
    for (std::size_t k = 0; k < 3; ++k) {
      b.distance[k][c] = pi.x[k] - pj.x[k];
      b.velocity[k][c] = mi.v[k] - mj.v[k];
      b.spin_i[k][c] = mi.w[k];
      b.spin_j[k][c] = mj.w[k];
    }
    b.radius_i[c] = pi.radius;
    b.radius_j[c] = pj.radius;
    b.kind[c] = materials_.kind(particles.species[i], particles.species[j]);
  }
  gather_memory(contacts, begin, b);
  shape_pairs(b, images);
  split_velocity(b);
}

void PairForces::gather_walls(const Particles& particles, const Contacts& contacts, std::size_t begin,
                              ContactBatch& b) const {
  b.count = int(std::min(contacts.touching.size() - begin, std::size_t(ContactBatch::width)));
  for (int c = 0; c < b.count; ++c) {
    const Contacts::Pair pair = contacts.pairs[std::size_t(contacts.touching[begin + std::size_t(c)])];
    const auto i = std::size_t(pair.first);
    const Wall& wall = box_.walls[std::size_t(pair.second)];
    const double height = height_over(wall, particles.place[i]);
    for (int k = 0; k < 3; ++k) {
      b.distance[k][c] = k != wall.axis ? 0.0 : (wall.side == 0 ? 1.0 : -1.0);
      b.velocity[k][c] = particles.motion[i].v[std::size_t(k)];
      b.spin_i[k][c] = particles.motion[i].w[std::size_t(k)];
      b.spin_j[k][c] = 0;
    }
    b.radius_i[c] = particles.place[i].radius;
    b.radius_j[c] = particles.place[i].radius;
    b.arm_i[c] = height;
    b.arm_j[c] = 0;
    b.overlap[c] = particles.place[i].radius - height;
    b.kind[c] = materials_.wall_kind(particles.species[i]);
  }
  gather_memory(contacts, begin, b);
  split_velocity(b);
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
void PairForces::mark_counted(const Particles& particles, const Contacts& contacts, std::size_t begin) {
  for (int c = 0; c < batch_.count; ++c) {
    const Contacts::Pair pair = contacts.pairs[std::size_t(contacts.touching[begin + std::size_t(c)])];
    counted_[c] = std::size_t(pair.first) < particles.owned ? 1 : 0;
  }
}

void PairForces::watch_overlap(const Contacts& contacts, std::size_t begin, bool wall) {
  for (int c = 0; c < batch_.count; ++c) {
    const double allowed = 2 * max_overlap_ * std::min(batch_.radius_i[c], batch_.radius_j[c]);
    // Turned round, so that a distance of zero, whose overlap is not a number, is beyond what is allowed too.
    if (!(batch_.overlap[c] - allowed <= trouble_.excess))
      trouble_ = {std::isnan(batch_.speed[c]) ? std::numeric_limits<double>::infinity() : batch_.overlap[c] - allowed,
                  contacts.touching[begin + std::size_t(c)], wall};
  }
}

void PairForces::add_pairs(Particles& particles, Contacts& contacts, double time, double dt) {
  const Images images(box_, time);
  std::swap(before_, contacts.touching);
  find_touching_pairs(particles, contacts, images, laws_.reach());
  if (ledger_ != nullptr) ledger_->part(contacts, before_, particles.owned);
  contacts.forget_parted(before_);
  pair_checks_ += contacts.pairs.size();
  for (std::size_t begin = 0; begin < contacts.touching.size(); begin += ContactBatch::width) {
    gather(particles, contacts, images, begin, batch_);
    watch_overlap(contacts, begin, false);
    if (ledger_ != nullptr) mark_counted(particles, contacts, begin);
    act(dt);
    scatter_memory(contacts, begin, batch_);
    for (int c = 0; c < batch_.count; ++c) {
      const Contacts::Pair pair = contacts.pairs[std::size_t(contacts.touching[begin + std::size_t(c)])];
      Load &i = particles.load[std::size_t(pair.first)], &j = particles.load[std::size_t(pair.second)];
      for (std::size_t k = 0; k < 3; ++k) {
        i.force[k] += batch_.force[k][c];
        j.force[k] -= batch_.force[k][c];
        i.torque[k] += batch_.torque_i[k][c];
        j.torque[k] += batch_.torque_j[k][c];
      }
    }
  }
}

void PairForces::add_walls(Particles& particles, Contacts& contacts, double dt) {
  std::swap(before_, contacts.touching);
  contacts.touching.clear();
  for (std::int32_t p = 0; p < std::int32_t(contacts.pairs.size()); ++p) {
    const Contacts::Pair pair = contacts.pairs[std::size_t(p)];
    const Place& place = particles.place[std::size_t(pair.first)];
    if (height_over(box_.walls[std::size_t(pair.second)], place) < place.radius + laws_.reach())
      contacts.touching.push_back(p);
  }
  if (ledger_ != nullptr) ledger_->part(contacts, before_, particles.owned);
  contacts.forget_parted(before_);
  pair_checks_ += contacts.pairs.size();
  for (std::size_t begin = 0; begin < contacts.touching.size(); begin += ContactBatch::width) {
    gather_walls(particles, contacts, begin, batch_);
    watch_overlap(contacts, begin, true);
    if (ledger_ != nullptr) mark_counted(particles, contacts, begin);
    act(dt);
    scatter_memory(contacts, begin, batch_);
    for (int c = 0; c < batch_.count; ++c) {
      const Contacts::Pair pair = contacts.pairs[std::size_t(contacts.touching[begin + std::size_t(c)])];
      Load& i = particles.load[std::size_t(pair.first)];
      for (std::size_t k = 0; k < 3; ++k) {
        i.force[k] += batch_.force[k][c];
        i.torque[k] += batch_.torque_i[k][c];
      }
    }
  }
}

}  // namespace polybed::dem
