// The front that the lines predict, which is then run; and what the error is made of.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <thread>

#include "core/numerics/random.hpp"
#include "multiscale/cost/judge.hpp"
#include "multiscale/cost/sweeper.hpp"
#include "multiscale/cost/timing.hpp"

namespace polybed::multiscale {

namespace {

constexpr std::size_t most_front = 6;   ///< runs of the predicted front
constexpr std::size_t least_times = 3;  ///< of which quartiles say how far they scatter

/// All settings of the numerical axes, the others as in the centre.
std::vector<Settings> factorial(const std::vector<Axis>& axes, const Settings& centre) {
  std::vector<Settings> all{centre};
  for (const Axis& a : axes) {
    if (a.kind != AxisKind::numerics) continue;
    std::vector<Settings> more;
    for (const Settings& s : all)
      for (std::size_t level = 0; level < a.levels.size(); ++level) {
        more.push_back(s);
        more.back()[a.name] = level;
      }
    all = std::move(more);
  }
  return all;
}

double load_of_machine() {
  double load[1] = {0};
  return ::getloadavg(load, 1) == 1 ? load[0] : 0;
}

}  // namespace

/// Error and cost along the lines as power laws of the tolerance and of the spacing.
void Sweeper::fit_laws() {
  const auto fit = [&](const char* name, std::optional<PowerLaw>& error, std::optional<PowerLaw>& cost) {
    const Axis* a = axis(name);
    if (a == nullptr) return;
    std::vector<double> x, errors, costs;
    for (std::size_t level = 0; level < a->levels.size(); ++level)
      if (const auto n = find(order_of(centre_with(name, level)), RowKind::candidate); n && sweep_.rows[*n].done()) {
        x.push_back(a->levels[level].value);
        errors.push_back(line_error(name, level));
        costs.push_back(sweep_.rows[*n].rate);
      }
    error = fit_power_law(x, errors);
    cost = fit_power_law(x, costs);
  };
  fit("rtol", sweep_.error_of_rtol, sweep_.cost_of_rtol);
  fit("grid", sweep_.error_of_grid, sweep_.cost_of_grid);
}

/// What one axis alone contributes at a level: on the line of grids the distance from the reference; on another line,
/// which lies on the coarsest grid, the distance from its own tightest run; infinite where the line was not run.
double Sweeper::line_error(const std::string& name, std::size_t level) const {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const auto n = find(order_of(centre_with(name, level)), RowKind::candidate);
  if (!n || !sweep_.rows[*n].done() || !sweep_.rows[*n].outcome.invariants_held) return unknown;
  const Row& row = sweep_.rows[*n];
  if (name == "grid") {
    const auto found = row.quantities.find(sweep_.ranking());
    return found == row.quantities.end() ? unknown : found->second.error;
  }
  for (const Row& reference : sweep_.rows)
    if (reference.kind == RowKind::reference && reference.done() && sweep_.regime == "steady")
      return distance_of(sweep_, row, reference).value_or(unknown);
  const Axis* a = axis(name);
  for (std::size_t finest = a->levels.size(); finest-- > 0;)
    if (const auto f = find(order_of(centre_with(name, finest)), RowKind::candidate); f && sweep_.rows[*f].done())
      return distance_of(sweep_, row, sweep_.rows[*f]).value_or(unknown);
  return unknown;
}

double Sweeper::line_cost(const std::string& name, std::size_t level) const {
  const auto n = find(order_of(centre_with(name, level)), RowKind::candidate);
  const double centre = sweep_.rows[centre_row_].rate;
  return n && sweep_.rows[*n].done() && centre > 0 ? sweep_.rows[*n].rate / centre : 1;
}

/// Errors of the axes add by their squares, costs by their ratios; the front of that is run, nearest the target first.
void Sweeper::run_front() {
  std::vector<Settings> all = factorial(sweep_.axes, centre_);
  std::vector<Priced> points;
  for (const Settings& settings : all) {
    double square = 0, cost = sweep_.rows[centre_row_].rate;
    for (const Axis& a : sweep_.axes) {
      if (a.kind != AxisKind::numerics) continue;
      square += std::pow(line_error(a.name, settings.at(a.name)), 2);
      cost *= line_cost(a.name, settings.at(a.name));
    }
    points.push_back({std::sqrt(square), cost});
  }
  std::vector<std::size_t> front = pareto_front(points);
  std::erase_if(front, [&](std::size_t n) { return !std::isfinite(points[n].error); });
  std::stable_sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
    const auto far = [&](std::size_t n) {
      return std::abs(std::log(std::max(points[n].error, 1e-12) / sweep_.options.target));
    };
    return far(a) < far(b);
  });
  if (front.size() > most_front) front.resize(most_front);
  for (const std::size_t n : front) {
    Row row{.settings = all[n], .order = order_of(all[n])};
    row.predicted = points[n];
    run(std::move(row));
  }
}

