// The keys for choosing effects, for the run and for its output.
#include "core/case/schema.hpp"

namespace polybed::core::schema {

namespace {

Table chooser_table() {
  return table(
      "chooser", &Scene::chooser,
      {
          key(&Chooser::tolerance, "tolerance", range(1e-6, 1),
              help("limit of the sum of what is left out, over the buoyant weight")),
          key(&Chooser::purpose, "purpose", help("steady leaves out forces from acceleration, whose means vanish")),
          key(&Chooser::static_heap, "static_heap", help("a heap at rest matters: rolling needs a spring")),
          key(&Chooser::voidage, "voidage", above(0.2, 1),
              help("of the bulk, if known; default: from the balance of drag and weight at each velocity")),
          key(&Chooser::velocity_range, "velocity_range", dimension::velocity, range(-1e3, 1e3),
              help("least and greatest superficial velocity of the scene, if wider than the inlet's")),
          key(&Chooser::temperature_range, "temperature_range", dimension::temperature, above(0, 5000),
              help("likewise of the fluid")),
          key(&Chooser::zones, "zones", choices("packed", "bulk", "wall", "freeboard"),
              help("list of zones where effects are weighed; default: all")),
          key(&Chooser::monitor, "monitor",
              help("action when forces that were left out exceed the tolerance in a run; auto: warn if a role is auto, "
                   "else off")),
          key(&Chooser::monitor_every, "monitor_every", range(1, 1e9), help("steps between samples")),
          key(&Chooser::monitor_sample, "monitor_sample", range(1, 1e9),
              help("one of so many particles or cells is sampled, by its number")),
          key(&Chooser::chosen, "chosen", help("a record: roles that were auto before the case was resolved")),
      });
}

Table run_table() {
  return table(
      "run", &Scene::run,
      {
          key(&RunPlan::until, "until", dimension::time, above(0, 1e9), Mark::required, help("simulated time")),
      });
}

Table output_table() {
  return table(
      "output", &Scene::output,
      {
          key(&OutputPlan::every, "every", dimension::time, above(0, 1e9),
              help("between stored fields and profiles, in the DEM at least a step; default: a twentieth of the run")),
          key(&OutputPlan::history_every, "history_every", dimension::time, above(0, 1e9),
              help("between rows of history.csv, in the DEM at least a step; default: a 400th of the run")),
          key(&OutputPlan::checkpoint_every, "checkpoint_every", dimension::time, above(0, 1e9),
              help("between checkpoints; default: a tenth of run.until, which --until does not change")),
      });
}

}  // namespace

std::vector<Table> run_tables() { return {chooser_table(), run_table(), output_table()}; }

}  // namespace polybed::core::schema
