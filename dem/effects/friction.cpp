#include "dem/effects/friction.hpp"

#include <cmath>

namespace polybed::dem {

namespace {

/// Smallest number a length is divided by: a vector of no length stays one.
constexpr double tiny = 1e-300;

/// A tangential vector of the last step, turned into the present tangential plane with its length kept.
inline void turn_into_plane(double& x, double& y, double& z, double nx, double ny, double nz) {
  const double before = x * x + y * y + z * z, along = x * nx + y * ny + z * nz;
  x -= along * nx;
  y -= along * ny;
  z -= along * nz;
  const double after = x * x + y * y + z * z;
  const double scale = std::sqrt(before / (after > tiny ? after : tiny));
  x *= scale;
  y *= scale;
  z *= scale;
}

/// Factor that brings a force under Coulomb's limit mu F_n; 1 if it is.
inline double coulomb(double tx, double ty, double tz, double limit) {
  const double square = tx * tx + ty * ty + tz * tz;
  const double factor = limit / std::sqrt(square > tiny ? square : tiny);
  return factor < 1 ? factor : 1;
}

POLYBED_ALL_VECTOR_WIDTHS void spring(ContactBatch& b, const ContactBatch::Row& friction,
                                      const ContactBatch::Row& per_radius, const ContactBatch::Row& constant,
                                      const ContactBatch::Row& dashpot, double dt) {
  const int n = b.padded();
  for (int c = 0; c < n; ++c) {
    double x = b.memory[0][c], y = b.memory[1][c], z = b.memory[2][c];
    turn_into_plane(x, y, z, b.distance[0][c], b.distance[1][c], b.distance[2][c]);
    const double vx = b.velocity[0][c], vy = b.velocity[1][c], vz = b.velocity[2][c];
    x += vx * dt;
    y += vy * dt;
    z += vz * dt;
    const double stiffness = per_radius[c] * b.contact_radius[c] + constant[c];
    const double damping = dashpot[c] * b.dashpot[c];
    double tx = -stiffness * x - damping * vx, ty = -stiffness * y - damping * vy, tz = -stiffness * z - damping * vz;
    const double normal = b.normal[c] > 0 ? b.normal[c] : 0;
    const double cut = coulomb(tx, ty, tz, friction[c] * normal);
    tx *= cut;
    ty *= cut;
    tz *= cut;
    const double inverse = -1 / (stiffness > tiny ? stiffness : tiny);
    b.memory[0][c] = cut < 1 ? tx * inverse : x;
    b.memory[1][c] = cut < 1 ? ty * inverse : y;
    b.memory[2][c] = cut < 1 ? tz * inverse : z;
    b.tangential[0][c] = tx;
    b.tangential[1][c] = ty;
    b.tangential[2][c] = tz;
  }
}

POLYBED_ALL_VECTOR_WIDTHS void increment(ContactBatch& b, const ContactBatch::Row& friction,
                                         const ContactBatch::Row& per_radius, const ContactBatch::Row& dashpot,
                                         double dt) {
  const int n = b.padded();
  for (int c = 0; c < n; ++c) {
    double x = b.memory[0][c], y = b.memory[1][c], z = b.memory[2][c];
    turn_into_plane(x, y, z, b.distance[0][c], b.distance[1][c], b.distance[2][c]);
    const double a = b.contact_radius[c], before = b.memory[3][c];
    const double kept = a < before ? a / before : 1;
    const double vx = b.velocity[0][c], vy = b.velocity[1][c], vz = b.velocity[2][c];
    const double step = per_radius[c] * a * dt, damping = dashpot[c] * b.dashpot[c];
    x = kept * x - step * vx;
    y = kept * y - step * vy;
    z = kept * z - step * vz;
    double tx = x - damping * vx, ty = y - damping * vy, tz = z - damping * vz;
    const double normal = b.normal[c] > 0 ? b.normal[c] : 0;
    const double cut = coulomb(tx, ty, tz, friction[c] * normal);
    tx *= cut;
    ty *= cut;
    tz *= cut;
    b.memory[0][c] = cut < 1 ? tx : x;
    b.memory[1][c] = cut < 1 ? ty : y;
    b.memory[2][c] = cut < 1 ? tz : z;
    b.memory[3][c] = a;
    b.tangential[0][c] = tx;
    b.tangential[1][c] = ty;
    b.tangential[2][c] = tz;
  }
}

double square_of_memory(const ContactBatch& b, int c) {
  return b.memory[0][c] * b.memory[0][c] + b.memory[1][c] * b.memory[1][c] + b.memory[2][c] * b.memory[2][c];
}

/// c_t/c_n = sqrt(4 G*/E*): S_t/S_n = 8 G* a/(2 E* a).
double dashpot_share(const PairMaterial& m) { return std::sqrt(4 * m.shear_modulus / m.youngs_modulus); }

}  // namespace

SpringFriction::SpringFriction(const Materials& materials) {
  for (const PairMaterial& m : materials.kinds())
    constants_.push_back({m.friction, 2.0 / 3 * 8 * m.shear_modulus, 0, dashpot_share(m)});
}

SpringFriction::SpringFriction(const Materials& materials, double normal_stiffness, double ratio) {
  for (const PairMaterial& m : materials.kinds())
    constants_.push_back({m.friction, 0, ratio * normal_stiffness, std::sqrt(ratio)});
}

void SpringFriction::act(ContactBatch& batch, double dt) const {
  alignas(64) ContactBatch::Row friction = {}, per_radius = {}, constant = {}, dashpot = {};
  for (int c = 0; c < batch.count; ++c) {
    const Constants& k = constants_[std::size_t(batch.kind[c])];
    friction[c] = k.friction;
    per_radius[c] = k.per_radius;
    constant[c] = k.constant;
    dashpot[c] = k.dashpot;
  }
  spring(batch, friction, per_radius, constant, dashpot, dt);
}

void SpringFriction::energy(const ContactBatch& batch, ContactBatch::Row& stored) const {
  for (int c = 0; c < batch.count; ++c) {
    const Constants& k = constants_[std::size_t(batch.kind[c])];
    stored[c] = 0.5 * (k.per_radius * batch.contact_radius[c] + k.constant) * square_of_memory(batch, c);
  }
}

MindlinFriction::MindlinFriction(const Materials& materials) {
  for (const PairMaterial& m : materials.kinds())
    constants_.push_back({m.friction, 8 * m.shear_modulus, dashpot_share(m)});
}

void MindlinFriction::act(ContactBatch& batch, double dt) const {
  alignas(64) ContactBatch::Row friction = {}, per_radius = {}, dashpot = {};
  for (int c = 0; c < batch.count; ++c) {
    const Constants& k = constants_[std::size_t(batch.kind[c])];
    friction[c] = k.friction;
    per_radius[c] = k.per_radius;
    dashpot[c] = k.dashpot;
  }
  increment(batch, friction, per_radius, dashpot, dt);
}

void MindlinFriction::energy(const ContactBatch& batch, ContactBatch::Row& stored) const {
  for (int c = 0; c < batch.count; ++c) {
    const double stiffness = constants_[std::size_t(batch.kind[c])].per_radius * batch.contact_radius[c];
    stored[c] = 0.5 * square_of_memory(batch, c) / (stiffness > tiny ? stiffness : tiny);
  }
}

}  // namespace polybed::dem
