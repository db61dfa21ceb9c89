// What is measured of the particles as a whole.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/numerics/reduction.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

/// Energies, J, and the rest that history.csv tells of contacts.
struct Totals {
  double kinetic = 0, rotational = 0;
  double elastic = 0;         ///< of springs, and of attraction, which is negative
  double potential = 0;       ///< against the origin of the box; 0 without gravity
  double dissipated = 0;      ///< since the start, by dashpots and friction; 0 without dem.ledger
  double carried_out = 0;     ///< by particles that have left, since the start; 0 where nothing can
  double carried_in = 0;      ///< by particles that have entered, since the start; 0 where none are fed
  double work = 0;            ///< of a fluid, or of a sheared box's flow, since the start; 0 without dem.ledger
  std::int64_t contacts = 0;  ///< of particles with each other and with walls
  double max_overlap = 0;     ///< m
  double max_force = 0;       ///< N, elastic
  Vector momentum{};          ///< kg m/s
  double greatest_speed = 0;  ///< m/s
  double pull = 0;            ///< what an attraction does from the touch to where the springs hold it, the most, J
  double rounding = 0;        ///< of rounding_of_places(), and of what sums cut off, J

  [[nodiscard]] double sum() const {
    return kinetic + rotational + elastic + potential + dissipated + carried_out - carried_in - work;
  }
};

/// Bound of what rounding of places can do to the potential energy in a number of steps, J: half a unit in the last
/// place in each of them, and once more where energies are summed. It matters where nothing has moved yet: a particle
/// that a step would move by less stays where it is, while its weight already speeds it up.
/// \param highest  potential energy of all particles at the far end of the box, J
[[nodiscard]] inline double rounding_of_places(double highest, std::int64_t steps) {
  constexpr double half_a_unit = 0x1p-53;
  return highest * half_a_unit * double(steps + 4);
}

/// Share of the greatest energy met that the account of energy misses beyond rounding: V5.
[[nodiscard]] inline double ledger_miss(const Totals& now, double initial_energy, double greatest_energy) {
  const double miss = std::abs(now.sum() - initial_energy) - now.rounding;
  return miss > 0 ? miss / greatest_energy : 0;
}

/// Of this rank's particles and contacts, then of all ranks' once reductions have put them together: the same on every
/// rank, and on any number of ranks to the bit.
class TotalsOfRanks {
 public:
  explicit TotalsOfRanks(const Model& model);
  void put_greatest_into(core::Reduction& all);
  void put_sums_into(core::Reduction& all) { all.sum(sums_); }
  [[nodiscard]] Totals totals() const;

 private:
  static constexpr std::size_t energies = 10;  ///< and momenta, each in whole units and parts of one
  const Model& model_;
  Totals greatest_;                                    ///< overlap, force and speed
  std::array<std::int64_t, 2 * energies + 1> sums_{};  ///< those of EnergySum, then contacts
};

/// Those of all ranks. Collective.
[[nodiscard]] Totals totals_of(const Model& model);

/// In the unit of energy: what this rank's particles that are about to leave hold, of motion, spin and gravity, and the
/// springs of all contacts that they are in, those with particles that stay too. A contact counts where totals_of()
/// counts it. Between steps, of a model that has an outflow.
[[nodiscard]] EnergySum energy_leaving(const Model& model);

}  // namespace polybed::dem
