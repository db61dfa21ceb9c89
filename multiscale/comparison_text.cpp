#include "multiscale/comparison_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/output/json.hpp"
#include "core/version.hpp"

namespace polybed::multiscale {

namespace {

using core::Json;
using Number = std::optional<double>;

Number mean_of(const std::optional<measures::TimeMean>& mean) { return mean ? Number(mean->mean) : std::nullopt; }
Number error_of(const std::optional<measures::TimeMean>& mean) { return mean ? mean->error : std::nullopt; }

void write_measures(Json& json, const Comparison& comparison) {
  json.key("measures").begin_object();
  for (const ComparedMeasure& m : comparison.measures) {
    json.key(m.name).begin_object();
    json.member("tfm", mean_of(m.tfm));
    json.member("tfm_error", error_of(m.tfm));
    json.member("dem", mean_of(m.dem));
    json.member("dem_error", error_of(m.dem));
    json.member("difference", m.difference());
    json.member("difference_error", m.difference_error());
    json.end_object();
  }
  json.end_object();
}

/// Means over time in the slabs; an error is null where there are too few profiles to tell it.
void write_profiles(Json& json, const Comparison& comparison) {
  const auto list = [&](const std::string& name, const auto& values, const auto& number) {
    json.key(name).begin_array();
    for (const auto& v : values) json.value(number(v));
    json.end_array();
  };
  json.key("mean_profiles").begin_object();
  list("y_m", comparison.height, [](double y) { return y; });
  for (const auto& [model, means] :
       {std::pair("tfm", &comparison.tfm_means), std::pair("dem", &comparison.dem_means)}) {
    json.key(model).begin_object();
    for (std::size_t j = 0; j < comparison.species.size(); ++j) {
      json.key("phi_" + comparison.species[j]).begin_object();
      list("mean", (*means)[j], mean_of);
      list("error", (*means)[j], error_of);
      json.end_object();
    }
    json.end_object();
  }
  json.end_object();
}

void write_top(Json& json, const std::string& model, const std::optional<OnTop>& top) {
  json.key(model);
  if (top)
    json.begin_object().member("species", top->species).member("certain", top->certain).end_object();
  else
    json.null();
}

void write_scores(Json& json, const Comparison& comparison) {
  json.key("scores").begin_object();
  for (const Score& score : comparison.scores) {
    json.key(score.name).begin_object();
    json.member("value", score.value);
    json.member("error", score.error);
    json.member("goal", score.goal);
    json.key("reached");
    score.reached() ? json.value(*score.reached()) : json.null();
    json.end_object();
  }
  json.key("order").begin_object();
  write_top(json, "tfm", comparison.tfm_top);
  write_top(json, "dem", comparison.dem_top);
  json.key("same");
  comparison.tfm_top&& comparison.dem_top ? json.value(comparison.tfm_top->species == comparison.dem_top->species)
                                          : json.null();
  json.end_object().end_object();
}

/// The counters of a run, as its record has them.
void write_work(Json& json, const core::JsonValue& record) {
  json.key("work").begin_object();
  for (const auto& [name, count] : record.of("work").object())
    if (count.is_number()) json.member(name, count.number());
  json.end_object();
}

/// Time by the clock; empty for a record of before it was kept.
Number wall_of(const core::JsonValue& record) {
  const auto found = record.object().find("wall_s");
  return found == record.object().end() ? std::nullopt : Number(found->second.number());
}

void write_run(Json& json, const std::string& model, const ComparedRun& run, std::size_t profiles) {
  const core::JsonValue& record = run.record;
  json.key(model).begin_object();
  write_work(json, record);
  json.member("cpu_s", record.of("cpu_s").number());
  json.member("wall_s", wall_of(record));
  json.member("time_s", record.of("time_s").number());
  json.member("ranks", record.of("ranks").number()).member("state", record.of("state").text());
  json.member("directory", run.directory.string()).member("case_hash", record.of("case_hash").text());
  json.member("git_commit", record.of("git_commit").text()).member("profiles_in_window", std::uint64_t(profiles));
  json.end_object();
}

/// A number with its half-width, to the digits that the half-width leaves.
std::string with_error(const Number& value, const Number& error) {
  if (!value) return "-";
  return error ? fmt::format("{:.4g} +-{:.1g}", *value, *error) : fmt::format("{:.4g}", *value);
}

std::string top_text(const std::optional<OnTop>& top) {
  return !top ? "-" : top->species + (top->certain ? "" : " (within the uncertainty)");
}

std::string work_line(const std::string& model, const ComparedRun& run) {
  std::string line = fmt::format("{}: {}, {:.4g} s simulated, {:.3g} CPU s,", model, run.record.of("state").text(),
                                 run.record.of("time_s").number(), run.record.of("cpu_s").number());
  if (const Number wall = wall_of(run.record)) line += fmt::format(" {:.3g} s by the clock;", *wall);
  for (const char* name : {"rhs_evaluations", "linear_iterations", "steps", "particle_steps", "pair_checks"})
    if (const auto& work = run.record.of("work").object(); work.contains(name))
      line += fmt::format(" {} {:.4g}", name, work.at(name).number());
  return line + fmt::format("  [{}]\n", (run.directory / "run.json").string());
}

std::string score_line(const Score& score) {
  std::string line = fmt::format("{:26} {:>20}", score.name, with_error(score.value, score.error));
  if (score.goal)
    line += fmt::format("   goal {:.2g}{}", *score.goal,
                        !score.reached()   ? ""
                        : *score.reached() ? ": reached"
                                           : ": missed");
  return line + "\n";
}

}  // namespace

std::string comparison_json(const Comparison& comparison, const ComparedRun& tfm, const ComparedRun& dem,
                            const ComparisonRequest& request) {
  Json json;
  json.begin_object().member("filetype", "polybed comparison").member("version", 1);
  json.member("git_commit", core::git_commit()).member("case", request.case_file);
  json.member("directory", request.directory.string()).key("overrides").begin_array();
  for (const std::string& override : request.overrides) json.value(override);
  json.end_array();
  json.key("window").begin_object();
  json.member("begin_s", comparison.window.begin).member("end_s", comparison.window.end);
  json.member("shortened", comparison.window.shortened).member("confidence", measures::confidence).end_object();
  write_measures(json, comparison);
  write_profiles(json, comparison);
  write_scores(json, comparison);
  json.key("models").begin_object();
  write_run(json, "tfm", tfm, comparison.tfm_profiles);
  write_run(json, "dem", dem, comparison.dem_profiles);
  json.end_object();
  if (!comparison.inversion_file.empty()) json.member("inversion_file", comparison.inversion_file);
  json.key("warnings").begin_array();
  for (const std::string& warning : comparison.warnings) json.value(warning);
  json.end_array().end_object();
  return json.text();
}

std::string comparison_table(const Comparison& comparison, const ComparedRun& tfm, const ComparedRun& dem) {
  std::string text = fmt::format("means from {:.4g} to {:.4g} s, +- 95 %\n{:26} {:>20} {:>20} {:>20}\n",
                                 comparison.window.begin, comparison.window.end, "", "tfm", "dem", "tfm - dem");
  for (const ComparedMeasure& m : comparison.measures)
    text += fmt::format("{:26} {:>20} {:>20} {:>20}\n", m.name, with_error(mean_of(m.tfm), error_of(m.tfm)),
                        with_error(mean_of(m.dem), error_of(m.dem)), with_error(m.difference(), m.difference_error()));
  text += fmt::format("{:26} {:>20} {:>20}\n\n", "on top", top_text(comparison.tfm_top), top_text(comparison.dem_top));
  for (const Score& score : comparison.scores) text += score_line(score);
  text += "\n" + work_line("tfm", tfm) + work_line("dem", dem);
  for (const std::string& warning : comparison.warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace polybed::multiscale
