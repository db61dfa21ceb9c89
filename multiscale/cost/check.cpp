#include "multiscale/cost/check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "core/case/file.hpp"
#include "core/error.hpp"
#include "core/output/files.hpp"
#include "core/print.hpp"
#include "multiscale/cost/quantities.hpp"
#include "multiscale/cost/runner.hpp"
#include "multiscale/effects/choice.hpp"
#include "multiscale/roles.hpp"

namespace polybed::multiscale {

namespace {

namespace fs = std::filesystem;

constexpr double time_allowed = 0.25, dearer_allowed = 0.1;
constexpr const char* filetype = "polybed cost";

double number_or(const core::JsonValue& value, double other) { return value.is_number() ? value.number() : other; }

std::vector<std::string> texts_of(const core::JsonValue& array) {
  std::vector<std::string> texts;
  for (const core::JsonValue& one : array.array()) texts.push_back(one.text());
  return texts;
}

std::string ranking_of(const core::JsonValue& sweep) {
  for (const core::JsonValue& q : sweep.of("qoi").array())
    if (q.of("shown").truth()) return q.of("id").text();
  throw core::FileError("no quantity in cost.json");
}

double scale_in(const core::JsonValue& sweep, const std::string& id) {
  for (const core::JsonValue& q : sweep.of("qoi").array())
    if (q.of("id").text() == id) return q.of("scale").number();
  throw core::FileError("no quantity " + id);
}

/// The sweep's own file says that what it recommends was run again and held.
void confirm(const fs::path& path) {
  std::string text = core::read_text(path);
  const std::string before = "\"confirmed\": false", after = "\"confirmed\": true";
  const std::size_t place = text.find(before);
  if (place == std::string::npos) return;
  core::write_atomically(path, text.replace(place, before.size(), after));
}

MeasureOn measured_on(const core::JsonValue& sweep) {
  const core::Scene scene = core::parse_case(sweep.of("case").text(), "cost.json", {}, all_roles(), size_classes);
  const auto count = std::size_t(scene.column.cells[1]);
  return {scene.column.size[1] / double(count), count,
          Window{sweep.of("window_s").number(), std::numeric_limits<double>::max(), false}};
}

double rate_by(const std::string& clock, const RunOutcome& outcome) {
  if (clock == "work") return outcome.work_rate();
  return clock == "wall" ? outcome.wall / outcome.simulated : outcome.cpu_rate();
}

/// The case of a sweep as it stands now, with the settings of all its runs. Refuses one that was changed since.
core::Scene scene_of(const core::JsonValue& sweep) {
  const std::vector<std::string> overrides = texts_of(sweep.of("overrides"));
  const std::string path = sweep.of("case_path").text();
  const core::Scene then = core::parse_case(sweep.of("case").text(), "cost.json", overrides, all_roles(), size_classes);
  core::Scene now = read_chosen_case(path, overrides);
  if (core::resolved_case(now) != core::resolved_case(then))
    throw core::CaseError(
        fmt::format("{} was changed since it was swept: `polybed cost {} --force` first", path, path));
  return now;
}

std::string told(const char* what, const Checked& c, const char* unit) {
  return fmt::format("{}: claimed {:.4g}, found {:.4g} {}, allowed {:.2g} either way: {}", what, c.claimed, c.found,
                     unit, c.allowed, c.holds() ? "holds" : "does not hold");
}

struct Point {
  double error, cost;
};

/// Ranked runs: all, or those of the front.
std::vector<Point> points_of(const core::JsonValue& sweep, bool front) {
  const std::string id = ranking_of(sweep);
  std::vector<Point> points;
  for (const core::JsonValue& run : sweep.of("runs").array()) {
    const std::string& status = run.of("status").text();
    if (run.of("kind").text() != "candidate" ||
        !(status == "pareto" || (!front && (status == "dominated" || status == "hollow"))))
      continue;
    const auto& quantities = run.of("qoi").object();
    if (const auto q = quantities.find(id); q != quantities.end())
      points.push_back({q->second.of("error").number(), run.of("s_per_sim_s").number()});
  }
  return points;
}

}  // namespace

bool Checked::holds() const { return std::abs(found - claimed) <= allowed; }

bool check_recommendation(const fs::path& directory) {
  const core::JsonValue sweep = core::read_json(directory / "cost.json", filetype);
  if (sweep.of("recommend").array().empty())
    throw core::CaseError(fmt::format("{}: nothing is recommended", (directory / "cost.json").string()));
  const core::JsonValue& advised = sweep.of("recommend").array().front();
  const std::string id = advised.of("qoi").text(), clock = sweep.of("clock").text();
  const core::JsonValue& wall = sweep.of("runs").array().at(std::size_t(advised.of("run").number())).of("wall_s");
  const MeasureOn on = measured_on(sweep);
  Runner runner(scene_of(sweep), sweep.of("case_path").text(), texts_of(sweep.of("overrides")), directory / "check",
                false);
  const RunOrder order{advised.of("model").text(), int(advised.of("ranks").number()),
                       texts_of(advised.of("overrides"))};
  const RunOutcome outcome = runner.run(order, 60 + 20 * wall.array().front().number());
  if (!outcome.done())
    throw core::NumericsError("the run that was recommended: " + outcome.state + ": " + outcome.reason);
  const RunQuantities measured = quantities_of_run(*outcome.measured, on);
  const double reference = sweep.of("reference").of("value").of(id).number();
  constexpr double rounding = 1e-9;
  const Checked error{advised.of("error").number(),
                      std::abs(measured.values.at(id).mean - reference) / scale_in(sweep, id),
                      number_or(advised.of("ci"), 0) + rounding};
  const double claimed = advised.of("s_per_sim_s").number();
  const Checked time{claimed, rate_by(clock, outcome), time_allowed * claimed};
  core::print("{}\n{}\n", told(("error of " + id).c_str(), error, ""),
              told(("time by " + clock).c_str(), time, "s for a simulated second"));
  const bool good = error.holds() && time.holds();
  if (good) confirm(directory / "cost.json");
  return good;
}

std::vector<Dearer> dearer(const core::JsonValue& before, const core::JsonValue& now) {
  if (before.of("case_hash").text() != now.of("case_hash").text()) throw core::FileError("sweeps of other cases");
  if (ranking_of(before) != ranking_of(now)) throw core::FileError("sweeps that rank by other quantities");
  if (before.of("clock").text() != now.of("clock").text() ||
      before.of("work_version").number() != now.of("work_version").number())
    throw core::FileError("sweeps by other clocks, or by other weights of the work");
  constexpr double as_accurate = 1.01;
  std::vector<Dearer> found;
  const std::vector<Point> all = points_of(now, false);
  for (const Point& old : points_of(before, true)) {
    double cheapest = std::numeric_limits<double>::infinity();
    for (const Point& p : all)
      if (p.error <= as_accurate * old.error) cheapest = std::min(cheapest, p.cost);
    if (cheapest > (1 + dearer_allowed) * old.cost)
      found.push_back({old.error, old.cost, std::isfinite(cheapest) ? cheapest : 0});
  }
  return found;
}

bool print_difference(const fs::path& before, const fs::path& now) {
  const std::vector<Dearer> found = dearer(core::read_json(before, filetype), core::read_json(now, filetype));
  for (const Dearer& d : found)
    if (d.now > 0)
      core::print("error {:.3g}: {:.3g} s for a simulated second, was {:.3g}: {:.2g} times as dear\n", d.error, d.now,
                  d.before, d.now / d.before);
    else
      core::print("error {:.3g}: no run is as accurate; took {:.3g} s for a simulated second\n", d.error, d.before);
  if (found.empty()) core::print("nothing is dearer by more than 10 % at the same error\n");
  return found.empty();
}

}  // namespace polybed::multiscale