/// Median, over the front that was run, of how far the additive model was off: of settings that differ from the centre
/// on more than one axis, as those on a line are not predicted but known.
void Sweeper::compare_predictions() {
  std::vector<double> off;
  const auto floor = sweep_.reference.floor.find(sweep_.ranking());
  for (const Row& row : sweep_.rows) {
    const auto q = row.quantities.find(sweep_.ranking());
    int changed = 0;
    for (const auto& [name, level] : row.settings) changed += level != centre_.at(name) ? 1 : 0;
    if (!row.predicted || !row.done() || changed < 2 || q == row.quantities.end()) continue;
    const double least = floor == sweep_.reference.floor.end() ? 0 : floor->second;
    if (q->second.error > least && q->second.error > 0)
      off.push_back(std::abs(row.predicted->error - q->second.error) / q->second.error);
  }
  if (!off.empty()) sweep_.additive_off = timing_of(off).median;
}

/// Candidates again, in random order, for the clock of CPU time; the first of each is the warm-up.
void Sweeper::repeat_for_time() {
  std::vector<std::pair<std::size_t, int>> turns;
  for (std::size_t n = 0; n < sweep_.rows.size(); ++n)
    if (sweep_.rows[n].kind == RowKind::candidate && sweep_.rows[n].done())
      for (int again = 1; again <= sweep_.options.repeat; ++again) turns.emplace_back(n, again);
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < turns.size(); ++k) order.emplace_back(core::uniform(sweep_.options.seed, 0, k), k);
  std::sort(order.begin(), order.end());
  for (Row& row : sweep_.rows)
    if (row.kind == RowKind::candidate) row.cpu.clear();
  const double load = load_of_machine();
  for (const auto& [number, k] : order) {
    Row& row = sweep_.rows[turns[k].first];
    const RunOutcome outcome = runner_.run(row.order, left(), turns[k].second);
    if (outcome.done()) row.cpu.push_back(outcome.cpu);
  }
  for (Row& row : sweep_.rows) {
    if (row.kind != RowKind::candidate || !row.done()) continue;
    if (row.cpu.size() < least_times && sweep_.outcome == "done")
      refuse(fmt::format("timings cannot be judged: {} of {} repetitions were done within the budget", row.cpu.size(),
                         sweep_.options.repeat));
    if (row.cpu.empty()) continue;
    const Timing timing = timing_of(row.cpu);
    row.rate = timing.median / row.outcome.simulated;
    const auto noisy = too_noisy(timing, load, double(std::thread::hardware_concurrency()));
    if (noisy && sweep_.outcome == "done") refuse(*noisy);
  }
}

/// The linear solver's tolerance a hundredth, or the particles' coupling to the fluid eight times as often.
void Sweeper::run_solver() {
  Row row{.kind = RowKind::solver, .settings = centre_, .order = order_of(centre_)};
  if (sweep_.options.model == "tfm") {
    const double given = scene_.tfm.pressure_tolerance.value_or(std::min(1e-4, 0.1 * scene_.tfm.rtol));
    row.note = "pressure to a hundredth";
    row.order.overrides.push_back(fmt::format("tfm.pressure_tolerance={:.17g}", given / 100));
  } else {
    if (!scene_.fluid.present()) return;
    row.note = "fluid 8 times as often";
    row.order.overrides.push_back(fmt::format("dem.fluid_every={}", std::max(1, scene_.dem.fluid_every / 8)));
  }
  run(std::move(row));
}

