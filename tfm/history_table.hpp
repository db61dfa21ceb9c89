// Columns of history.csv from the continuum model alone.
#pragma once

#include <vector>

#include "fluid/fluid_mass.hpp"
#include "measures/invariants.hpp"
#include "measures/table.hpp"

namespace polybed::tfm {

/// Source of its columns, at one time.
struct Told {
  measures::InvariantValues invariants;
  double fluid_mass = 0;        ///< of a compressible fluid, kg
  fluid::MassAccount account;   ///< of that fluid
  std::vector<double> in, out;  ///< through open ends, kg, [species]
};

/// The columns after the bed's.
/// \param compressible  whether the fluid is compressible
/// \param openings      whether an end is open to solids
[[nodiscard]] measures::Table<Told> history_table(bool compressible, bool openings);

}  // namespace polybed::tfm
