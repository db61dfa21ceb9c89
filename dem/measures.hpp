// Measures of all particles together.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/numerics/reduction.hpp"
#include "dem/model.hpp"

namespace polybed::dem {

/// Energies, J, and the columns for contacts in history.csv.
struct Totals {
  double kinetic = 0, rotational = 0;
  double elastic = 0;         ///< of springs, plus the negative energy of attraction
  double potential = 0;       ///< relative to the origin of the box; 0 without gravity
  double dissipated = 0;      ///< since the start, by dashpots and friction; 0 without dem.ledger
  double carried_out = 0;     ///< by particles that have left, since the start; 0 without openings
  double carried_in = 0;      ///< by particles that have entered, since the start; 0 without feeds
  double work = 0;            ///< by a fluid, or a sheared box's flow, since the start; 0 without dem.ledger
  std::int64_t contacts = 0;  ///< between particles and with walls
  double max_overlap = 0;     ///< m
  double max_force = 0;       ///< N, elastic
  Vector momentum{};          ///< kg m/s
  double greatest_speed = 0;  ///< m/s
  double pull = 0;            ///< greatest work of an attraction from first contact to balance with the springs, J
  double rounding = 0;        ///< from rounding_of_places(), and from truncation in sums, J

  [[nodiscard]] double sum() const {
    return kinetic + rotational + elastic + potential + dissipated + carried_out - carried_in - work;
  }
};

/// Bound on the effect of rounded places on the potential energy over a number of steps, J: half a unit in the last
/// place in each step, and once more in the sum of energies. It matters before anything has moved: a particle whose
/// displacement in a step is below round-off stays at its place while its weight already accelerates it.
/// \param highest  potential energy of all particles at the far end of the box, J
[[nodiscard]] inline double rounding_of_places(double highest, std::int64_t steps) {
  constexpr double half_a_unit = 0x1p-53;
  return highest * half_a_unit * double(steps + 4);
}

/// Error of the energy balance beyond rounding, as a share of the greatest energy so far: V5.
[[nodiscard]] inline double ledger_miss(const Totals& now, double initial_energy, double greatest_energy) {
  const double miss = std::abs(now.sum() - initial_energy) - now.rounding;
  return miss > 0 ? miss / greatest_energy : 0;
}

/// For this rank's particles and contacts, then for all ranks' once reductions have combined them: the same on every
/// rank, and on any number of ranks to the bit.
class TotalsOfRanks {
 public:
  explicit TotalsOfRanks(const Model& model);
  void put_greatest_into(core::Reduction& all);
  void put_sums_into(core::Reduction& all) { all.sum(sums_); }
  [[nodiscard]] Totals totals() const;

 private:
  static constexpr std::size_t energies = 10;  ///< including momenta, each in whole units and fractions
  const Model& model_;
  Totals greatest_;                                    ///< overlap, force and speed
  std::array<std::int64_t, 2 * energies + 1> sums_{};  ///< in the order of EnergySum, then contacts
};

/// Totals over all ranks. Collective.
[[nodiscard]] Totals totals_of(const Model& model);

/// In the unit of energy: motion, spin and gravity of this rank's particles that are about to leave, and the springs of
/// all their contacts, including those with particles that stay. A contact counts where totals_of() counts it. Call it
/// between steps, for a model with an outflow.
[[nodiscard]] EnergySum energy_leaving(const Model& model);

}  // namespace polybed::dem
