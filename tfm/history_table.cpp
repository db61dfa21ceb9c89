#include "tfm/history_table.hpp"

#include "measures/exit_table.hpp"

namespace polybed::tfm {

measures::Table<Told> history_table(bool compressible, bool openings, bool open_sides, bool around,
                                    const std::vector<std::string>& exits) {
  measures::Table<Told> table{
      {"max_solids_fraction", "1", "greatest phi of a cell", [](const Told& t) { return t.invariants.most_solids; }},
      {"min_fraction", "1", "least phi_j of a cell if negative, else 0",
       [](const Told& t) { return 0 - t.invariants.fraction_below; }},  // not -0
      {"divergence", "1", "max of abs(div J) h / U; not 0 in a compressible fluid",
       [](const Told& t) { return t.invariants.divergence; }}};
  if (compressible) {
    table.push_back(
        {"mass_fluid", "kg", "of a compressible fluid: in the column", [](const Told& t) { return t.fluid_mass; }});
    table.push_back({"fluid_in", "kg",
                     "of a compressible fluid: in through sides and distributor since the start, less [[discharge]]",
                     [](const Told& t) { return t.account.in; }});
    table.push_back({"fluid_out", "kg", "of a compressible fluid: out through top and sides since the start",
                     [](const Told& t) { return t.account.out; }});
  }
  if (open_sides)
    table.push_back({"overflow", "m3_s",
                     "with discharge.pressure: volume of fluid and solids that leaves there a second",
                     [](const Told& t) { return t.overflow; }});
  if (openings) {
    table.push_back({"in", "kg", "fed since the start; if solids can leave or are fed",
                     [](const Told& t, measures::Members j) { return measures::sum_of(t.in, j); }});
    table.push_back({"out", "kg", "left since the start; if solids can leave or are fed",
                     [](const Told& t, measures::Members j) { return measures::sum_of(t.out, j); }});
  }
  if (around) measures::add_box_flow(false, table);
  measures::add_exit_flows(exits, table);
  if (openings) measures::add_exit_masses(exits, table);
  return table;
}

measures::Table<Told> whole_history_table() { return history_table(true, true, true, true, {"discharge1"}); }

}  // namespace polybed::tfm
