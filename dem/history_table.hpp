// What the particle model alone tells in history.csv.
#pragma once

#include <vector>

#include "dem/measures.hpp"
#include "measures/table.hpp"

namespace polybed::dem {

/// What its columns are read off, at one time.
struct Told {
  Totals totals;
  double most_solids = 0;                    ///< greatest phi of the fluid's cells
  double fluid_mass = 0;                     ///< of a compressible fluid, kg
  std::vector<double> number_out, mass_out;  ///< that have left since the start, kg, [species]
  std::vector<double> number_in, mass_in;    ///< that have entered since the start, kg, [species]
};

/// What a run has.
struct Parts {
  bool ledger = false, outflow = false, fluid = false;
  bool feeding = false;       ///< particles are fed
  bool compressible = false;  ///< the fluid is
};

/// The columns behind those of the bed.
[[nodiscard]] measures::Table<Told> history_table(const Parts& parts);

}  // namespace polybed::dem
