#include "dem/history_table.hpp"

#include "measures/exit_table.hpp"

namespace polybed::dem {

measures::Table<Told> history_table(const Parts& parts) {
  measures::Table<Told> table{
      {"kinetic", "J", "energy of motion", [](const Told& t) { return t.totals.kinetic; }},
      {"rotational", "J", "energy of spin", [](const Told& t) { return t.totals.rotational; }},
      {"elastic", "J", "energy of contact springs, and of attraction (negative)",
       [](const Told& t) { return t.totals.elastic; }},
      {"potential", "J", "energy in gravity", [](const Told& t) { return t.totals.potential; }}};
  const auto add = [&table](bool there, measures::Measure<Told> measure) {
    if (there) table.push_back(std::move(measure));
  };
  add(parts.ledger,
      {"dissipated", "J", "lost in contacts since the start", [](const Told& t) { return t.totals.dissipated; }});
  add(parts.ledger,
      {"work", "J",
       "done on the particles since the start by the fluid, a sheared box, and gravity through joined faces: "
       "kinetic + rotational + elastic + potential + dissipated - work is constant",
       [](const Told& t) { return t.totals.work; }});
  add(parts.ledger && parts.outflow,
      {"carried_out", "J",
       "energy of the particles that have left; in the sum above it counts as dissipated energy does",
       [](const Told& t) { return t.totals.carried_out; }});
  add(parts.ledger && parts.feeding,
      {"carried_in", "J",
       "with [[feed]]: kinetic and potential energy of the particles that have entered; in the sum above it counts as "
       "work does",
       [](const Told& t) { return t.totals.carried_in; }});
  add(true, {"contacts", "1", "pairs that touch, and particles that touch a wall",
             [](const Told& t) { return double(t.totals.contacts); }});
  add(true, {"max_overlap", "m", "the largest of any contact", [](const Told& t) { return t.totals.max_overlap; }});
  add(true, {"max_contact_force", "N", "the largest of any contact", [](const Told& t) { return t.totals.max_force; }});
  add(parts.fluid, {"max_solids_fraction", "1", "with a fluid: greatest phi of a cell",
                    [](const Told& t) { return t.most_solids; }});
  add(parts.fluid && parts.compressible,
      {"mass_fluid", "kg", "of a compressible fluid: in the column, after its last step",
       [](const Told& t) { return t.fluid_mass; }});
  add(parts.fluid && parts.open_sides,
      {"overflow", "m3_s", "with discharge.pressure: volume of fluid and particles that leaves there a second",
       [](const Told& t) { return t.overflow; }});
  add(parts.outflow,
      {"out", "1",
       "with dem.opening, column.outlet = \"open\" or [[discharge]]: particles that have left since the start",
       [](const Told& t, measures::Members j) { return measures::sum_of(t.number_out, j); }});
  add(parts.outflow,
      {"out", "kg", "their mass", [](const Told& t, measures::Members j) { return measures::sum_of(t.mass_out, j); }});
  add(parts.feeding, {"in", "1", "with [[feed]]: particles that have entered since the start",
                      [](const Told& t, measures::Members j) { return measures::sum_of(t.number_in, j); }});
  add(parts.feeding,
      {"in", "kg", "their mass", [](const Told& t, measures::Members j) { return measures::sum_of(t.mass_in, j); }});
  if (parts.around) measures::add_box_flow(true, table);
  if (parts.fluid) measures::add_exit_flows(parts.exits, table);
  if (parts.outflow) measures::add_exit_masses(parts.exits, table);
  return table;
}

measures::Table<Told> whole_history_table() {
  return history_table({.ledger = true,
                        .outflow = true,
                        .fluid = true,
                        .feeding = true,
                        .compressible = true,
                        .open_sides = true,
                        .around = true,
                        .exits = {"discharge1"}});
}

}  // namespace polybed::dem
