// polybed drag: a drag closure at a point, or for every row of a CSV file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <sstream>

#include "app/ask.hpp"
#include "app/commands.hpp"
#include "closures/drag.hpp"
#include "core/case/keys.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "relevance/drag_file.hpp"
#include "relevance/drag_law.hpp"

namespace polybed::app {

namespace {

struct DragOptions {
  std::string law = "cello", partition = "none", csv;
  std::optional<double> voidage, reynolds;
  bool guard = true, json = false, list = false;
  std::optional<double> sphericity;
  std::string shape = std::string(closures::shape_laws[0].name);
};

using closures::DragLaw;

constexpr std::size_t most_species = 64;  // of one sphericity in a row of a table

DragLaw law_of(const DragOptions& options) {
  const auto names = closures::drag_law_names();
  if (!relevance::drag_file(options.law) && std::find(names.begin(), names.end(), options.law) == names.end()) {
    const std::string near = core::nearest_name(options.law, names);
    throw core::CaseError("unknown drag law '" + options.law + "'" +
                          (near.empty() ? "; see polybed list" : "; did you mean '" + near + "'?"));
  }
  try {
    DragLaw law = relevance::drag_law_named(options.law, options.partition,
                                            options.guard ? closures::Guard::on : closures::Guard::off);
    if (!options.sphericity) return law;
    const closures::ShapeFactor factor =
        closures::shape_factor(closures::shape_law_named(options.shape), *options.sphericity);
    law.shape = {std::vector(most_species, factor), factor};
    return law;
  } catch (const std::invalid_argument& error) {
    throw core::CaseError(std::string(error.what()) + "; see polybed list");
  }
}

void check_point(double voidage, double reynolds, const std::string& where) {
  if (!(voidage > 0 && voidage <= 1))
    throw core::CaseError(fmt::format("{}voidage {} is outside (0, 1]", where, voidage));
  if (!(reynolds >= 0 && std::isfinite(reynolds)))
    throw core::CaseError(fmt::format("{}Reynolds number {} is outside [0, inf)", where, reynolds));
}

/// A number of the answer; overflow is the user's error: the point is too extreme.
double finite(double value, double voidage, double reynolds, const std::string& where) {
  if (!std::isfinite(value))
    throw core::CaseError(fmt::format("{}the drag at voidage {} and Reynolds number {} is too large for a number",
                                      where, voidage, reynolds));
  return value;
}

/// The base law at one point; an exception from a bare formula is the user's error.
double at_point(const DragLaw& law, double voidage, double reynolds, closures::GuardCount& count,
                const std::string& where) {
  double f = 0, slope = 0;
  try {
    closures::drag_of_points(law, {&voidage, 1}, {&reynolds, 1}, {&f, 1}, {&slope, 1}, count);
  } catch (const std::domain_error& error) {
    throw core::CaseError(where + error.what());
  }
  finite(f / voidage, voidage, reynolds, where);
  return f;
}

/// The laws of one size that are valid at a point, from the least drag to the greatest.
std::vector<std::pair<double, std::string>> laws_at(double voidage, double reynolds) {
  std::vector<std::pair<double, std::string>> found;
  for (const closures::DragLawInfo& info : closures::drag_laws()) {
    if (!info.is_mean) continue;
    closures::GuardCount count;
    double f = 0, slope = 0;
    closures::drag_of_points(closures::drag_law(info.name, closures::Guard::on), {&voidage, 1}, {&reynolds, 1}, {&f, 1},
                             {&slope, 1}, count);
    if (count.guarded == 0 && std::isfinite(f)) found.emplace_back(f, info.name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// The drag by each formula of the shape.
std::map<std::string, double> by_shapes(DragOptions options) {
  std::map<std::string, double> found;
  for (const closures::ShapeLaw& shape : closures::shape_laws) {
    options.shape = shape.name;
    closures::GuardCount count;
    found.emplace(shape.name, at_point(law_of(options), *options.voidage, *options.reynolds, count, ""));
  }
  return found;
}

/// Describes the number on standard error, so that scripts read only the number.
void explain_point(const DragOptions& options, const DragLaw& law, double f, bool outside) {
  core::print(stderr,
              "f = {:.5g}: drag without buoyancy over Stokes drag 3 pi mu D u, unit 1; n = f/voidage = {:.5g}\n", f,
              f / *options.voidage);
  for (const closures::DragLawInfo& info : closures::drag_laws())
    if (info.name == options.law) core::print(stderr, "law {}: {}; {}\n", info.name, info.help, info.source);
  if (options.sphericity) {
    core::print(stderr, "sphericity {:g}, shape {}", *options.sphericity, options.shape);
    for (const auto& [shape, of_it] : by_shapes(options))
      if (shape != options.shape) core::print(stderr, "; by {} f = {:.5g}", shape, of_it);
    core::print(stderr, "\n");
  }
  const std::string fitted = relevance::fitted_range(law);
  if (!fitted.empty() && !law.fitted_to)
    core::print(stderr, "range: unknown; the law file does not contain the range of its rows\n");
  else if (!fitted.empty())
    core::print(stderr, "range: {} of the fit, {}\n", outside ? "outside the rows" : "within the rows", fitted);
  else
    core::print(stderr, "range: {}\n",
                !outside        ? "within"
                : options.guard ? "outside the range of the law; its extension (guard) answered"
                                : "outside the range of the law; the bare formula answered");
  if (const auto laws = laws_at(*options.voidage, *options.reynolds); laws.size() > 1)
    core::print(stderr, "band: {:.4g} ({}) to {:.4g} ({}), the {} laws of one size whose range has this point\n",
                laws.front().first, laws.front().second, laws.back().first, laws.back().second, laws.size());
}

void print_point(const DragOptions& options, const DragLaw& law) {
  check_point(*options.voidage, *options.reynolds, "");
  closures::GuardCount count;
  const double f = at_point(law, *options.voidage, *options.reynolds, count, "");
  if (options.json) {
    core::Json json = {{"law", options.law},        {"voidage", *options.voidage}, {"re", *options.reynolds}, {"f", f},
                       {"n", f / *options.voidage}, {"guarded", count.guarded > 0}};
    if (options.sphericity)
      json.update({{"sphericity", *options.sphericity}, {"shape", options.shape}, {"f_by_shape", by_shapes(options)}});
    return core::print("{}\n", core::json_text(json));
  }
  core::print("{}\n", f);
  explain_point(options, law, f, count.guarded > 0);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

/// Input from a row of a table: a voidage, a Reynolds number, and for a mixture its shares and diameters.
struct Row {
  std::string text;            ///< its input cells, as in the file
  std::string where;           ///< file and line
  std::vector<double> values;  ///< all of them, in the order of the header
  std::vector<double> share, diameter;
};

/// Names of the results for a row.
std::vector<std::string> answer_names(std::size_t species, bool shared) {
  if (species == 0) return {"f", "n"};
  std::vector<std::string> names{"f_mean", "n_mean"};
  for (std::size_t j = 1; j <= species; ++j)
    for (const char* name : {"f", "n", "alpha", "Omega"}) names.push_back(fmt::format("{}_{}", name, j));
  if (shared) names.emplace_back("deviation");
  return names;
}

/// f and n; for a mixture their means and, per species, f_j, n_j, alpha_j, Omega_j; with a partition the relative
/// difference of the total drag from the mean law.
std::vector<double> answer(const DragLaw& law, const Row& row) {
  const double eps = row.values[0], re = row.values[1];
  const std::size_t n = row.share.size();
  if (n == 0) {
    closures::GuardCount count;
    const double f = at_point(law, eps, re, count, row.where);
    return {f, f / eps};
  }
  const double mean = closures::sauter_diameter(row.share, row.diameter);
  std::vector<double> f(n), slope(n), slip(n, re / mean);  // density and viscosity 1: Re = slip D
  double f_mean = 0;
  if (law.shape && n > most_species)
    throw core::CaseError(fmt::format("{}{} species with --sphericity; at most {}", row.where, n, most_species));
  try {
    closures::drag_of_mixture(law, eps, row.share, row.diameter, slip, 1, 1, f, slope);
    f_mean = closures::drag_of_mean(law, eps, re, row.share, row.diameter, f);
  } catch (const std::domain_error& error) {
    throw core::CaseError(row.where + error.what());
  }
  std::vector<double> values{f_mean, finite(f_mean / eps, eps, re, row.where)};
  for (std::size_t j = 0; j < n; ++j) {
    const double y = row.diameter[j] / mean, omega = f[j] / f_mean, net = f[j] + (1 - eps) * y * y * f_mean / eps;
    const double alpha = closures::alpha_of_omega(eps, omega, y);
    for (const double value : {f[j], net, alpha, omega}) values.push_back(finite(value, eps, re, row.where));
  }
  if (law.partition) values.push_back(closures::deviation_from_base(law, eps, re, row.share, row.diameter, f));
  return values;
}

double number_in(const std::string& cell, const std::string& where) {
  try {
    std::size_t used = 0;
    const double value = std::stod(cell, &used);
    if (cell.find_first_not_of(" \r\t", used) == std::string::npos && std::isfinite(value)) return value;
  } catch (const std::exception&) {
  }
  throw core::CaseError(where + "'" + cell + "' is no number");
}

/// The columns of a header that define the point. Measurements can follow, from n_1 on, as `polybed resolve` writes
/// them.
std::vector<std::string> asked_in(std::vector<std::string> columns, const std::string& where) {
  columns.erase(std::find(columns.begin(), columns.end(), "n_1"), columns.end());
  if (std::find(columns.begin(), columns.end(), "u_1") != columns.end())
    throw core::CaseError(where + "rows of free spheres have a slip u_j for each species, no force at a given slip");
  bool fits = columns.size() >= 2 && columns.size() % 2 == 0 && columns[0] == "eps" && columns[1] == "Re";
  for (std::size_t j = 1; fits && 2 * j < columns.size(); ++j)
    fits = columns[2 * j] == fmt::format("x{}", j) && columns[2 * j + 1] == fmt::format("D{}", j);
  if (!fits) throw core::CaseError(where + "columns must be eps,Re or eps,Re,x1,D1,x2,D2,..., then none or n_1,...");
  return columns;
}

/// Takes shares and diameters from the values of a row, which it refuses if they are no point.
Row checked(Row row) {
  check_point(row.values.at(0), row.values.at(1), row.where);
  for (std::size_t c = 2; c + 1 < row.values.size(); c += 2) {
    row.share.push_back(row.values[c]);
    row.diameter.push_back(row.values[c + 1]);
    if (!(row.share.back() >= 0 && row.diameter.back() > 0))
      throw core::CaseError(row.where + "shares must be >= 0, diameters > 0");
  }
  const double sum = std::accumulate(row.share.begin(), row.share.end(), 0.0);
  if (!row.share.empty() && std::abs(sum - 1) > 1e-6)
    throw core::CaseError(fmt::format("{}shares sum to {}, not to 1", row.where, sum));
  return row;
}

/// \param columns  of the header  \param asked  how many of them define the point
Row row_of(const std::string& line, std::size_t columns, std::size_t asked, const std::string& where) {
  std::vector<std::string> cells = split(line);
  if (cells.size() != columns)
    throw core::CaseError(fmt::format("{}{} cells, the header has {}", where, cells.size(), columns));
  cells.resize(asked);
  Row row{fmt::format("{}", fmt::join(cells, ",")), where, {}, {}, {}};
  for (const std::string& c : cells) row.values.push_back(number_in(c, where));
  return checked(std::move(row));
}

/// Calls see(header, row) for every row of a file of points, with the columns of the header that define a point.
template <class See>
void read_points(const std::string& path, See&& see) {
  std::istringstream file(core::read_text(path));
  std::vector<std::string> header;
  std::size_t columns = 0;
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const std::string where = fmt::format("{}:{}: ", path, number);
    if (header.empty()) {
      const std::vector<std::string> all = split(line);
      columns = all.size();
      header = asked_in(all, where);
      see(header, std::optional<Row>());
    } else {
      see(header, std::optional<Row>(row_of(line, columns, header.size(), where)));
    }
  }
  if (header.empty()) throw core::CaseError(path + ": no header and no rows");
}

void print_csv(const DragOptions& options, const DragLaw& law) {
  read_points(options.csv, [&](const std::vector<std::string>& header, const std::optional<Row>& row) {
    if (row)
      core::print("{},{}\n", row->text, fmt::join(answer(law, *row), ","));
    else
      core::print("{},{}\n", fmt::join(header, ","),
                  fmt::join(answer_names((header.size() - 2) / 2, law.partition.has_value()), ","));
  });
}

core::Json named_answers(const DragLaw& law, const Row& row) {
  const std::vector<std::string> names = answer_names(row.share.size(), law.partition.has_value());
  const std::vector<double> answers = answer(law, row);
  core::Json found;
  for (std::size_t c = 0; c < names.size(); ++c) found[names[c]] = answers[c];
  return found;
}

void print_json(const DragOptions& options, const DragLaw& law) {
  core::Json rows = core::Json::array();
  read_points(options.csv, [&](const std::vector<std::string>& header, const std::optional<Row>& row) {
    if (!row) return;
    core::Json& one = rows.emplace_back();
    for (std::size_t c = 0; c < header.size(); ++c) one[header[c]] = row->values[c];
    one.update(named_answers(law, *row));
  });
  core::Json json = {{"law", options.law}};
  if (law.partition) json["partition"] = options.partition;
  json["rows"] = std::move(rows);
  core::print("{}\n", core::json_text(json));
}

/// All laws, partitions and formulas of the shape, each with its source.
void print_list(bool as_json) {
  if (as_json) {
    core::Json json = {
        {"laws", core::Json::array()}, {"partitions", core::Json::array()}, {"shapes", core::Json::array()}};
    const auto add = [&](const char* list, const auto& laws) {
      for (const auto& law : laws)
        json[list].push_back(
            {{"name", std::string(law.name)}, {"help", std::string(law.help)}, {"source", std::string(law.source)}});
    };
    add("laws", closures::drag_laws());
    add("partitions", closures::partitions());
    add("shapes", closures::shape_laws);
    return core::print("{}\n", core::json_text(json));
  }
  const auto print = [](std::string_view name, std::string_view help, std::string_view source) {
    core::print("  {:20} {}\n  {:20} {}\n", name, help, "", source);
  };
  core::print("laws, --law:\n");
  for (const closures::DragLawInfo& law : closures::drag_laws()) print(law.name, law.help, law.source);
  core::print("partitions, --partition:\n");
  for (const closures::DragLawInfo& law : closures::partitions()) print(law.name, law.help, law.source);
  core::print("formulas of the shape, --shape:\n");
  for (const closures::ShapeLaw& law : closures::shape_laws) print(law.name, law.help, law.source);
}

void run_drag(const DragOptions& options) {
  if (options.list) return print_list(options.json);
  const DragLaw law = law_of(options);
  if (!options.csv.empty()) return options.json ? print_json(options, law) : print_csv(options, law);
  if (!options.voidage || !options.reynolds) throw core::CaseError("give --voidage and --re, or --csv FILE");
  print_point(options, law);
}

}  // namespace

core::Json drag_of_points(const core::Json& question) {
  const auto name = [&](const char* what) { return core::text_of(core::member_of(question, what)); };
  DragOptions options;
  options.law = name("law");
  options.partition = name("partition");
  const DragLaw chosen = law_of(options);
  core::Json answers = core::Json::array();
  for (const core::Json& point : core::array_of(core::member_of(question, "points"))) {
    Row row{"", fmt::format("point {}: ", answers.size() + 1), {}, {}, {}};
    for (const core::Json& value : core::array_of(point)) row.values.push_back(core::number_of(value));
    answers.push_back(named_answers(chosen, checked(std::move(row))));
  }
  return answers;
}

void add_drag(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<DragOptions>();
  const auto guard = std::make_shared<std::string>("on");
  CLI::App& command = *app.add_subcommand("drag", "evaluate a drag closure at a point, or for every row of a CSV file");
  command.add_option("--law", options->law, "see polybed list");
  command.add_option("--partition", options->partition, "that shares the law among species; see polybed list");
  command.add_option("--voidage", options->voidage, "eps");
  command.add_option("--re", options->reynolds, "Reynolds number of the diameter and the superficial slip velocity");
  command.add_option("--sphericity", options->sphericity, "of the particles, 0.2 to 1")->check(CLI::Range(0.2, 1.0));
  std::vector<std::string> shapes;
  for (const closures::ShapeLaw& law : closures::shape_laws) shapes.emplace_back(law.name);
  command.add_option("--shape", options->shape, "formula of the shape; the others are printed next to it")
      ->check(CLI::IsMember(shapes));
  command.add_flag("--list", options->list, "all laws with their sources");
  command.add_option("--csv", options->csv, "file with columns eps,Re or eps,Re,x1,D1,x2,D2,...");
  command.add_option("--guard", *guard, "on | off: the bare published formula")->check(CLI::IsMember({"on", "off"}));
  command.add_flag("--json", options->json, "one JSON object");
  commands.push_back({&command, doing([options, guard] {
                        options->guard = *guard == "on";
                        run_drag(*options);
                      })});
}

}  // namespace polybed::app
