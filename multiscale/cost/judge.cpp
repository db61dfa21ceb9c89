#include "multiscale/cost/judge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace polybed::multiscale {

namespace {

constexpr double floor_factor = 10;  ///< of the disagreement: cost.md, section 4

std::optional<double> value_of(const Row& row, const std::string& quantity) {
  const auto found = row.measured.values.find(quantity);
  return found == row.measured.values.end() ? std::nullopt : std::optional(found->second.mean);
}

double entry(const std::map<std::string, double>& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? 0 : found->second;
}

/// Error and interval of the ranking quantity; empty for what is not ranked.
const RowQuantity* ranked(const Sweep& sweep, const Row& row) {
  if (row.kind != RowKind::candidate || !row.done() || !row.outcome.invariants_held) return nullptr;
  const auto found = row.quantities.find(sweep.ranking());
  return found == row.quantities.end() ? nullptr : &found->second;
}

bool is_hollow(const Sweep& sweep, const RowQuantity& q) {
  const bool within = sweep.regime == "chaotic" && q.error_interval && q.error < *q.error_interval;
  return within || q.error < entry(sweep.reference.floor, sweep.ranking());
}

std::string unranked_status(const Row& row) {
  if (!row.done()) return row.outcome.state;
  if (!row.outcome.invariants_held) return "failed";
  return row.kind == RowKind::candidate || row.kind == RowKind::reference ? "hollow" : "model";
}

void recommend(Sweep& sweep) {
  std::optional<std::size_t> best;
  for (std::size_t n = 0; n < sweep.rows.size(); ++n) {
    const RowQuantity* q = ranked(sweep, sweep.rows[n]);
    if (q == nullptr || q->error + q->error_interval.value_or(0) > sweep.options.target) continue;
    // Below a floor that lies above the target nothing is known of the error.
    if (is_hollow(sweep, *q) && entry(sweep.reference.floor, sweep.ranking()) > sweep.options.target) continue;
    if (!best || sweep.rows[n].rate < sweep.rows[*best].rate) best = n;
  }
  if (best) sweep.recommendation = Recommendation{sweep.options.target, *best, false};
}

}  // namespace

bool carries(double disagreement, const std::vector<double>& errors, double target) {
  const double floor = floor_factor * disagreement;
  return floor <= target || std::any_of(errors.begin(), errors.end(), [&](double e) { return e >= floor; });
}

double scale_of(const Sweep& sweep, const std::string& quantity) {
  const auto info = std::find_if(sweep.quantities.begin(), sweep.quantities.end(),
                                 [&](const QuantityInfo& q) { return q.id == quantity; });
  if (info == sweep.quantities.end() || info->scale == Scale::share) return 1;
  const double value = std::abs(entry(sweep.reference.value, info->scale == Scale::length ? "bed_height" : quantity));
  return value > 0 ? value : 1;
}

void measure_errors(const Sweep& sweep, Row& row) {
  row.quantities.clear();
  if (!row.done()) return;
  const bool chaotic = sweep.regime == "chaotic";
  for (const auto& [id, mean] : row.measured.values) {
    if (!sweep.reference.value.contains(id)) continue;
    RowQuantity q{mean.mean, 0, mean.error, std::nullopt};
    const double scale = scale_of(sweep, id), band = entry(sweep.reference.band, id);
    q.error = std::abs(mean.mean - sweep.reference.value.at(id)) / scale;
    q.error_interval = chaotic ? std::hypot(mean.error.value_or(0), band * scale) / scale : band;
    row.quantities[id] = q;
  }
  if (sweep.reference.profile.slabs() == 0 || row.measured.profile.slabs() == 0) return;
  for (const auto& [id, value] : distances(row.measured.profile, sweep.reference.profile))
    row.quantities[id] = {value, value, std::nullopt, std::nullopt};
}

std::optional<double> distance_of(const Sweep& sweep, const Row& row, const Row& other) {
  const auto a = value_of(row, sweep.ranking()), b = value_of(other, sweep.ranking());
  if (!row.done() || !other.done() || !a || !b) return std::nullopt;
  return std::abs(*a - *b) / scale_of(sweep, sweep.ranking());
}

