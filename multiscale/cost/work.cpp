#include "multiscale/cost/work.hpp"

namespace polybed::multiscale {

namespace {

/// ns each, fitted on 2026-11-21 to the timers of system B's strip by both integrators and by particles, of glass in
/// air and of a bed that settles without a fluid, docs/record/cost.md. A change of one of them is a new work_version.
const std::map<std::string, double>& weights() {
  static const std::map<std::string, double> all{{"rhs_evaluations x unknowns", 23},
                                                 {"pressure_iterations x unknowns", 8},
                                                 {"jacobian_products x unknowns", 90},
                                                 {"particle_steps", 15},
                                                 {"pair_checks", 4},
                                                 {"contact_evaluations", 25},
                                                 {"candidates", 7},
                                                 {"particle_steps in the fluid", 38},
                                                 {"fluid_steps", 2e5},
                                                 {"fluid_steps x particles", 300},
                                                 {"fluid_iterations x cells", 60}};
  return all;
}

void count_continuum(const core::JsonValue& record, Counters& counters) {
  const core::JsonValue& work = record.of("work");
  const double unknowns = record.of("unknowns").number();
  counters["steps"] = work.of("steps").number();
  counters["rejected_steps"] = work.of("rejected_steps").number();
  counters["rhs_evaluations x unknowns"] = unknowns * work.of("rhs_evaluations").number();
  // An explicit step solves for the pressure; an implicit one multiplies by the Jacobian in each Krylov iteration.
  const bool of_pressure = work.of("pressure_solves").number() > 0;
  counters[of_pressure ? "pressure_iterations x unknowns" : "jacobian_products x unknowns"] =
      unknowns * work.of("linear_iterations").number();
}

void count_particles(const core::JsonValue& record, double cells, Counters& counters) {
  const core::JsonValue& work = record.of("work");
  const double particles = record.of("particles").number();
  counters["steps"] = work.of("steps").number();
  counters["particle_steps"] = work.of("particle_steps").number();
  counters["pair_checks"] = work.of("pair_checks").number();
  counters["contact_evaluations"] = work.of("contact_steps").number();
  counters["candidates"] = work.of("candidates").number();
  if (!record.object().contains("fluid")) return;
  const core::JsonValue& fluid = record.of("fluid");
  counters["particle_steps in the fluid"] = counters["particle_steps"];
  counters["fluid_steps"] = fluid.of("steps").number();
  counters["fluid_steps x particles"] = particles * fluid.of("steps").number();
  counters["fluid_iterations x cells"] = cells * fluid.of("iterations").number();
}

}  // namespace

Counters counters_of(const core::JsonValue& record, double cells) {
  Counters counters;
  if (record.of("model").text() == "tfm")
    count_continuum(record, counters);
  else
    count_particles(record, cells, counters);
  return counters;
}

double weighed(const Counters& counters) {
  constexpr double nano = 1e-9;
  double sum = 0;
  for (const auto& [name, count] : counters)
    if (const auto weight = weights().find(name); weight != weights().end()) sum += nano * weight->second * count;
  return sum;
}

}  // namespace polybed::multiscale
