#include "multiscale/run_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <thread>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/numerics/ranks.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/vectors.hpp"
#include "core/version.hpp"
#include "multiscale/scene_rules.hpp"

namespace polybed::multiscale {

namespace {

using core::Json;

void write_work(Json& json, const tfm::Work& work) {
  json.key("work").begin_object();
  json.member("steps", work.steps).member("rejected_steps", work.rejected_steps);
  json.member("rhs_evaluations", work.right_hand_sides).member("pressure_solves", work.pressure_solves);
  json.member("linear_iterations", work.pressure_iterations + work.krylov_iterations);
  json.member("newton_iterations", work.newton_iterations);
  json.member("first_order_cells", work.first_order_cells).end_object();
}

/// Of a run that has failed: the steps before, with what limited each.
void write_last_steps(Json& json, const std::deque<tfm::StepLine>& steps) {
  json.key("last_steps").begin_array();
  for (const tfm::StepLine& step : steps)
    json.begin_object()
        .member("time_s", step.time)
        .member("dt_s", step.step)
        .member("limited_by", step.limited_by)
        .end_object();
  json.end_array();
}

/// How often closures were asked outside their range.
void write_guards(Json& json, const std::vector<tfm::ClosureUse>& closures) {
  json.key("guards").begin_array();
  for (const tfm::ClosureUse& use : closures)
    json.begin_object()
        .member("closure", use.name)
        .member("evaluations", use.evaluations)
        .member("outside_range", use.guarded)
        .end_object();
  json.end_array();
}

/// The smallest G/G_crit of the run with its place; null if nothing ever slipped.
void write_well_posedness(Json& json, const tfm::LeastWellPosed& least, int dimensions) {
  json.key("well_posedness");
  if (!std::isfinite(least.cell.least)) {
    json.null();
    return;
  }
  json.begin_object().member("least", least.cell.least).member("critical_slope_Pa", least.cell.critical_slope);
  json.member("time_s", least.time).key("place_m").begin_array();
  for (int axis = 0; axis < dimensions; ++axis) json.value(least.cell.place[std::size_t(axis)]);
  json.end_array().member("share_below_1", least.share_below_now).end_object();
}

void write_drifts(Json& json, const measures::Drifts& drifts) {
  json.key("drift").begin_object().member("window_s", drifts.window()).key("measures").begin_array();
  for (const measures::DriftOfMeasure& d : drifts.judge())
    json.begin_object()
        .member("name", d.name)
        .member("rate_m_per_s", d.drift.rate)
        .member("error_m_per_s", d.drift.error)
        .member("steady", d.steady)
        .end_object();
  json.end_array().end_object();
}

/// Mass of each species at the start, in, out and in the column, and how well they add up; nothing if no end is open.
void write_ledger(Json& json, const tfm::Constants& constants, const RunTotals& totals,
                  const measures::Invariants& invariants) {
  if (!constants.openings.present()) return;
  const std::vector<fluid::Passed>& passed = totals.passed;
  const std::vector<double>& now = totals.masses;
  json.key("ledger").begin_array();
  for (std::size_t j = 0; j < constants.species(); ++j) {
    const double start = invariants.initial_mass()[j], in = passed[j].in * constants.density[j],
                 out = passed[j].out * constants.density[j];
    json.begin_object()
        .member("species", constants.name[j])
        .member("start_kg", start)
        .member("in_kg", in)
        .member("out_kg", out)
        .member("stored_kg", now[j])
        .member("relative_error", measures::ledger_error(start, in, out, now[j]))
        .end_object();
  }
  json.end_array();
}

}  // namespace

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

std::vector<std::string> drift_lines(const measures::Drifts& drifts) {
  std::vector<std::string> lines;
  for (const measures::DriftOfMeasure& d : drifts.judge())
    if (!d.steady)
      lines.push_back(fmt::format("not steady: drift of {} {:.3g} mm/s, within {:.2g}, over the last {:.3g} s", d.name,
                                  1e3 * d.drift.rate, 1e3 * d.drift.error, drifts.window()));
  return lines;
}

core::JsonValue read_run_record(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "run.json";
  if (!std::filesystem::exists(path))
    throw core::FileError(fmt::format("{}: no run (it has no run.json)", directory.string()));
  return core::read_json(path, "polybed run");
}

RunTotals totals_of(const tfm::Model& model, double cpu_seconds, double wall_seconds) {
  const core::Grid& grid = model.constants().grid;
  RunTotals totals;
  totals.ranks = grid.ranks ? grid.ranks->count() : 1;
  totals.cpu_seconds = core::sum_of_ranks(grid, cpu_seconds);
  totals.wall_seconds = wall_seconds;
  totals.masses = tfm::masses(model);
  if (model.constants().openings.present()) totals.passed = model.passed();
  const tfm::Effects& effects = model.effects();
  if (effects.drag) totals.closures.push_back(effects.drag->use());
  if (effects.solids_stress)
    if (const auto use = effects.solids_stress->use()) totals.closures.push_back(*use);
  if (effects.collisions)
    if (const auto use = effects.collisions->use()) totals.closures.push_back(*use);
  if (effects.species_exchange)
    if (const auto use = effects.species_exchange->use()) totals.closures.push_back(*use);
  for (tfm::ClosureUse& use : totals.closures) {
    use.evaluations = std::uint64_t(core::sum_of_ranks(grid, double(use.evaluations)));
    use.guarded = std::uint64_t(core::sum_of_ranks(grid, double(use.guarded)));
  }
  return totals;
}

void write_size_classes(Json& json, const core::Scene& scene) {
  if (scene.size_classes.empty()) return;
  json.key("size_classes").begin_array();
  for (const core::SizeClasses& record : scene.size_classes) {
    json.begin_object()
        .member("species", record.species)
        .member("distribution", core::name_of(record.given.kind.value()));
    if (record.given.median) json.member("median_m", *record.given.median);
    if (record.given.mean) json.member("mean_m", *record.given.mean);
    if (record.given.deviation) json.member("deviation", *record.given.deviation);
    if (!record.given.sieves.empty()) json.key("sieves").begin_array();
    for (const auto& [opening, share] : record.given.sieves)
      json.begin_object().member("opening_m", opening).member("share", share).end_object();
    if (!record.given.sieves.empty()) json.end_array();
    json.key("classes").begin_array();
    for (std::size_t k = 0; k < record.diameter.size(); ++k)
      json.begin_object()
          .member("name", record.species + "." + std::to_string(k + 1))
          .member("diameter_m", record.diameter[k])
          .member("share", record.share[k])
          .end_object();
    json.end_array().end_object();
  }
  json.end_array();
}

void begin_record(Json& json, const core::Scene& scene, const std::string& model, const std::string& state, int ranks) {
  const std::string text = core::resolved_case(scene);
  json.begin_object().member("filetype", "polybed run").member("version", 1).member("model", model);
  json.member("program", core::version()).member("git_commit", core::git_commit()).member("state", state);
  json.member("case", text).member("case_hash", core::text_hash(text)).key("overrides").begin_array();
  for (const std::string& override : scene.overrides) json.value(override);
  json.end_array().member("ranks", std::int64_t(ranks));
  write_size_classes(json, scene);
  json.key("machine")
      .begin_object()
      .member("processor", processor())
      .member("vectors", core::vector_width_name())
      .member("cores", std::int64_t(std::thread::hardware_concurrency()))
      .end_object();
}

void write_invariants(Json& json, std::span<const measures::WorstInvariant> worst) {
  json.key("invariants").begin_array();
  for (const measures::WorstInvariant& w : worst)
    json.begin_object()
        .member("name", w.name)
        .member("worst", w.value)
        .member("limit", w.limit)
        .member("time_s", w.time)
        .member("held", w.value <= w.limit)
        .member("judged", w.judged)
        .end_object();
  json.end_array();
}

std::vector<std::string> exceeded_lines(std::span<const measures::WorstInvariant> worst) {
  std::vector<std::string> lines;
  for (const measures::WorstInvariant& w : worst)
    if (!(w.value <= w.limit))
      lines.push_back(fmt::format("{} exceeded its limit{}", w.name,
                                  w.broken() ? " more than tenfold: the results do not conserve it" : ""));
  return lines;
}

void write_timers(Json& json, const core::Timers& timers) {
  json.key("timers").begin_object();
  for (const core::Timers::Term& term : timers.terms()) json.member(term.name, term.seconds);
  json.end_object();
}

std::string run_record_text(const RunRecord& record) {
  const tfm::Model& model = record.model;
  const double simulated = model.time() - record.begin;
  Json json;
  begin_record(json, record.scene, "tfm", record.state, record.totals.ranks);
  json.member("integrator", core::name_of(model.integrator_kind()))
      .member("integrator_reason", model.integrator_reason());
  json.member("momentum", core::name_of(model.momentum().form)).member("momentum_reason", model.momentum().reason);
  json.member("unknowns", std::uint64_t(model.unknowns())).member("time_s", model.time());
  json.member("cpu_s", record.totals.cpu_seconds)
      .member("wall_s", record.totals.wall_seconds)
      .member("cpu_s_per_simulated_s", simulated > 0 ? record.totals.cpu_seconds / simulated : 0.0);
  record.write_prediction(json);
  write_work(json, model.work());
  if (record.state.starts_with("failed")) write_last_steps(json, record.observers.last_steps());
  write_timers(json, record.timers);
  write_invariants(json, record.observers.invariants().worst());
  write_ledger(json, model.constants(), record.totals, record.observers.invariants());
  json.member("pressure_drop_over_weight", record.observers.force_balance());
  write_well_posedness(json, record.observers.least_well_posed(), model.constants().grid.dimensions);
  write_drifts(json, record.observers.drifts());
  write_guards(json, record.totals.closures);
  write_left_out(json, record.left_out);
  if (record.promise != nullptr) write_neglected(json, *record.promise);
  json.key("warnings").begin_array();
  for (const std::string& line : exceeded_lines(record.observers.invariants().worst())) json.value(line);
  for (const std::string& line : drift_lines(record.observers.drifts())) json.value(line);
  for (const std::string& line : model.effects().warnings) json.value(line);
  for (const std::string& line : scene_warnings(record.scene)) json.value(line);
  for (const std::string& line : record.warnings) json.value(line);
  json.end_array().end_object();
  return json.text();
}

}  // namespace polybed::multiscale
