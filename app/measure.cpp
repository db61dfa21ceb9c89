// polybed measure: measures from the profiles of a run, and means over a time window: one definition for every study.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/ask.hpp"
#include "app/commands.hpp"
#include "app/measure_text.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/output/output.hpp"
#include "core/print.hpp"

namespace polybed::app {

namespace {

using measures::Profile;
using measures::StoredRun;
using Values = std::vector<measures::Value>;
using Numbers = std::vector<double>;

// ---- reading

/// Names in the order of the case, as in the columns of the history.
std::vector<std::string> species_of(const std::filesystem::path& run, const core::Profiles& profiles,
                                    const std::vector<std::string>& columns) {
  const std::string front = "phi_";
  std::vector<std::string> stored;
  for (const std::string& name : profiles.names)
    if (name.starts_with(front)) stored.push_back(name.substr(front.size()));
  if (stored.empty()) throw core::FileError((run / "profiles.h5").string() + " has no phi_NAME of a species");
  const auto place = [&](const std::string& name) {
    return std::find(columns.begin(), columns.end(), "centre_" + name + "_m");
  };
  std::stable_sort(stored.begin(), stored.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  return stored;
}

StoredRun read_run(const std::filesystem::path& directory) {
  if (!std::filesystem::is_directory(directory)) throw core::FileError(directory.string() + ": no such run directory");
  const core::Profiles stored = core::read_profiles(directory);
  StoredRun run;
  if (std::filesystem::exists(directory / "history.csv")) run.history = core::read_history(directory);
  run.species = species_of(directory, stored, run.history.columns);
  run.time = stored.time;
  const std::size_t slabs = stored.height.size();
  const auto row_of = [&](const std::string& name, std::size_t n) {
    const std::vector<double>& all = stored.of(name).values;
    if (slabs == 0 || all.size() != stored.time.size() * slabs)
      throw core::FileError(fmt::format("{}: {} has {} values for {} times and {} slabs",
                                        (directory / "profiles.h5").string(), name, all.size(), stored.time.size(),
                                        slabs));
    const auto begin = all.begin() + std::ptrdiff_t(n * slabs);
    return std::vector<double>(begin, begin + std::ptrdiff_t(slabs));
  };
  const auto has = [&](const char* name) {
    return std::find(stored.names.begin(), stored.names.end(), name) != stored.names.end();
  };
  for (std::size_t n = 0; n < stored.time.size(); ++n) {
    Profile profile;
    for (const std::string& name : run.species) profile.fraction.push_back(row_of("phi_" + name, n));
    if (has("p")) profile.pressure = row_of("p", n);
    if (has(core::area_of_slabs)) profile.areas = row_of(core::area_of_slabs, n);
    profile.slab = 2 * stored.height.front();
    run.beds.push_back({std::move(profile)});
  }
  return run;
}

// ---- measuring

std::vector<MeasuredColumn> measured(const StoredRun& run) {
  std::vector<MeasuredColumn> found;
  for (const auto& measure :
       singles(read_by(&measures::Readers::profile, measures::bed_table(run.around())), run.species)) {
    Values values;
    for (const measures::Bed& bed : run.beds) {
      const measures::Value value = measure.of(bed);
      values.push_back(value && std::isfinite(*value) ? value : std::nullopt);
    }
    found.push_back({measure.name, measure.unit, measure.help, measure.column(), std::move(values)});
  }
  return found;
}

/// The columns after the time.
std::vector<MeasuredColumn> in_time(const StoredRun& run) {
  std::vector<MeasuredColumn> columns = measured(run);
  columns.insert(columns.begin(), {"time", "s", {}, "time_s", Values(run.time.begin(), run.time.end())});
  return columns;
}

core::Json json_of(const measures::Means& means, bool in_time) {
  core::Json json = core::Json::object();
  for (const auto& [name, mean] : means) {
    json[name] = {{"mean", mean.mean}, {"interval", core::or_null(mean.interval)}};
    if (in_time) json[name]["correlation_rows"] = mean.correlation;
  }
  return json;
}

core::Json json_of(const measures::StoredRun& run, const measures::InWindow& found) {
  core::Json fraction = core::Json::object();
  for (std::size_t j = 0; j < run.species.size(); ++j) {
    core::Json mean = core::Json::array(), interval = core::Json::array();
    for (std::size_t k = 0; found.profiles > 0 && k < found.height.size(); ++k) {
      mean.push_back(found.mean[j][k].mean);
      interval.push_back(core::or_null(found.mean[j][k].interval));
    }
    fraction[run.species[j]] = {{"mean", mean}, {"interval", interval}};
  }
  return {
      {"rows", found.rows},
      {"step_s", found.step},
      {"means", json_of(found.means, true)},
      {"profiles", found.profiles},
      {"mean_profile", {{"y_m", found.height}, {"fraction", fraction}, {"measures", json_of(found.of_mean, false)}}}};
}

/// Numbers; NaN for null.
Numbers numbers_of(const core::Json& value) {
  Numbers found;
  for (const core::Json& number : core::array_of(value))
    found.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN() : core::number_of(number));
  return found;
}

/// From its values without each of the groups of rows.
template <class Function>
core::Json interval_of(std::size_t rows, const Function& function) {
  std::vector<measures::Value> values;
  for (const measures::Rows& group : measures::groups_of(rows)) values.push_back(function(group));
  return core::or_null(measures::jackknife_interval(values));
}

core::Json means_of(const Numbers& values) {
  const std::optional<measures::TimeMean> mean = measures::time_mean(values);
  if (!mean) return nullptr;
  return {{"mean", mean->mean},
          {"interval", core::or_null(mean->interval)},
          {"interval_of_repeats", core::or_null(measures::interval_of_repeats(values))},
          {"deviation", measures::deviation_of(values)},
          {"deviation_interval", interval_of(values.size(), [&](const measures::Rows& group) {
             return measures::deviation_of(measures::without(values, group));
           })}};
}

/// Null without a finite number, as of a ratio to 0.
core::Json ratio_of(const Numbers& above, const Numbers& below) {
  if (above.empty() || above.size() != below.size()) throw core::FileError("a ratio of rows that are not pairs");
  const auto ratio = [](const Numbers& a, const Numbers& b) {
    return std::accumulate(a.begin(), a.end(), 0.0) / std::accumulate(b.begin(), b.end(), 0.0);
  };
  const double value = ratio(above, below);
  if (!std::isfinite(value)) return {{"value", nullptr}, {"interval", nullptr}};
  return {{"value", value}, {"interval", interval_of(above.size(), [&](const measures::Rows& group) {
                               return ratio(measures::without(above, group), measures::without(below, group));
                             })}};
}

/// Where a window ends in a run, s. Throws CaseError where it would begin at that time or later.
double end_of(const measures::Window& window, const StoredRun& run, const std::string& folder) {
  const Numbers& time = run.history.of("time_s");
  const double last = time.empty() ? 0 : time.back(), end = std::min(window.end, last);
  if (window.begin < end || window.begin == 0) return end;
  throw core::CaseError(window.begin < last ? fmt::format("--end {:g} is not after --begin {:g}", end, window.begin)
                                            : fmt::format("--begin {:g}: the run in {} ends at {:g} s: begin earlier",
                                                          window.begin, folder, last));
}

void require_history(const StoredRun& run, const std::string& folder) {
  if (run.history.columns.empty()) throw core::FileError(folder + ": no history.csv, of which means are taken");
}

/// Adds the window of the means, the means of the run, and those of the other run with the distances from it. The
/// window is within the time of both runs, unless only its begin is given: each run then extends to its own end.
void add_means(core::Json& json, const MeasureOptions& options, const StoredRun& run, const StoredRun* beside) {
  std::vector<const StoredRun*> runs{&run};
  if (beside != nullptr) runs.push_back(beside);
  if (options.begin || beside != nullptr) require_history(run, options.run);
  if (beside != nullptr) require_history(*beside, options.beside);
  measures::Window window{options.begin.value_or(0), options.end.value_or(std::numeric_limits<double>::infinity())};
  try {
    if (!options.begin) window = measures::common_window(runs);
  } catch (const core::FileError&) {
    if (beside != nullptr) throw;
    json["in_window"] = nullptr;
    return;
  }
  const double end = end_of(window, run, options.run);
  json["window"] = {{"begin_s", window.begin}, {"end_s", end}, {"shortened", window.shortened}};
  json["in_window"] = json_of(run, measures::in_window(run, window, options.slabs));
  if (beside == nullptr) return;
  const double end_beside = end_of(window, *beside, options.beside);
  json["beside"] = json_of(*beside, measures::in_window(*beside, window, options.slabs));
  json["beside"]["end_s"] = end_beside;
  json["distances"] = json_of(measures::distances(run, *beside, window, options.slabs), false);
}

// ---- output

void print_json(const StoredRun& run, const MeasureOptions& options) {
  core::Json json{{"time_s", run.time}, {"measures", core::Json::object()}};
  for (const MeasuredColumn& column : measured(run)) {
    core::Json values = core::Json::array();
    for (const measures::Value& value : column.values) values.push_back(core::or_null(value));
    json["measures"][column.name] = {{"unit", column.unit}, {"help", column.help}, {"values", values}};
  }
  std::optional<StoredRun> beside;
  if (!options.beside.empty()) beside = read_run(options.beside);
  add_means(json, options, run, beside ? &*beside : nullptr);
  core::print("{}\n", core::json_text(json));
}

void print_in_si(const StoredRun& run) {
  const std::vector<MeasuredColumn> columns = in_time(run);
  for (const MeasuredColumn& column : columns)
    core::print("{}{}", &column == &columns.front() ? "" : ",", column.heading);
  core::print("\n");
  for (std::size_t n = 0; n < run.beds.size(); ++n) {
    for (const MeasuredColumn& column : columns)
      core::print("{}{}", &column == &columns.front() ? "" : ",",
                  column.values[n] ? fmt::format("{}", *column.values[n]) : "");
    core::print("\n");
  }
}

/// Means of the numbers of a JSON file, or of standard input; an error names it.
void print_series(const std::string& file) {
  const bool given = file == "-";
  const std::string text = given ? std::string{std::istreambuf_iterator<char>(std::cin), {}} : core::read_text(file);
  try {
    core::print("{}\n", core::json_text(means_of_series(core::parse_json(text))));
  } catch (const core::FileError& error) {
    throw core::FileError(fmt::format("{}: {}", given ? "standard input" : file, error.what()));
  }
}

void run_measure(const MeasureOptions& options) {
  if (options.list) return print_measures(options);
  if (!options.series.empty()) return print_series(options.series);
  const StoredRun run = read_run(options.run);
  if (options.json) return print_json(run, options);
  if (options.csv) return print_in_si(run);
  if (run.around())
    return core::print("joined ends: nothing is read along the height; slips are in history.csv and on the card\n");
  if (options.details || run.time.empty()) return print_table(in_time(run));
  print_summary(run, measured(run));
}

}  // namespace

core::Json means_of_series(const core::Json& asked) {
  core::Json found = {{"series", core::Json::array()}, {"ratios", core::Json::array()}};
  if (asked.contains("series"))
    for (const core::Json& values : core::array_of(asked["series"]))
      found["series"].push_back(means_of(numbers_of(values)));
  if (asked.contains("ratios"))
    for (const core::Json& pair : core::array_of(asked["ratios"]))
      found["ratios"].push_back(
          ratio_of(numbers_of(core::member_of(pair, "above")), numbers_of(core::member_of(pair, "below"))));
  return found;
}

void add_measure(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App& command = *app.add_subcommand("measure", "bed height, centres, mixing, ... of the profiles of a run");
  CLI::Option_group& what = *command.add_option_group("what");
  CLI::Option* run = what.add_option("RUN", options->run, "run directory");
  CLI::Option* series = what.add_option("--series", options->series, "JSON file of numbers instead, for their means");
  CLI::Option* list = what.add_flag("--list", options->list, "instead: every measure with its unit and definition");
  what.require_option(1);
  command.add_flag("--markdown", options->markdown, "of the list: the page of the documentation")->needs(list);
  CLI::Option* json = command.add_flag("--json", options->json, "one JSON object");
  series->needs(json);
  const auto take = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->needs(run)->needs(json);
  };
  take("--beside", options->beside, "another run, to be measured over the same window");
  CLI::Option* begin = take("--begin", options->begin, "of the window, s; by default it is chosen");
  take("--end", options->end, "likewise")->needs(begin);
  take("--slabs", options->slabs, "lay the profiles on so many slabs first")->check(CLI::Range(1, 1000000));
  command.add_flag("--csv", options->csv, "comma-separated, in SI units")->excludes(json);
  command.add_flag("--details", options->details, "of a run: every stored time instead of means over its last quarter");
  commands.push_back({&command, doing([options] { run_measure(*options); })});
}

}  // namespace polybed::app
