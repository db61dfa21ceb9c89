// polybed drag: a drag closure at a point, or for every row of a CSV file.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>

#include "closures/drag.hpp"
#include "core/error.hpp"
#include "core/json.hpp"
#include "core/keys.hpp"
#include "multiscale/commands/options.hpp"

namespace polybed::multiscale {

namespace {

using closures::DragLaw;

DragLaw law_of(const DragOptions& options) {
  const auto names = closures::drag_law_names();
  if (std::find(names.begin(), names.end(), options.law) == names.end()) {
    const std::string near = core::nearest_name(options.law, names);
    throw core::CaseError("unknown drag law '" + options.law + "'" +
                          (near.empty() ? "; see polybed list" : "; did you mean '" + near + "'?"));
  }
  return closures::drag_law(options.law, options.guard ? closures::Guard::on : closures::Guard::off);
}

void check_point(double voidage, double reynolds, const std::string& where) {
  if (!(voidage > 0 && voidage <= 1))
    throw core::CaseError(fmt::format("{}voidage {} is outside (0, 1]", where, voidage));
  if (!(reynolds >= 0 && std::isfinite(reynolds)))
    throw core::CaseError(fmt::format("{}Reynolds number {} is outside [0, inf)", where, reynolds));
}

/// A number of the answer; one that overflows is the user's error: the point is too far out.
double finite(double value, double voidage, double reynolds, const std::string& where) {
  if (!std::isfinite(value))
    throw core::CaseError(fmt::format("{}the drag at voidage {} and Reynolds number {} is too large for a number",
                                      where, voidage, reynolds));
  return value;
}

/// The base law at one point; a refusal of a bare formula is the user's error.
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

void print_point(const DragOptions& options, const DragLaw& law) {
  check_point(*options.voidage, *options.reynolds, "");
  closures::GuardCount count;
  const double f = at_point(law, *options.voidage, *options.reynolds, count, "");
  if (options.json) {
    core::Json json;
    json.begin_object().member("law", options.law).member("voidage", *options.voidage).member("re", *options.reynolds);
    json.member("f", f).member("n", f / *options.voidage).member("guarded", count.guarded > 0).end_object();
    fmt::print("{}\n", json.text());
    return;
  }
  fmt::print("{}\n", f);
  if (count.guarded > 0)
    fmt::print(stderr, "outside the range of {}: {}\n", options.law,
               options.guard ? "the guard answered" : "bare formula");
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

/// A mixture row: means and, per species, f_j, n_j, alpha_j, Omega_j.
std::string mixture_columns(const DragLaw& law, double eps, double re, const std::vector<double>& share,
                            const std::vector<double>& diameter, const std::string& where) {
  const std::size_t n = share.size();
  const double mean = closures::sauter_diameter(share, diameter);
  std::vector<double> f(n), slope(n), slip(n, re / mean);  // density and viscosity 1: Re = slip D
  double f_mean = 0;
  try {
    closures::drag_of_mixture(law, eps, share, diameter, slip, 1, 1, f, slope);
    f_mean = closures::drag_of_mean(law, eps, re, share, diameter, f);
  } catch (const std::domain_error& error) {
    throw core::CaseError(where + error.what());
  }
  finite(f_mean / eps, eps, re, where);
  std::string text = fmt::format(",{},{}", f_mean, f_mean / eps);
  for (std::size_t j = 0; j < n; ++j) {
    const double y = diameter[j] / mean, omega = f[j] / f_mean, net = f[j] + (1 - eps) * y * y * f_mean / eps;
    const double alpha = closures::alpha_of_omega(eps, omega, y);
    for (const double value : {f[j], net, alpha, omega}) text += fmt::format(",{}", finite(value, eps, re, where));
  }
  return text;
}

void print_header(std::size_t species, const std::string& header) {
  std::string names = species == 0 ? ",f,n" : ",f_mean,n_mean";
  for (std::size_t j = 1; j <= species; ++j) names += fmt::format(",f_{0},n_{0},alpha_{0},Omega_{0}", j);
  fmt::print("{}{}\n", header, names);
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

void print_csv(const DragOptions& options, const DragLaw& law) {
  std::ifstream file(options.csv);
  if (!file) throw core::FileError(options.csv + ": cannot be read");
  std::string line, header;
  std::size_t number = 0, columns = 0;
  while (std::getline(file, line)) {
    ++number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = split(line);
    if (header.empty()) {
      header = line;
      columns = cells.size();
      bool fits = columns >= 2 && columns % 2 == 0 && cells[0] == "eps" && cells[1] == "Re";
      for (std::size_t j = 1; fits && 2 * j < columns; ++j)
        fits = cells[2 * j] == fmt::format("x{}", j) && cells[2 * j + 1] == fmt::format("D{}", j);
      if (!fits)
        throw core::CaseError(
            fmt::format("{}:{}: columns must be eps,Re or eps,Re,x1,D1,x2,D2,...", options.csv, number));
      print_header((columns - 2) / 2, header);
      continue;
    }
    const std::string where = fmt::format("{}:{}: ", options.csv, number);
    if (cells.size() != columns)
      throw core::CaseError(fmt::format("{}{} cells, the header has {}", where, cells.size(), columns));
    std::vector<double> values, share, diameter;
    for (const std::string& c : cells) values.push_back(number_in(c, where));
    check_point(values[0], values[1], where);
    double sum = 0;
    for (std::size_t c = 2; c < columns; c += 2) {
      share.push_back(values[c]);
      diameter.push_back(values[c + 1]);
      sum += values[c];
      if (!(values[c] >= 0 && values[c + 1] > 0)) throw core::CaseError(where + "shares must be >= 0, diameters > 0");
    }
    if (!share.empty() && std::abs(sum - 1) > 1e-6)
      throw core::CaseError(fmt::format("{}shares sum to {}, not to 1", where, sum));
    closures::GuardCount count;
    if (share.empty()) {
      const double f = at_point(law, values[0], values[1], count, where);
      fmt::print("{},{},{}\n", line, f, f / values[0]);
    } else {
      fmt::print("{}{}\n", line, mixture_columns(law, values[0], values[1], share, diameter, where));
    }
  }
  if (file.bad()) throw core::FileError(options.csv + ": cannot be read");
  if (header.empty()) throw core::CaseError(options.csv + ": no header and no rows");
}

}  // namespace

void run_drag(const DragOptions& options) {
  const DragLaw law = law_of(options);
  if (!options.csv.empty()) return print_csv(options, law);
  if (!options.voidage || !options.reynolds) throw core::CaseError("give --voidage and --re, or --csv FILE");
  print_point(options, law);
}

}  // namespace polybed::multiscale
