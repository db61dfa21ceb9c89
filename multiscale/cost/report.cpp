#include "multiscale/cost/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "core/case/file.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/version.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/timing.hpp"
#include "multiscale/picture.hpp"
#include "multiscale/run_record.hpp"

namespace polybed::multiscale {

namespace {

using core::Json;

void optional_member(Json& json, const char* name, const std::optional<double>& value) {
  json.key(name);
  if (value && std::isfinite(*value))
    json.value(*value);
  else
    json.null();
}

std::string level_of(const Row& row, const Axis& axis) {
  const auto found = row.settings.find(axis.name);
  return axis.levels[found == row.settings.end() ? axis.given : found->second].label;
}

void write_settings(Json& json, const Sweep& sweep, const Row& row) {
  json.key("settings").begin_object();
  if (!row.settings.empty())
    for (const Axis& axis : sweep.axes) json.member(axis.name, level_of(row, axis));
  json.end_object().member("note", row.note).member("model", row.order.model).member("ranks", row.order.ranks);
  json.key("overrides").begin_array();
  for (const std::string& override : row.order.overrides) json.value(override);
  json.end_array();
}

const char* kind_name(RowKind kind) {
  switch (kind) {
    case RowKind::candidate:
      return "candidate";
    case RowKind::model:
      return "model";
    case RowKind::machine:
      return "machine";
    case RowKind::reference:
      return "reference";
    case RowKind::twin:
      return "twin";
    case RowKind::solver:
      return "solver";
    case RowKind::input:
      return "input";
  }
  return "";
}

void write_row(Json& json, const Sweep& sweep, const Row& row) {
  json.begin_object().member("kind", kind_name(row.kind));
  write_settings(json, sweep, row);
  json.key("work").begin_object();
  for (const auto& [name, count] : row.outcome.counters) json.member(name, count);
  json.end_object().member("work_s", weighed(row.outcome.counters)).member("simulated_s", row.outcome.simulated);
  json.member("s_per_sim_s", row.rate).key("cpu_s").begin_array();
  for (const double t : row.cpu) json.value(t);
  json.end_array().key("wall_s").begin_array().value(row.outcome.wall).end_array().key("qoi").begin_object();
  for (const auto& [id, q] : row.quantities) {
    json.key(id).begin_object().member("value", q.value);
    optional_member(json, "ci", q.interval);
    json.member("error", q.error);
    optional_member(json, "error_ci", q.error_interval);
    json.end_object();
  }
  json.end_object();
  if (row.predicted)
    json.key("predicted")
        .begin_object()
        .member("error", row.predicted->error)
        .member("cost", row.predicted->cost)
        .end_object();
  json.member("status", row.status).member("reason", row.outcome.reason).end_object();
}

void write_law(Json& json, const char* name, const std::optional<PowerLaw>& law) {
  json.key(name);
  if (!law || !std::isfinite(law->factor)) {
    json.null();
    return;
  }
  json.begin_object().member("factor", law->factor).member("exponent", law->exponent);
  json.member("scatter", law->scatter).end_object();
}

void write_fit(Json& json, const Sweep& sweep) {
  json.key("fit").begin_object();
  write_law(json, "error_of_rtol", sweep.error_of_rtol);
  write_law(json, "cost_of_rtol", sweep.cost_of_rtol);
  write_law(json, "error_of_grid", sweep.error_of_grid);
  write_law(json, "cost_of_grid", sweep.cost_of_grid);
  optional_member(json, "additive_off", sweep.additive_off);
  json.end_object().key("pareto").begin_array();
  for (std::size_t n = 0; n < sweep.rows.size(); ++n)
    if (sweep.rows[n].status == "pareto") json.value(std::uint64_t(n));
  json.end_array();
}

void write_recommendation(Json& json, const Sweep& sweep) {
  json.key("recommend").begin_array();
  if (sweep.recommendation) {
    const Row& row = sweep.rows[sweep.recommendation->row];
    const RowQuantity& q = row.quantities.at(sweep.ranking());
    json.begin_object().member("target", sweep.recommendation->target).member("qoi", sweep.ranking());
    json.member("run", std::uint64_t(sweep.recommendation->row));
    write_settings(json, sweep, row);
    json.member("error", q.error);
    optional_member(json, "ci", q.error_interval);
    json.member("s_per_sim_s", row.rate).member("confirmed", sweep.recommendation->confirmed).end_object();
  }
  json.end_array();
}

void write_shares(Json& json, const char* name, const std::vector<Share>& shares) {
  double most = 0;
  for (const Share& s : shares) most = std::max(most, s.value.value_or(0));
  json.key(name).begin_array();
  for (const Share& s : shares) {
    json.begin_object().member("row", s.row);
    optional_member(json, "value", s.value);
    optional_member(json, "share", s.value && most > 0 ? std::optional(*s.value / most) : std::nullopt);
    json.member("note", s.note).end_object();
  }
  json.end_array();
}

void write_reference(Json& json, const Sweep& sweep) {
  json.key("reference").begin_object().member("kind", sweep.reference.kind).member("note", sweep.reference.note);
  for (const auto& [name, map] : {std::pair("floor", &sweep.reference.floor),
                                  {"value", &sweep.reference.value},
                                  {"band", &sweep.reference.band}}) {
    json.key(name).begin_object();
    for (const auto& [id, value] : *map)
      if (std::isfinite(value)) json.member(id, value);
    json.end_object();
  }
  json.end_object();
}

void write_quantities(Json& json, const Sweep& sweep) {
  json.key("qoi").begin_array();
  for (const QuantityInfo& q : sweep.quantities)
    json.begin_object()
        .member("id", q.id)
        .member("unit", q.unit)
        .member("definition", q.definition)
        .member("scale", scale_of(sweep, q.id))
        .member("shown", std::find(sweep.options.quantities.begin(), sweep.options.quantities.end(), q.id) !=
                             sweep.options.quantities.end())
        .end_object();
  json.end_array();
}

}  // namespace

std::string sweep_json(const Sweep& sweep, const SweepOf& of) {
  Json json;
  json.begin_object().member("filetype", "polybed cost").member("version", 1);
  json.member("git_commit", core::git_commit()).member("case", of.case_text).member("case_path", of.case_path);
  json.member("case_hash", core::text_hash(of.case_text)).key("overrides").begin_array();
  for (const std::string& override : of.overrides) json.value(override);
  json.end_array().member("model", sweep.options.model).member("clock", sweep.options.clock);
  json.member("work_version", work_version).member("target", sweep.options.target);
  json.member("budget_s", sweep.options.budget).key("machine").begin_object().member("cpu", processor());
  json.member("cores", std::int64_t(std::thread::hardware_concurrency())).member("build", core::build_kind());
  json.end_object().member("outcome", sweep.outcome).member("reason", sweep.reason).member("regime", sweep.regime);
  json.key("window_s").value(sweep.on.window.begin);
  write_reference(json, sweep);
  write_quantities(json, sweep);
  json.key("runs").begin_array();
  for (const Row& row : sweep.rows) write_row(json, sweep, row);
  json.end_array();
  write_fit(json, sweep);
  write_recommendation(json, sweep);
  write_shares(json, "attribution", sweep.attribution);
  write_shares(json, "inputs", sweep.inputs);
  json.key("warnings").begin_array();
  for (const std::string& warning : sweep.warnings) json.value(warning);
  return json.end_array().end_object().text();
}

std::string sweep_csv(const Sweep& sweep) {
  std::vector<std::string> counters;
  for (const Row& row : sweep.rows)
    for (const auto& [name, count] : row.outcome.counters)
      if (std::find(counters.begin(), counters.end(), name) == counters.end()) counters.push_back(name);
  std::string text = "kind,note,status,s_per_sim_s,work_s,cpu_median_s,cpu_deviation_s,wall_s";
  for (const Axis& axis : sweep.axes) text += "," + axis.name;
  for (const std::string& name : counters) text += "," + name;
  for (const QuantityInfo& q : sweep.quantities) text += fmt::format(",{0},{0}_ci,{0}_error,{0}_error_ci", q.id);
  text += "\n";
  const auto number = [](const std::optional<double>& v) { return v ? fmt::format("{:.9g}", *v) : std::string(); };
  for (const Row& row : sweep.rows) {
    const Timing timing = row.cpu.empty() ? Timing{} : timing_of(row.cpu);
    text += fmt::format("{},{},{},{:.9g},{:.9g},{:.6g},{:.6g},{:.6g}", kind_name(row.kind), row.note, row.status,
                        row.rate, weighed(row.outcome.counters), timing.median, timing.deviation, row.outcome.wall);
    for (const Axis& axis : sweep.axes) text += "," + (row.settings.empty() ? "" : level_of(row, axis));
    for (const std::string& name : counters) {
      const auto found = row.outcome.counters.find(name);
      text += "," + (found == row.outcome.counters.end() ? "" : fmt::format("{:.17g}", found->second));
    }
    for (const QuantityInfo& info : sweep.quantities) {
      const auto q = row.quantities.find(info.id);
      if (q == row.quantities.end())
        text += ",,,,";
      else
        text += fmt::format(",{:.9g},{},{:.6g},{}", q->second.value, number(q->second.interval), q->second.error,
                            number(q->second.error_interval));
    }
    text += "\n";
  }
  return text;
}

std::string write_sweep(const Sweep& sweep, const SweepOf& of, const std::filesystem::path& directory, bool picture) {
  core::write_atomically(directory / "cost.json", sweep_json(sweep, of) + "\n");
  core::write_atomically(directory / "cost.csv", sweep_csv(sweep));
  core::write_atomically(directory / "cost.md", sweep_markdown(sweep, of));
  std::string message;
  return !picture || draw("polybed.cost", directory, message) ? "" : message;
}

}  // namespace polybed::multiscale
