#include "multiscale/run_record.hpp"

#include <fstream>
#include <thread>

#include "core/case_file.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "core/ranks.hpp"
#include "core/version.hpp"

namespace polybed::multiscale {

namespace {

using core::Json;

/// The processor's name as the system gives it; "unknown" elsewhere.
std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(std::min(line.find(':') + 2, line.size()));
  return "unknown";
}

void write_work(Json& json, const tfm::Work& work) {
  json.key("work").begin_object();
  json.member("steps", work.steps).member("rejected_steps", work.rejected_steps);
  json.member("rhs_evaluations", work.right_hand_sides).member("pressure_solves", work.pressure_solves);
  json.member("linear_iterations", work.pressure_iterations + work.krylov_iterations);
  json.member("newton_iterations", work.newton_iterations);
  json.member("first_order_cells", work.first_order_cells).end_object();
}

void write_invariants(Json& json, const fluid::Invariants& invariants) {
  json.key("invariants").begin_array();
  for (const fluid::WorstInvariant& w : invariants.worst())
    json.begin_object()
        .member("name", w.name)
        .member("worst", w.value)
        .member("limit", w.limit)
        .member("time_s", w.time)
        .member("held", w.value <= w.limit)
        .end_object();
  json.end_array();
}

}  // namespace

RunTotals totals_of(const tfm::Model& model, double cpu_seconds) {
  const core::Grid& grid = model.constants().grid;
  RunTotals totals;
  totals.ranks = grid.ranks ? grid.ranks->count() : 1;
  totals.cpu_seconds = core::sum_of_ranks(grid, cpu_seconds);
  if (!model.effects().drag) return totals;
  tfm::ClosureUse use = model.effects().drag->use();
  use.evaluations = std::uint64_t(core::sum_of_ranks(grid, double(use.evaluations)));
  use.guarded = std::uint64_t(core::sum_of_ranks(grid, double(use.guarded)));
  totals.closures.push_back(use);
  return totals;
}

std::string run_record_text(const RunRecord& record) {
  const tfm::Model& model = record.model;
  const std::string text = core::resolved_case(record.scene);
  const double simulated = model.time() - record.begin;
  Json json;
  json.begin_object().member("filetype", "polybed run").member("version", 1).member("model", "tfm");
  json.member("program", core::version()).member("git_commit", core::git_commit()).member("state", record.state);
  json.member("case", text).member("case_hash", core::text_hash(text)).key("overrides").begin_array();
  for (const std::string& override : record.scene.overrides) json.value(override);
  json.end_array().member("ranks", std::int64_t(record.totals.ranks));
  json.key("machine")
      .begin_object()
      .member("processor", processor())
      .member("cores", std::int64_t(std::thread::hardware_concurrency()))
      .end_object();
  json.member("integrator", model.integrator_name()).member("integrator_reason", model.integrator_reason());
  json.member("unknowns", std::uint64_t(model.unknowns())).member("time_s", model.time());
  json.member("cpu_s", record.totals.cpu_seconds)
      .member("cpu_s_per_simulated_s", simulated > 0 ? record.totals.cpu_seconds / simulated : 0.0);
  write_work(json, model.work());
  json.key("timers").begin_object();
  for (const core::Timers::Term& term : record.timers.terms()) json.member(term.name, term.seconds);
  json.end_object();
  write_invariants(json, record.observers.invariants());
  json.member("pressure_drop_over_weight", record.observers.force_balance());
  json.key("guards").begin_array();
  for (const tfm::ClosureUse& use : record.totals.closures)
    json.begin_object()
        .member("closure", use.name)
        .member("evaluations", use.evaluations)
        .member("outside_range", use.guarded)
        .end_object();
  json.end_array().key("warnings").begin_array();
  for (const fluid::WorstInvariant& w : record.observers.invariants().worst())
    if (w.value > w.limit) json.value(w.name + " exceeded its limit");
  json.end_array().end_object();
  return json.text();
}

void write_run_record(const std::filesystem::path& directory, const RunRecord& record) {
  core::write_atomically(directory / "run.json", run_record_text(record) + "\n");
}

}  // namespace polybed::multiscale
