// Vectors of particles for the closures of side forces.
#pragma once

#include "closures/vec3.hpp"
#include "dem/effects/side_forces.hpp"

namespace polybed::dem {

[[nodiscard]] inline closures::Vec3 to_vec3(const Vector& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline closures::Vec3 to_vec3(const double* v) { return {v[0], v[1], v[2]}; }

inline void put(double* row, const closures::Vec3& v) {
  row[0] = v.x;
  row[1] = v.y;
  row[2] = v.z;
}
inline void add_to(double* row, const closures::Vec3& v) { put(row, to_vec3(row) + v); }

/// U_f - U_p at a particle, m/s.
[[nodiscard]] inline closures::Vec3 slip_of(const SideView& view, std::size_t i) {
  return to_vec3(view.loads[i].velocity) - to_vec3(view.particles.motion[i].v);
}

}  // namespace polybed::dem
