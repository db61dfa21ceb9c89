#include "multiscale/cost/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/print.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/sweeper.hpp"
#include "multiscale/cost/timing.hpp"
#include "multiscale/requirements.hpp"
#include "tfm/model.hpp"
#include "tfm/step_estimate.hpp"

namespace polybed::multiscale {

namespace {

constexpr double window_begin = 0.75;  ///< of the run: the last quarter, cost.md, section 6
constexpr double overdraft = 1.08;     ///< of the budget, which is kept to a tenth

std::vector<std::string> species_names(const core::Scene& scene) {
  std::vector<std::string> names;
  for (const core::Species& s : scene.species) names.push_back(s.name);
  return names;
}

MeasureOn measure_on(const core::Scene& scene) {
  const auto count = std::size_t(scene.column.cells[1]);
  return {scene.column.size[1] / double(count), count,
          Window{window_begin * scene.run.until, std::numeric_limits<double>::max(), false}};
}

}  // namespace

std::vector<std::string> common_overrides(const core::Scene& scene) {
  constexpr double profiles = 40, rows = 800;  // a quarter of them in the window
  const auto key = [](const char* name, double value) { return fmt::format("{}={:.17g}", name, value); };
  return {key("output.every", scene.run.until / profiles), key("output.history_every", scene.run.until / rows),
          key("output.checkpoint_every", scene.run.until)};
}

Sweeper::Sweeper(const core::Scene& scene, SweepOptions options, Runner& runner) : scene_(scene), runner_(runner) {
  sweep_.quantities = quantities_of(species_names(scene));
  sweep_.axes = axes_of(scene, options.model, options.axes);
  sweep_.on = measure_on(scene);
  const auto known = [&](const std::string& id) {
    return std::any_of(sweep_.quantities.begin(), sweep_.quantities.end(), [&](const auto& q) { return q.id == id; });
  };
  for (const std::string& id : options.quantities)
    if (!known(id)) throw core::CaseError(fmt::format("--qoi {}: no such quantity of this case", id));
  if (options.quantities.empty()) {
    options.quantities = {"bed_height"};
    if (scene.species.size() > 1) options.quantities.emplace_back("centre_difference");
  }
  for (const char* distance : {"profile", "composition"})
    if (options.quantities.front() == distance)
      throw core::CaseError(
          fmt::format("--qoi {}: a distance from the reference has no uncertainty to rank by; name "
                      "another quantity first",
                      distance));
  sweep_.options = std::move(options);
  for (const Axis& a : sweep_.axes) centre_[a.name] = a.name == "grid" ? 0 : a.given;
}

Sweep run_sweep(const core::Scene& scene, SweepOptions options, Runner& runner) {
  return Sweeper(scene, std::move(options), runner).make();
}

void Sweeper::tell(const std::string& text) const {
  if (!sweep_.options.quiet) core::print(stderr, "{:7.1f} s  {}\n", runner_.spent(), text);
}

void Sweeper::refuse(const std::string& reason) {
  sweep_.outcome = "refused";
  sweep_.reason = reason;
}

const Axis* Sweeper::axis(const std::string& name) const {
  const auto found =
      std::find_if(sweep_.axes.begin(), sweep_.axes.end(), [&](const Axis& a) { return a.name == name; });
  return found == sweep_.axes.end() ? nullptr : &*found;
}

Settings Sweeper::centre_with(const std::string& name, std::size_t level) const {
  Settings settings = centre_;
  settings[name] = level;
  return settings;
}

double Sweeper::left() const { return overdraft * sweep_.options.budget - runner_.spent(); }

RunOrder Sweeper::order_of(const Settings& settings) const {
  RunOrder order{sweep_.options.model, 1, {}};
  for (const Axis& a : sweep_.axes) {
    const Level& level = a.levels[settings.at(a.name)];
    order.overrides.insert(order.overrides.end(), level.overrides.begin(), level.overrides.end());
    order.ranks = std::max(order.ranks, level.ranks);
    if (!level.model.empty()) order.model = level.model;
  }
  return order;
}

std::optional<std::size_t> Sweeper::find(const RunOrder& order, RowKind kind) const {
  for (std::size_t n = 0; n < sweep_.rows.size(); ++n) {
    const RunOrder& o = sweep_.rows[n].order;
    if (sweep_.rows[n].kind == kind && o.model == order.model && o.ranks == order.ranks &&
        o.overrides == order.overrides)
      return n;
  }
  return std::nullopt;
}

/// From the next coarser grid, if that was run, in proportion to the cells; else as if a step followed the cells, too.
double Sweeper::grid_ratio(const Axis& grid, std::size_t level) const {
  const std::size_t from = centre_.at("grid");
  const double powers = scene_.column.dimensions;
  const auto ratio = [&](std::size_t a, std::size_t b) { return grid.levels[a].value / grid.levels[b].value; };
  if (level > from)
    if (const auto n = find(order_of(centre_with("grid", level - 1)), RowKind::candidate); n && sweep_.rows[*n].done())
      return sweep_.rows[*n].outcome.wall / sweep_.rows[centre_row_].outcome.wall *
             std::pow(ratio(level - 1, level), powers);
  return std::pow(ratio(from, level), powers + 0.5);
}

/// From the lines as far as they were run; else by powers that no axis is likely to exceed.
double Sweeper::expected_wall(const Settings& settings) const {
  if (sweep_.rows.empty()) return 0;
  const RunOutcome& centre = sweep_.rows[centre_row_].outcome;
  double wall = centre.wall;
  for (const Axis& a : sweep_.axes) {
    const std::size_t level = settings.at(a.name), from = centre_.at(a.name);
    if (level == from) continue;
    if (const auto n = find(order_of(centre_with(a.name, level)), RowKind::candidate); n && sweep_.rows[*n].done())
      wall *= sweep_.rows[*n].outcome.wall / centre.wall;
    else if (a.name == "grid")
      wall *= grid_ratio(a, level);
    else if (a.name == "window")
      wall *= (3 + a.levels[level].value) / 4;
    else if (a.name == "steps")
      wall *= a.levels[level].value / a.levels[from].value;
    else if (a.levels[level].model == "dem")
      wall *= 1e3;
  }
  return wall;
}

/// Height by the balance of forces on a uniform bed: no run, microseconds.
void Sweeper::take_force_balance(Row& row) const {
  core::Timers timers;
  const double begin = core::cpu_seconds();
  core::Scene small = narrow_part(scene_, 64);
  const tfm::Model model(small, timers);
  const double phi = tfm::expanded_fraction(model.constants(), core::law_of(scene_, "drag"), model.inlet().greatest(),
                                            scene_.bed.solids_fraction);
  row.outcome.state = phi > 0 ? "done" : "refused";
  row.outcome.reason = phi > 0 ? "" : "the fluid carries a lone particle away";
  row.outcome.cpu = core::cpu_seconds() - begin;
  row.outcome.simulated = scene_.run.until;
  if (phi > 0)
    row.measured.values["bed_height"] = {scene_.bed.static_height * scene_.bed.solids_fraction / phi, std::nullopt, 1};
  row.measured.values["pressure_drop"] = {1, std::nullopt, 1};
}

std::size_t Sweeper::run(Row row, double most) {
  if (const auto n = find(row.order, row.kind)) {
    if (row.predicted) sweep_.rows[*n].predicted = row.predicted;
    return *n;
  }
  const double expected = row.settings.empty() ? 0 : expected_wall(row.settings);
  if (row.order.model == "force_balance")
    take_force_balance(row);
  else if (expected > most * std::max(0.0, sweep_.options.budget - runner_.spent()))
    row.outcome = {"not run", fmt::format("expected to take {:.3g} s, beyond the budget", expected), 0, 0, 0, true, {},
                   {}};
  else
    row.outcome = runner_.run(row.order, left());
  if (row.done() && !row.outcome.invariants_held) row.outcome.reason = "an invariant exceeded its limit";
  if (row.outcome.measured) row.measured = quantities_of_run(*row.outcome.measured, sweep_.on);
  row.outcome.measured.reset();
  const bool work = sweep_.options.clock == "work" && !row.outcome.counters.empty();
  row.cpu = {row.outcome.cpu};
  row.rate = work                             ? row.outcome.work_rate()
             : sweep_.options.clock == "wall" ? row.outcome.wall / std::max(row.outcome.simulated, 1e-300)
                                              : row.outcome.cpu_rate();
  tell(fmt::format("{}: {}{}", settings_text(sweep_, row), row.outcome.state,
                   row.outcome.reason.empty() ? "" : " (" + row.outcome.reason + ")"));
  sweep_.rows.push_back(std::move(row));
  return sweep_.rows.size() - 1;
}

bool Sweeper::find_regime() {
  Row centre{.settings = centre_, .order = order_of(centre_)};
  const RunOutcome first = runner_.run(centre.order, left());
  centre_row_ = run(std::move(centre));
  if (!first.done()) {
    sweep_.outcome = first.state == "not run" ? "refused" : "failed";
    sweep_.reason = "the first run: " + first.reason;
    return false;
  }
  Row twin{.kind = RowKind::twin, .settings = centre_, .note = "twin: gravity (1 + 1e-10)", .order = order_of(centre_)};
  twin.order.overrides.push_back(fmt::format("column.gravity={:.17g}", scene_.column.gravity * (1 + 1e-10)));
  const RunOutcome second = runner_.run(twin.order, left());
  run(std::move(twin));
  if (!second.done()) {
    sweep_.warnings.push_back("taken to be steady: the run that would tell, with gravity (1 + 1e-10), was not done");
    return true;
  }
  std::vector<std::string> columns{"bed_height_m"};
  for (const std::string& name : species_of(first.measured->history)) columns.push_back(centre_column(name));
  for (const std::string& column : columns)
    if (is_chaotic(
            within(first.measured->history.of("time_s"), first.measured->history.of(column), sweep_.on.window),
            within(second.measured->history.of("time_s"), second.measured->history.of(column), sweep_.on.window)))
      sweep_.regime = "chaotic";
  tell(sweep_.regime);
  return true;
}

void Sweeper::run_lines(AxisKind kind) {
  for (const Axis& a : sweep_.axes) {
    if (a.kind != kind) continue;
    for (std::size_t level = 0; level < a.levels.size(); ++level) {
      const Settings settings = centre_with(a.name, level);
      Row row{.settings = settings, .order = order_of(settings)};
      if (level != centre_.at(a.name) && kind == AxisKind::model) row.kind = RowKind::model;
      if (level != centre_.at(a.name) && kind == AxisKind::machine) row.kind = RowKind::machine;
      run(std::move(row), kind == AxisKind::model ? 0.5 : 1);
    }
  }
}

Sweep Sweeper::make() && {
  if (!find_regime()) return std::move(sweep_);
  run_lines(AxisKind::numerics);
  run_lines(AxisKind::statistics);
  find_reference();
  if (sweep_.reference.kind.empty() && sweep_.outcome == "done") refuse("no trustworthy reference");
  if (sweep_.outcome == "done") {
    for (Row& row : sweep_.rows) measure_errors(sweep_, row);
    fit_laws();
    run_front();
  }
  run_solver();
  run_lines(AxisKind::model);
  run_inputs();
  run_lines(AxisKind::machine);
  if (sweep_.options.clock == "cpu") repeat_for_time();
  for (Row& row : sweep_.rows) measure_errors(sweep_, row);
  rank(sweep_);
  compare_predictions();
  attribute();
  for (const Row& row : sweep_.rows)
    if (row.kind == RowKind::candidate && row.done() && sweep_.regime == "chaotic" && !row.measured.too_short.empty())
      sweep_.warnings.push_back(fmt::format("{}: window too short for {}: fewer than 30 autocorrelation times",
                                            settings_text(sweep_, row), row.measured.too_short));
  return std::move(sweep_);
}

}  // namespace polybed::multiscale
