// What is measured of the particles as a whole.
#pragma once

#include <cstdint>

#include "dem/model.hpp"

namespace polybed::dem {

/// Energies, J, and the rest that history.csv tells of contacts.
struct Totals {
  double kinetic = 0, rotational = 0;
  double elastic = 0;         ///< of springs, and of attraction, which is negative
  double potential = 0;       ///< against the origin of the box; 0 without gravity
  double dissipated = 0;      ///< since the start, by dashpots and friction; 0 without dem.ledger
  double work = 0;            ///< of a fluid, or of a sheared box's flow, since the start; 0 without dem.ledger
  std::int64_t contacts = 0;  ///< of particles with each other and with walls
  double max_overlap = 0;     ///< m
  double max_force = 0;       ///< N, elastic
  Vector momentum{};          ///< kg m/s
  double greatest_speed = 0;  ///< m/s

  [[nodiscard]] double sum() const { return kinetic + rotational + elastic + potential + dissipated - work; }
};

/// Collective: the same on every rank, and on any number of ranks to the bit.
[[nodiscard]] Totals totals_of(const Model& model);

}  // namespace polybed::dem
