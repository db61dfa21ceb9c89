#include "dem/contacts/loader.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/vectors.hpp"
#include "dem/contacts/rows.hpp"

namespace polybed::dem {

namespace {

/// n, r and lever arms for pairs of particles; replaces the distance by n and the velocity by the surfaces' velocity.
void shape_pairs(ContactBatch& b) {
  const int n = b.padded();
  POLYBED_INDEPENDENT
  for (int c = 0; c < n; ++c) {
    const double dx = b.distance[0][c], dy = b.distance[1][c], dz = b.distance[2][c];
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
void split_velocity(ContactBatch& b) {
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

/// Loads relative velocities and spins. Rows are filled by fours: beyond the last contact with the first contact's
/// finite values.
void load_motion(const Motion* motion, ContactBatch& b) {
  for (int c = b.count; (c & 3) != 0; ++c) {
    b.first[c] = b.first[0];
    b.second[c] = b.second[0];
  }
  static_assert(offsetof(Motion, w) == 4 * sizeof(double) && sizeof(Motion) == 8 * sizeof(double));
  for (int c = 0; c < b.count; c += 4) {
    Four velocity[4], spin_i[4], spin_j[4];  // the fourth number is unused
#pragma GCC unroll 4
    for (int k = 0; k < 4; ++k) {
      const auto* i = reinterpret_cast<const std::byte*>(motion + b.first[c + k]);
      const auto* j = reinterpret_cast<const std::byte*>(motion + b.second[c + k]);
      Four other;
      get_four(i, velocity[k]);
      get_four(j, other);
      velocity[k] -= other;
      get_four(i + offsetof(Motion, w), spin_i[k]);
      get_four(j + offsetof(Motion, w), spin_j[k]);
    }
    transpose(velocity);
    transpose(spin_i);
    transpose(spin_j);
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      put_four(velocity[k], b.velocity[k] + c);
      put_four(spin_i[k], b.spin_i[k] + c);
      put_four(spin_j[k], b.spin_j[k] + c);
    }
  }
}

/// Likewise, and the rest of the numbers one by one.
void load_memory(const double* memory, int size, ContactBatch& b) {
  for (int c = b.count; (c & 3) != 0; ++c) b.pair[c] = b.pair[0];
  int m = 0;
  for (; m + 4 <= size; m += 4)
    for (int c = 0; c < b.count; c += 4) {
      Four kept[4];
#pragma GCC unroll 4
      for (int k = 0; k < 4; ++k) get_four(memory + std::ptrdiff_t(b.pair[c + k]) * size + m, kept[k]);
      transpose(kept);
#pragma GCC unroll 4
      for (int k = 0; k < 4; ++k) put_four(kept[k], b.memory[m + k] + c);
    }
  for (; m < size; ++m)
    for (int c = 0; c < b.count; ++c) b.memory[m][c] = memory[std::ptrdiff_t(b.pair[c]) * size + m];
}

void name_pair(const Contacts& contacts, std::int32_t p, int c, ContactBatch& b) {
  const Contacts::Pair& pair = contacts.pairs[std::size_t(p)];
  b.pair[c] = p;
  b.first[c] = pair.first;
  b.second[c] = pair.second;
  b.kind[c] = pair.kind;
}

int left(const Contacts& contacts, std::size_t begin) {
  return int(std::min(contacts.touching.size() - begin, std::size_t(ContactBatch::width)));
}

}  // namespace

ContactLoader::ContactLoader(const Box& box, const Materials& materials, double reach) : box_(box), reach_(reach) {
  const auto& species = materials.species();
  kinds_.resize(materials.kinds().size());
  for (std::int32_t a = 0; a < std::int32_t(species.size()); ++a) {
    const double ra = species[std::size_t(a)].radius;
    // A wall counts as no larger than the particle where radii are compared.
    materials.each_wall_kind(a, [&](std::int32_t kind) { kinds_[std::size_t(kind)] = {ra, ra, 0}; });
    for (std::int32_t b = 0; b < std::int32_t(species.size()); ++b) {
      const double rb = species[std::size_t(b)].radius, near = ra + rb + reach;
      kinds_[std::size_t(materials.kind(a, b))] = {ra, rb, near * near};
    }
  }
}

double ContactLoader::height_over(std::int32_t wall, const Place& place) const {
  const Wall& w = box_.walls[std::size_t(wall)];
  const double s = place.x[std::size_t(w.axis)] - w.place;
  return w.side == 0 ? s : -s;
}

/// If a pair does not touch, the next one overwrites its place in the batch.
std::int32_t ContactLoader::find_pairs(const Particles& particles, const Contacts& contacts, const Images& images,
                                       std::int32_t p, std::int32_t end, ContactBatch& b) const {
  // Prefetch: the processor cannot predict the particles of a pair. With more particles than its caches contain it
  // would wait for their places here, and later for their motion and loads.
  constexpr std::int32_t ahead = 16;
  const Place* place = particles.place.data();
  const Motion* motion = particles.motion.data();
  const Load* load = particles.load.data();
  int n = 0;
  for (; p < end && n < ContactBatch::width; ++p) {
    const Contacts::Pair& pair = contacts.pairs[std::size_t(p)];
    const Contacts::Pair& coming = contacts.pairs[std::size_t(std::min(p + ahead, end - 1))];
    __builtin_prefetch(place + coming.first);
    __builtin_prefetch(place + coming.second);
    __builtin_prefetch(motion + pair.first);
    __builtin_prefetch(motion + pair.second);
    __builtin_prefetch(load + pair.first, 1);
    __builtin_prefetch(load + pair.second, 1);
    __builtin_prefetch(contacts.memory_of(p), 1);
    const Vector &i = place[pair.first].x, &j = place[pair.second].x, &shift = images.shift[std::size_t(pair.image)];
    const double dx = i[0] - j[0] - shift[0], dy = i[1] - j[1] - shift[1], dz = i[2] - j[2] - shift[2];
    b.distance[0][n] = dx;
    b.distance[1][n] = dy;
    b.distance[2][n] = dz;
    name_pair(contacts, p, n, b);
    n += dx * dx + dy * dy + dz * dz < kinds_[std::size_t(pair.kind)].near ? 1 : 0;
  }
  b.count = n;
  return p;
}

std::optional<Vector> ContactLoader::from_nearest(std::int32_t wall, const Vector& centre) const {
  const Wall& w = box_.walls[std::size_t(wall)];
  if (w.plate >= 0) return box_.from_plate(w.plate, centre);
  return box_.from_opened(w.axis, w.side, centre);
}

double ContactLoader::distance_from(std::int32_t wall, const Place& place) const {
  const int plate = box_.walls[std::size_t(wall)].plate, axis = box_.walls[std::size_t(wall)].axis;
  if (plate >= 0 && box_.has_joints() && !box_.pushes(plate, place.x)) return std::numeric_limits<double>::infinity();
  const std::optional<Vector> from = from_nearest(wall, place.x);
  if (!from) return height_over(wall, place);
  if (plate < 0 && box_.rim_is_edge(axis, place.x, *from)) return std::numeric_limits<double>::infinity();
  const Vector& d = *from;
  return std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

template <class Distance>
std::int32_t ContactLoader::find_walls_by(const Distance& distance, const Particles& particles,
                                          const Contacts& contacts, std::int32_t p, ContactBatch& b) const {
  const auto end = std::int32_t(contacts.pairs.size());
  b.count = 0;
  for (; p < end && b.count < ContactBatch::width; ++p) {
    const Contacts::Pair& pair = contacts.pairs[std::size_t(p)];
    const Place& place = particles.place[std::size_t(pair.first)];
    name_pair(contacts, p, b.count, b);
    if (distance(pair.second, place) < place.radius + reach_) ++b.count;
  }
  return p;
}

/// Selected once per batch: contacts with whole faces need no further check.
std::int32_t ContactLoader::find_walls(const Particles& particles, const Contacts& contacts, std::int32_t p,
                                       ContactBatch& b) const {
  const auto flat = [&](std::int32_t wall, const Place& place) { return height_over(wall, place); };
  const auto any = [&](std::int32_t wall, const Place& place) { return distance_from(wall, place); };
  return box_.plain() ? find_walls_by(flat, particles, contacts, p, b) : find_walls_by(any, particles, contacts, p, b);
}

void ContactLoader::load_pairs(const Particles& particles, const Contacts& contacts, const Images& images,
                               ContactBatch& b) const {
  core::in_vectors<load_motion>(particles.motion.data(), b);
  fill_by_kind(b, kinds_, [&](const Kind& kind, int c) {
    b.radius_i[c] = kind.first;
    b.radius_j[c] = kind.second;
  });
  if (box_.shear_rate != 0)
    for (int c = 0; c < b.count; ++c)
      b.velocity[0][c] -= images.speed[std::size_t(contacts.pairs[std::size_t(b.pair[c])].image)];
  core::in_vectors<load_memory>(contacts.memory.data(), contacts.memory_size, b);
  core::in_vectors<shape_pairs>(b);
  core::in_vectors<split_velocity>(b);
}

/// Loads contacts with a face that has an opening and with plates like those with a whole face: n, arm and overlap come
/// from the nearest point.
void ContactLoader::turn_to_nearest(const Particles& particles, ContactBatch& b) const {
  for (int c = 0; c < b.count; ++c) {
    const std::optional<Vector> from = from_nearest(b.second[c], particles.place[std::size_t(b.first[c])].x);
    if (!from) continue;
    const Vector& d = *from;
    const double distance = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (std::size_t k = 0; k < 3; ++k) b.distance[k][c] = d[k] / distance;
    b.arm_i[c] = distance;
    b.overlap[c] = b.radius_i[c] - distance;
  }
}

void ContactLoader::load_walls(const Particles& particles, const Contacts& contacts, ContactBatch& b) const {
  for (int c = 0; c < b.count; ++c) {
    const auto i = std::size_t(b.first[c]);
    const Wall& wall = box_.walls[std::size_t(b.second[c])];
    const double radius = particles.place[i].radius;
    for (int k = 0; k < 3; ++k) {
      b.distance[k][c] = k != wall.axis ? 0.0 : (wall.side == 0 ? 1.0 : -1.0);
      b.velocity[k][c] = particles.motion[i].v[std::size_t(k)];
      b.spin_i[k][c] = particles.motion[i].w[std::size_t(k)];
      b.spin_j[k][c] = 0;
    }
    b.radius_i[c] = b.radius_j[c] = radius;
    b.arm_i[c] = height_over(b.second[c], particles.place[i]);
    b.arm_j[c] = 0;
    b.overlap[c] = radius - b.arm_i[c];
  }
  if (!box_.plain()) turn_to_nearest(particles, b);
  core::in_vectors<load_memory>(contacts.memory.data(), contacts.memory_size, b);
  core::in_vectors<split_velocity>(b);
}

void ContactLoader::load_touching_pairs(const Particles& particles, const Contacts& contacts, const Images& images,
                                        std::size_t begin, ContactBatch& b) const {
  b.count = left(contacts, begin);
  for (int c = 0; c < b.count; ++c) {
    name_pair(contacts, contacts.touching[begin + std::size_t(c)], c, b);
    const Vector &i = particles.place[std::size_t(b.first[c])].x, &j = particles.place[std::size_t(b.second[c])].x;
    const Vector d = images.seen({i[0] - j[0], i[1] - j[1], i[2] - j[2]}, contacts.pairs[std::size_t(b.pair[c])].image);
    for (std::size_t k = 0; k < 3; ++k) b.distance[k][c] = d[k];
  }
  load_pairs(particles, contacts, images, b);
}

void ContactLoader::load_touching_walls(const Particles& particles, const Contacts& contacts, std::size_t begin,
                                        ContactBatch& b) const {
  b.count = left(contacts, begin);
  for (int c = 0; c < b.count; ++c) name_pair(contacts, contacts.touching[begin + std::size_t(c)], c, b);
  load_walls(particles, contacts, b);
}

}  // namespace polybed::dem
