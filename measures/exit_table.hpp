// Columns of history.csv for each of several ways out of a column, in both models.
#pragma once

#include <string>
#include <vector>

#include "measures/table.hpp"

namespace polybed::measures {

/// Of a source with `exit_flow`, m3/s, in the order of the exits.
template <class Source>
void add_exit_flows(const std::vector<std::string>& exits, Table<Source>& table) {
  for (std::size_t n = 0; n < exits.size(); ++n)
    table.push_back({exits[n], "m3_s",
                     "with several ways out (each [[discharge]] in the order of the case, and an open top): volume of "
                     "fluid and solids that leaves there a second",
                     [n](const Source& s) { return s.exit_flow[n]; }});
}

/// Of a source with `exit_mass`, kg, [exit][species].
template <class Source>
void add_exit_masses(const std::vector<std::string>& exits, Table<Source>& table) {
  for (std::size_t n = 0; n < exits.size(); ++n)
    table.push_back({exits[n], "kg", "likewise, mass that has left there since the start",
                     [n](const Source& s, Members j) { return sum_of(s.exit_mass[n], j); }});
}

}  // namespace polybed::measures
