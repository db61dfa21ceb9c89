// polybed measure: what is read off the profiles of a run, or off those that are given: one definition for every study.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "app/commands.hpp"
#include "app/measure_means.hpp"
#include "app/measure_text.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/output/output.hpp"
#include "core/print.hpp"
#include "measures/bed_table.hpp"

namespace polybed::app {

namespace {

using measures::Profile;
using Values = std::vector<measures::Value>;
using Column = MeasuredColumn;

/// The request: a run, or profiles without times.
struct Asked : measures::StoredRun {
  std::optional<Profile> reference;
};

// ---- reading

double finite(const core::Json& value) {
  const double number = core::number_of(value);
  if (!std::isfinite(number)) throw core::FileError("a number is not finite");
  return number;
}

/// What `read` returns; an error says of what it is.
template <class Read>
auto naming(const std::string& what, const Read& read) {
  try {
    return read();
  } catch (const core::FileError& error) {
    throw core::FileError(fmt::format("{}: {}", what, error.what()));
  }
}

const core::Json* member(const core::Json& value, const std::string& name) {
  const auto found = value.find(name);
  return found == value.end() || found->is_null() ? nullptr : &*found;
}

template <class Member>
auto of(const core::Json& value, const std::string& name, const Member& read) {
  const core::Json& found = core::member_of(value, name);
  return naming(name, [&] { return read(found); });
}

std::vector<double> numbers(const core::Json& value) {
  std::vector<double> found;
  for (const core::Json& number : core::array_of(value)) found.push_back(finite(number));
  return found;
}

double thickness(const core::Json& value) {
  const double slab = finite(value);
  if (!(slab > 0)) throw core::FileError(fmt::format("{} m is no thickness of a slab", slab));
  return slab;
}

Profile read_profile(const core::Json& value, std::size_t species) {
  Profile profile;
  profile.slab = of(value, "slab", thickness);
  profile.fraction = of(value, "fraction", [](const core::Json& rows) {
    std::vector<std::vector<double>> found;
    for (const core::Json& row : core::array_of(rows)) found.push_back(numbers(row));
    return found;
  });
  if (profile.fraction.size() != species)
    throw core::FileError(fmt::format("fraction: {} rows for {} species", profile.fraction.size(), species));
  for (const auto& phi : profile.fraction)
    if (phi.empty() || phi.size() != profile.slabs())
      throw core::FileError("fraction: its rows are empty or of different length");
  if (member(value, "pressure") != nullptr) profile.pressure = of(value, "pressure", numbers);
  if (!profile.pressure.empty() && profile.pressure.size() != profile.slabs())
    throw core::FileError(fmt::format("pressure: {} values for {} slabs", profile.pressure.size(), profile.slabs()));
  return profile;
}

std::vector<std::string> read_species(const core::Json& value) {
  std::vector<std::string> names;
  for (const core::Json& name : core::array_of(value)) names.push_back(core::text_of(name));
  if (names.empty()) throw core::FileError("none is named");
  if (std::set<std::string>(names.begin(), names.end()).size() < names.size())
    throw core::FileError("a name stands twice");
  return names;
}

void require_slabs_of_reference(const Asked& asked) {
  for (std::size_t n = 0; asked.reference && n < asked.beds.size(); ++n) {
    const Profile &profile = asked.beds[n].profile, &reference = *asked.reference;
    if (profile.slabs() != reference.slabs() || std::abs(profile.slab - reference.slab) > 1e-9 * reference.slab)
      throw core::FileError(fmt::format("profiles[{}]: {} slabs of {} m, the reference has {} of {} m", n,
                                        profile.slabs(), profile.slab, reference.slabs(), reference.slab));
  }
}

Asked read_asked(const core::Json& value) {
  Asked asked;
  asked.species = of(value, "species", read_species);
  const std::vector<core::Json>& profiles =
      of(value, "profiles", [](const auto& v) { return std::cref(core::array_of(v)); });
  for (std::size_t n = 0; n < profiles.size(); ++n)
    asked.beds.push_back(
        {naming(fmt::format("profiles[{}]", n), [&] { return read_profile(profiles[n], asked.species.size()); })});
  if (const core::Json* reference = member(value, "reference"))
    asked.reference = naming("reference", [&] { return read_profile(*reference, asked.species.size()); });
  require_slabs_of_reference(asked);
  return asked;
}

/// What is made of the JSON of a file, or of standard input.
template <class Make>
auto of_given(const std::string& file, const Make& make) {
  if (file != "-") {
    const core::Json value = core::read_json(file);
    return naming(file, [&] { return make(value); });
  }
  const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
  return naming("standard input", [&] { return make(core::parse_json(text)); });
}

/// In the order of the case, which the columns of the history keep.
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

Asked read_run(const std::filesystem::path& run) {
  if (!std::filesystem::is_directory(run)) throw core::FileError(run.string() + ": no such run directory");
  const core::Profiles stored = core::read_profiles(run);
  Asked asked;
  if (std::filesystem::exists(run / "history.csv")) asked.history = core::read_history(run);
  asked.species = species_of(run, stored, asked.history.columns);
  asked.time = stored.time;
  const std::size_t slabs = stored.height.size();
  const auto row_of = [&](const std::string& name, std::size_t n) {
    const std::vector<double>& all = stored.of(name).values;
    if (slabs == 0 || all.size() != stored.time.size() * slabs)
      throw core::FileError(fmt::format("{}: {} has {} values for {} times and {} slabs",
                                        (run / "profiles.h5").string(), name, all.size(), stored.time.size(), slabs));
    const auto begin = all.begin() + std::ptrdiff_t(n * slabs);
    return std::vector<double>(begin, begin + std::ptrdiff_t(slabs));
  };
  const bool has_pressure = std::find(stored.names.begin(), stored.names.end(), "p") != stored.names.end();
  for (std::size_t n = 0; n < stored.time.size(); ++n) {
    Profile profile;
    for (const std::string& name : asked.species) profile.fraction.push_back(row_of("phi_" + name, n));
    if (has_pressure) profile.pressure = row_of("p", n);
    profile.slab = 2 * stored.height.front();
    asked.beds.push_back({std::move(profile)});
  }
  return asked;
}

// ---- measuring

/// \param of  what a measure is read off, by the bed
template <class Source, class Of>
std::vector<Column> columns_of(const measures::Table<Source>& table, const Asked& asked, const Of& of) {
  std::vector<Column> found;
  for (const measures::Single<Source>& measure : measures::singles(table, asked.species)) {
    Values values;
    for (const measures::Bed& bed : asked.beds) {
      const measures::Value value = measure.of(of(bed));
      values.push_back(value && std::isfinite(*value) ? value : std::nullopt);
    }
    found.push_back({measure.name, measure.unit, measure.help, measure.column(), std::move(values)});
  }
  return found;
}

std::vector<Column> measured(const Asked& asked) {
  return columns_of(measures::read_by(&measures::Readers::profile, measures::bed_table()), asked,
                    [](const measures::Bed& bed) -> const measures::Bed& { return bed; });
}

std::vector<Column> distances(const Asked& asked) {
  if (!asked.reference) return {};
  return columns_of(measures::distance_table(), asked, [&](const measures::Bed& bed) {
    return measures::Beside{bed.profile, *asked.reference};
  });
}

// ---- telling

core::Json json_of(const Values& values) {
  core::Json json = core::Json::array();
  for (const measures::Value& value : values) json.push_back(core::or_null(value));
  return json;
}

void print_json(const Asked& asked, const MeasureOptions& options) {
  const bool of_run = options.profiles.empty();
  core::Json json;
  if (of_run) json["time_s"] = asked.time;
  core::Json& of_beds = json["measures"] = core::Json::object();
  for (const Column& column : measured(asked))
    of_beds[column.name] = {{"unit", column.unit}, {"help", column.help}, {"values", json_of(column.values)}};
  if (asked.reference) json["distances"] = core::Json::object();
  for (const Column& column : distances(asked)) json["distances"][column.name] = json_of(column.values);
  if (of_run && options.beside.empty()) add_means(json, options, asked, nullptr);
  if (!options.beside.empty()) {
    const Asked beside = read_run(options.beside);
    add_means(json, options, asked, &beside);
  }
  core::print("{}\n", core::json_text(json));
}

std::vector<Column> all_columns(const Asked& asked, bool of_run) {
  std::vector<Column> columns = measured(asked);
  if (of_run)
    columns.insert(columns.begin(), {"time", "s", {}, "time_s", Values(asked.time.begin(), asked.time.end())});
  for (Column& column : distances(asked)) {
    column.heading = "distance_" + column.name;
    column.name = "distance " + column.name;
    columns.push_back(std::move(column));
  }
  return columns;
}

void print_in_si(const Asked& asked, bool of_run) {
  const std::vector<Column> columns = all_columns(asked, of_run);
  for (const Column& column : columns) core::print("{}{}", &column == &columns.front() ? "" : ",", column.heading);
  core::print("\n");
  for (std::size_t n = 0; n < asked.beds.size(); ++n) {
    for (const Column& column : columns)
      core::print("{}{}", &column == &columns.front() ? "" : ",",
                  column.values[n] ? fmt::format("{}", *column.values[n]) : "");
    core::print("\n");
  }
}

void run_measure(const MeasureOptions& options) {
  if (options.list) return print_measures(options);
  if (!options.series.empty()) return core::print("{}\n", core::json_text(of_given(options.series, means_of_series)));
  const bool of_run = options.profiles.empty();
  const Asked asked = of_run ? read_run(options.run) : of_given(options.profiles, read_asked);
  if (options.json) return print_json(asked, options);
  if (options.csv) return print_in_si(asked, of_run);
  if (options.details || !of_run || asked.time.empty()) return print_table(all_columns(asked, of_run), of_run);
  print_summary(asked, measured(asked));
}

}  // namespace

void add_measure(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App& command = *app.add_subcommand("measure", "bed height, centres, mixing, ... of the profiles of a run");
  CLI::Option_group& what = *command.add_option_group("what");
  CLI::Option* run = what.add_option("RUN", options->run, "run directory");
  what.add_option("--profiles", options->profiles, "JSON file of profiles instead; - reads standard input");
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
