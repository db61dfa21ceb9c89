#include <fmt/format.h>

#include <algorithm>

#include "relevance/choice.hpp"

namespace polybed::relevance {

namespace {

using State = EffectRow::State;
using Kind = EffectRow::Kind;

/// Whether the value itself is the top of a band whose lower end leaves the decision open.
bool is_uncertain(const EffectRow& row) {
  return row.band && row.band->most == row.value && !(row.threshold && row.band->least > *row.threshold);
}

/// A number without a power of ten.
std::string plain(double value) {
  constexpr double least = 1e-3;
  return value < least ? "less than 0.001" : two_digits(value);
}

/// A value of a row, as its phrase needs it.
std::string value_text(const EffectRow& row, double value) {
  constexpr double many = 10;  // as a share: "30 times"
  if (row.below) return plain(value);
  return value < many ? percent(value) + " of" : fmt::format("{:.0f} times", value);
}

/// The number of a row in words.
std::string in_words(const EffectRow& row, const std::string& value) {
  return row.phrase.empty() ? row.number : fmt::format(fmt::runtime(row.phrase), value);
}

std::string in_words(const EffectRow& row) { return in_words(row, value_text(row, *row.value)); }

std::string band_in_words(const EffectRow& row) {
  return in_words(row, fmt::format("{} to {}", percent(row.band->least), value_text(row, row.band->most)));
}

/// The limit that a value is compared with.
std::string limit_text(const EffectRow& row, bool beyond) {
  if (row.below) return fmt::format("{} {:.4g}", beyond ? "below" : "not below", *row.threshold);
  return fmt::format("{} the {} that may be left out", beyond ? "more than" : "within", percent(*row.threshold));
}

void decide_steady(EffectRow& row) {
  row.state = State::off;
  row.neglected = 0;
  row.reason = "no part in a steady mean";
  if (row.band || row.value)
    row.reason += "; while the flow changes, " + (row.band ? band_in_words(row) : in_words(row));
}

/// Values that a run can reach beyond the scales of the choice: reported, but without effect on the decision.
void tell_greatest(EffectRow& row) {
  if (row.up_to && row.threshold && row.state == State::off && *row.up_to > *row.threshold)
    row.reason += fmt::format("; in places of a run up to {}", percent(*row.up_to));
}

void decide_by_number(EffectRow& row) {
  if (!row.value || !row.threshold) {
    if (row.reason.empty()) row.reason = "nothing moves through a fluid";
    row.neglected = row.neglected.value_or(0);
    return;
  }
  const bool uncertain = is_uncertain(row);
  const bool beyond = row.below ? *row.value < *row.threshold : *row.value > *row.threshold;
  if (beyond && !uncertain) {
    row.state = State::on;
    row.reason = fmt::format("{}, {}", in_words(row), limit_text(row, true));
    return;
  }
  row.neglected = row.below ? 0 : row.upper_end();
  row.reason = fmt::format("{}, {}", in_words(row), limit_text(row, false));
  if (!row.band || row.band->most <= *row.threshold) return;
  row.state = State::undecided;
  row.reason = band_in_words(row) + ", too uncertain to decide";
}

/// Bound on the error of neglecting a row. The number of an effect that is always on only selects its law; it is a
/// bound only for a force.
std::optional<double> bound_of(const EffectRow& row, bool always, bool transient) {
  if (!row.value || row.below || (always && !row.summed)) return row.neglected;
  return row.of_acceleration && !transient ? 0 : row.upper_end();
}

/// Contribution of a neglected row to the sum: its bound for a force, else the missing share of drag or weight.
double counted(const EffectRow& row, const std::optional<double>& bound) {
  return row.summed ? bound.value_or(0) : row.share_off.value_or(0);
}

/// Contribution of a row to the sum that decides; an undecided row stays undecided and switches nothing on.
double certainly(const EffectRow& row) { return row.state == State::off ? counted(row, row.neglected) : 0; }

/// Whether a run neglects a row.
bool is_off(const EffectRow& row) { return row.state != State::on || !row.not_built.empty(); }

/// Sets a row as the case decides it.
void take_from_case(EffectRow& row, bool on, bool transient) {
  row.state = on ? State::on : State::off;
  const bool vanishes = row.of_acceleration && !transient;
  if (on)
    row.neglected.reset();
  else if (row.value && !row.below)
    row.neglected = vanishes ? 0 : row.upper_end();
  row.reason = fmt::format("{} in the case{}", on ? "on" : "off", row.reason.empty() ? "" : "; " + row.reason);
}

void limit_sum(std::vector<EffectRow>& rows, const DecisionRule& rule) {
  for (;;) {
    double sum = 0, held = 0;
    EffectRow* largest = nullptr;
    for (EffectRow& row : rows) {
      const double share = certainly(row);
      if (!(share > 0)) continue;
      const bool free = !rule.off.contains(row.effect) && row.not_built.empty();
      (free ? sum : held) += share;
      if (free && (largest == nullptr || share > certainly(*largest))) largest = &row;
    }
    // If the case itself neglects too much, no other effect compensates for it.
    if (held <= rule.tolerance) sum += held;
    if (sum <= rule.tolerance || largest == nullptr) return;
    largest->state = State::on;
    largest->neglected.reset();
    largest->reason =
        fmt::format("{}; little by itself, but all that is left out would be {}", in_words(*largest), percent(sum));
  }
}

}  // namespace

void decide(std::vector<EffectRow>& rows, const DecisionRule& rule) {
  for (EffectRow& row : rows) {
    const bool decided = row.state != State::off || (!row.reason.empty() && !row.value);
    const bool always = row.state == State::on;
    row.bound = row.neglected;
    if (row.kind != Kind::role && (row.kind == Kind::condition || !row.threshold || !row.value)) continue;
    if (!decided || (row.kind == Kind::unmodelled)) {
      const std::string said = row.kind == Kind::unmodelled ? row.reason : "";
      row.of_acceleration && !rule.transient ? decide_steady(row) : decide_by_number(row);
      if (!said.empty()) row.reason = said;
      if (row.kind == Kind::unmodelled) row.neglected.reset();
    }
    if (row.kind == Kind::role) row.bound = bound_of(row, always, rule.transient);
    if (row.kind != Kind::role) continue;
    if (!row.remark.empty()) row.reason += "; " + row.remark;
    if (rule.on.contains(row.effect)) take_from_case(row, true, rule.transient);
    if (rule.off.contains(row.effect)) take_from_case(row, false, rule.transient);
    if (row.state == State::on && !row.not_built.empty()) row.neglected = row.value;
  }
  limit_sum(rows, rule);
  for (EffectRow& row : rows)
    if (row.kind == Kind::role) tell_greatest(row);
}

double neglected_sum(const std::vector<EffectRow>& rows) {
  double sum = 0;
  for (const EffectRow& row : rows)
    if (is_off(row)) sum += counted(row, row.neglected);
  return sum;
}

bool is_left_out(const EffectRow& row, const std::string& model) {
  const bool has_law = row.models.find(model) != std::string::npos;
  return has_law ? is_off(row) : row.on_particles;
}

double neglected_sum(const std::vector<EffectRow>& rows, const std::string& model) {
  double sum = 0;
  for (const EffectRow& row : rows)
    if (is_left_out(row, model)) sum += counted(row, row.bound);
  return sum;
}

double neglected_certainly(const std::vector<EffectRow>& rows, const std::string& model) {
  double sum = 0;
  for (const EffectRow& row : rows) {
    if (!is_left_out(row, model)) continue;
    const double whole = counted(row, row.bound);
    sum += row.band ? std::min(whole, row.band->least) : whole;
  }
  return sum;
}

double neglected_up_to(const std::vector<EffectRow>& rows, const std::string& model) {
  double sum = 0;
  for (const EffectRow& row : rows)
    if (is_left_out(row, model)) sum += std::max(counted(row, row.bound), row.summed ? row.up_to.value_or(0) : 0);
  return sum;
}

double neglected_up_to(const std::vector<EffectRow>& rows) {
  double sum = 0;
  for (const EffectRow& row : rows)
    if (is_off(row)) sum += std::max(counted(row, row.neglected), row.summed ? row.up_to.value_or(0) : 0);
  return sum;
}

}  // namespace polybed::relevance
