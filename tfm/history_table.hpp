// Columns of history.csv from the continuum model alone.
#pragma once

#include <vector>

#include "fluid/fluid_mass.hpp"
#include "measures/box_flow.hpp"
#include "measures/invariants.hpp"
#include "measures/table.hpp"

namespace polybed::tfm {

/// Source of its columns, at one time.
struct Told {
  measures::InvariantValues invariants;
  double fluid_mass = 0;                       ///< of a compressible fluid, kg
  fluid::MassAccount account;                  ///< of that fluid
  std::vector<double> in, out;                 ///< through open ends, kg, [species]
  double overflow = 0;                         ///< through sides with a given pressure, m3/s
  std::vector<double> exit_flow;               ///< through each exit, m3/s
  std::vector<std::vector<double>> exit_mass;  ///< that has left there, kg, [exit][species]
  measures::BoxFlow box = {};                  ///< between joined ends
};

/// The columns after the bed's.
/// \param compressible  whether the fluid is compressible
/// \param openings      whether an end is open to solids
/// \param open_sides    whether a discharge has a pressure
/// \param around        whether the ends are joined
/// \param exits         as of fluid::names_of_exits()
[[nodiscard]] measures::Table<Told> history_table(bool compressible, bool openings, bool open_sides, bool around,
                                                  const std::vector<std::string>& exits);
/// All of them, for a list; the first discharge stands for every way out.
[[nodiscard]] measures::Table<Told> whole_history_table();

}  // namespace polybed::tfm
