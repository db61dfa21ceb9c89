// Particles given one by one: the CSV file of bed.start = "list:FILE".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/case/scene.hpp"

namespace polybed::core {

struct ParticleList {
  std::vector<std::int32_t> species;                            ///< index into scene.species
  std::vector<std::array<double, 3>> position, velocity, spin;  ///< m, m/s, 1/s, on the axes x, y (upward), z
};

/// Reads the file that scene.bed.start names: a header with species, x, y, z and any of vx, vy, vz, wx, wy, wz in any
/// order, then one line per particle in SI units. Missing columns are zero.
///
/// Throws CaseError with all problems (line, column, suggestion), including centres outside the column, and FileError
/// if the file cannot be read. The scene must be resolved.
[[nodiscard]] ParticleList read_particle_list(const Scene& scene);

}  // namespace polybed::core