void rank(Sweep& sweep) {
  std::vector<Priced> points;
  std::vector<std::size_t> rows;
  for (std::size_t n = 0; n < sweep.rows.size(); ++n) {
    Row& row = sweep.rows[n];
    row.status = unranked_status(row);
    const RowQuantity* q = sweep.outcome == "done" ? ranked(sweep, row) : nullptr;
    if (q == nullptr || is_hollow(sweep, *q)) continue;
    points.push_back({q->error, row.rate});
    rows.push_back(n);
    row.status = "dominated";
  }
  for (const std::size_t n : pareto_front(points)) sweep.rows[rows[n]].status = "pareto";
  for (Row& row : sweep.rows)
    if (row.predicted && row.outcome.state == "not run") row.status = "predicted";
  if (sweep.outcome == "done") recommend(sweep);
}

std::string settings_text(const Sweep& sweep, const Row& row) {
  if (row.settings.empty()) return row.note;
  std::string text;
  for (const Axis& axis : sweep.axes) {
    const auto found = row.settings.find(axis.name);
    const std::size_t level = found == row.settings.end() ? axis.given : found->second;
    const bool numeric = axis.kind == AxisKind::numerics;
    if (!numeric && level == axis.given) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", axis.name, axis.levels[level].label);
  }
  if (row.note.empty()) return text.empty() ? "as given" : text;
  return text.empty() ? row.note : text + ", " + row.note;
}

namespace {

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

/// The row of the case as it is given.
const Row* given_row(const Sweep& sweep) {
  for (const Row& row : sweep.rows) {
    if (row.kind != RowKind::candidate || !row.note.empty()) continue;
    const bool same = std::all_of(sweep.axes.begin(), sweep.axes.end(), [&](const Axis& axis) {
      const auto found = row.settings.find(axis.name);
      return found == row.settings.end() || found->second == axis.given;
    });
    if (same) return &row;
  }
  return nullptr;
}

std::string recommendation_text(const Sweep& sweep) {
  const std::string& id = sweep.ranking();
  if (!sweep.recommendation)
    return fmt::format("No setting that was run has an error of {} within {}, interval included.", id,
                       percent(sweep.options.target));
  const Row& row = sweep.rows[sweep.recommendation->row];
  const RowQuantity& q = row.quantities.at(id);
  std::string text = fmt::format("For {} of {} take {}: error {} +- {}, {:.3g} s for a simulated second ({})",
                                 percent(sweep.options.target), id, settings_text(sweep, row), percent(q.error),
                                 percent(q.error_interval.value_or(0)), row.rate, sweep.options.clock);
  const Row* given = given_row(sweep);
  if (given != nullptr && given->done() && given != &row && given->rate > 0)
    text += fmt::format("; the case as given takes {:.3g} times that", given->rate / row.rate);
  return text + ".";
}

}  // namespace

std::vector<std::string> advice(const Sweep& sweep) {
  if (sweep.outcome != "done") return {fmt::format("Refused: {}.", sweep.reason)};
  std::vector<std::string> lines{recommendation_text(sweep)};
  const Share* largest = nullptr;
  std::vector<std::string> unknown, axes;
  for (const Share& share : sweep.attribution) {
    if (share.value && (largest == nullptr || *share.value > *largest->value)) largest = &share;
    if (!share.axes.empty()) unknown.push_back(share.row);
    axes.insert(axes.end(), share.axes.begin(), share.axes.end());
  }
  if (largest != nullptr && *largest->value > 0)
    lines.push_back(fmt::format("The largest row {} {} ({}){}.", unknown.empty() ? "is" : "of those measured is",
                                largest->row, percent(*largest->value),
                                unknown.empty() ? ": that is what to improve" : ""));
  if (!unknown.empty())
    lines.push_back(fmt::format("Not measured, so in none of these errors: {}. --axes {} measures them.",
                                fmt::join(unknown, ", "), fmt::join(axes, ",")));
  if (largest == nullptr || !(*largest->value > 0)) return lines;
  std::string loose;
  for (const Share& share : sweep.attribution)
    if (share.value && 10 * *share.value < *largest->value) loose += (loose.empty() ? "" : ", ") + share.row;
  if (!loose.empty()) lines.push_back(fmt::format("Ten times smaller, so to be loosened: {}.", loose));
  return lines;
}

}  // namespace polybed::multiscale
