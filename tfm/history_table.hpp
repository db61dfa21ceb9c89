// What the continuum model alone tells in history.csv.
#pragma once

#include <vector>

#include "fluid/fluid_mass.hpp"
#include "measures/invariants.hpp"
#include "measures/table.hpp"

namespace polybed::tfm {

/// What its columns are read off, at one time.
struct Told {
  measures::InvariantValues invariants;
  double fluid_mass = 0;        ///< of a compressible fluid, kg
  fluid::MassAccount account;   ///< of that fluid
  std::vector<double> in, out;  ///< through open ends, kg, [species]
};

/// The columns behind those of the bed.
/// \param compressible  the fluid is
/// \param openings      an end is open to solids
[[nodiscard]] measures::Table<Told> history_table(bool compressible, bool openings);

}  // namespace polybed::tfm
