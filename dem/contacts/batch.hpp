// A few dozen contacts side by side. Each law is a loop over a batch: it is selected once and is vectorised in the
// innermost cache. A law that a scene leaves out has no loop and no branch.
#pragma once

#include <cstdint>

namespace polybed::dem {

// Contacts in a batch are independent, which the compiler cannot see from arrays that might overlap.
#define POLYBED_INDEPENDENT _Pragma("GCC ivdep")

struct ContactBatch {
  static constexpr int width = 64;  ///< contacts
  static constexpr int most_memory = 25;
  using Row = double[width];

  int count = 0;  ///< contacts; loops run to padded(), over finite values
  [[nodiscard]] int padded() const { return (count + 7) & ~7; }

  std::int32_t pair[width] = {};   ///< index in the list of pairs
  std::int32_t first[width] = {};  ///< its particles, or a particle and a wall
  std::int32_t second[width] = {};
  std::int32_t kind[width] = {};     ///< pair of materials
  alignas(64) Row distance[3] = {};  ///< x_i - x_j, then n of unit length
  alignas(64) Row velocity[3] = {};  ///< v_i - v_j, then v_t, of the surfaces at the contact
  alignas(64) Row spin_i[3] = {}, spin_j[3] = {};
  alignas(64) Row radius_i = {}, radius_j = {};  ///< radius_j has no meaning at walls
  alignas(64) Row memory[most_memory] = {};      ///< data of a contact that the laws keep between steps

  alignas(64) Row overlap = {}, arm_i = {}, arm_j = {};
  alignas(64) Row speed = {};           ///< v_n, negative on approach
  alignas(64) Row contact_radius = {};  ///< a
  alignas(64) Row normal = {};          ///< F_n
  alignas(64) Row elastic = {};         ///< its elastic part
  alignas(64) Row dashpot = {};         ///< c_n
  alignas(64) Row tangential[3] = {};   ///< F_t
  alignas(64) Row moment[3] = {};       ///< on i, from rolling friction; the opposite on j

  alignas(64) Row force[3] = {}, torque_i[3] = {}, torque_j[3] = {};  ///< in units, not yet rounded
};

}  // namespace polybed::dem