/// The case with one of its data changed by what they are usually known to.
void Sweeper::run_inputs() {
  const auto input = [&](const std::string& note, const std::string& override) {
    Row row{.kind = RowKind::input, .settings = centre_, .note = note, .order = order_of(centre_)};
    row.order.overrides.push_back(override);
    run(std::move(row));
  };
  const auto key = [](const std::string& name, double value) { return fmt::format("{}={:.17g}", name, value); };
  if (scene_.fluid.temperature)
    input("temperature + 1 K", fmt::format("fluid.temperature={:.17g} K", *scene_.fluid.temperature + 1));
  else if (scene_.fluid.viscosity)
    input("viscosity - 2.5 % (1 K of water)", key("fluid.viscosity", 0.975 * *scene_.fluid.viscosity));
  if (!scene_.size_classes.empty()) return;
  for (const core::Species& s : scene_.species) {
    input("diameter of " + s.name + " + 1 %", key("species." + s.name + ".diameter", 1.01 * s.diameter));
    input("density of " + s.name + " + 1 %", key("species." + s.name + ".density", 1.01 * s.density));
  }
}

/// The largest distance from the centre on the lines of these axes.
void Sweeper::attribute_axis(const std::string& name, const std::vector<std::string>& axes) {
  Share share{name, std::nullopt, ""};
  for (const Row& row : sweep_.rows) {
    if (row.kind != RowKind::model) continue;
    for (const std::string& a : axes) {
      if (axis(a) == nullptr || row.settings.at(a) == centre_.at(a)) continue;
      const auto d = distance_of(sweep_, row, sweep_.rows[centre_row_]);
      if (!d || (share.value && *d <= *share.value)) continue;
      share.value = d;
      share.note = axis(a)->levels[row.settings.at(a)].label;
    }
  }
  if (!share.value) share = not_run(name, axes);
  sweep_.attribution.push_back(share);
}

Share Sweeper::not_run(const std::string& row, const std::vector<std::string>& axes) const {
  Share share{row, std::nullopt, "not run"};
  for (const std::string& name : acting_axes(scene_, sweep_.options.model))
    if (std::find(axes.begin(), axes.end(), name) != axes.end()) share.axes.push_back(name);
  return share;
}

void Sweeper::attribute() {
  const auto of_line = [&](const std::string& row, const std::vector<std::string>& names) {
    Share share = not_run(row, names);
    for (const std::string& name : names)
      if (axis(name) != nullptr && sweep_.outcome == "done")
        if (const double e = line_error(name, axis(name)->given); std::isfinite(e)) {
          share.value = std::max(e, share.value.value_or(0));
          share.note = name + " " + axis(name)->levels[axis(name)->given].label;
          share.axes.clear();
        }
    sweep_.attribution.push_back(share);
  };
  of_line("time integration", {"rtol", "steps"});
  of_line("space", {"grid"});
  const Row& centre = sweep_.rows[centre_row_];
  Share solver{"solver and coupling tolerance", std::nullopt, "not run"}, statistics{"statistics", std::nullopt, ""};
  for (const Row& row : sweep_.rows) {
    if (row.kind == RowKind::solver)
      if (const auto d = distance_of(sweep_, row, centre)) solver = {solver.row, d, row.note};
    if (row.kind == RowKind::input) sweep_.inputs.push_back({row.note, distance_of(sweep_, row, centre), ""});
  }
  if (const auto m = centre.measured.values.find(sweep_.ranking()); m != centre.measured.values.end())
    if (m->second.error) statistics.value = *m->second.error / scale_of(sweep_, sweep_.ranking());
  statistics.note = "95 % interval of one window";
  if (sweep_.regime == "steady")
    statistics = {statistics.row, std::nullopt, "steady: nothing fluctuates, the mean is the same every time"};
  sweep_.attribution.push_back(solver);
  sweep_.attribution.push_back(statistics);
  attribute_axis("closure spread", {"drag", "effects", "stiffness", "kernel"});
  attribute_axis("level", {"level"});
}

}  // namespace polybed::multiscale
