// Columns of history.csv from the particle model alone.
#pragma once

#include <vector>

#include "dem/measures.hpp"
#include "measures/box_flow.hpp"

namespace polybed::dem {

/// Source of its columns, at one time.
struct Told {
  Totals totals;
  double most_solids = 0;                      ///< greatest phi in the fluid's cells
  double fluid_mass = 0;                       ///< of a compressible fluid, kg
  std::vector<double> number_out, mass_out;    ///< of particles that have left since the start, kg, [species]
  std::vector<double> number_in, mass_in;      ///< of particles that have entered since the start, kg, [species]
  double overflow = 0;                         ///< through sides with a given pressure, m3/s
  std::vector<double> exit_flow;               ///< of fluid and particles through each exit, m3/s
  std::vector<std::vector<double>> exit_mass;  ///< of particles that have left there, kg, [exit][species]
  measures::BoxFlow box = {};                  ///< between joined ends in a fluid
};

/// Optional parts of a run.
struct Parts {
  bool ledger = false, outflow = false, fluid = false;
  bool feeding = false;                 ///< particles are fed
  bool compressible = false;            ///< the fluid is compressible
  bool open_sides = false;              ///< a discharge has a pressure
  bool around = false;                  ///< the fluid flows through joined ends
  std::vector<std::string> exits = {};  ///< as of fluid::names_of_exits()
};

/// The columns after the bed's.
[[nodiscard]] measures::Table<Told> history_table(const Parts& parts);
/// All of them, for a list; the first discharge stands for every way out.
[[nodiscard]] measures::Table<Told> whole_history_table();

}  // namespace polybed::dem
