#include "multiscale/effects/left_out.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/case/scene.hpp"
#include "multiscale/roles.hpp"

namespace polybed::multiscale {

namespace {

using State = relevance::EffectRow::State;
using Kind = relevance::EffectRow::Kind;

constexpr std::size_t most_named = 4;  // on the screen; the record has all

/// Why a run does without a row; empty if it does not, or if the scene has nothing of it.
std::string why_left_out(const relevance::EffectRow& row, const std::string& model) {
  if (row.kind == Kind::condition) return row.state == State::off && row.bound ? "off in the case" : "";
  if (row.kind == Kind::unmodelled) {
    const bool below = row.threshold && row.state == State::off && row.value;
    return row.bound == 0.0 || (below && !row.is_force) ? "" : "not modelled";
  }
  if (!relevance::is_left_out(row, model)) return "";
  if (row.models.find(model) == std::string::npos) return "no law of it in this model";
  return row.state == State::off ? "off in the case" : row.not_built;
}

const char* name_of(Kind kind) {
  return kind == Kind::role ? "role" : kind == Kind::condition ? "condition" : "unmodelled";
}

std::string with_bound(const LeftOutEffect& one) {
  std::string text = fmt::format("{} {:.2g}", one.row.effect, *one.bound);
  if (one.row.band && one.row.band->most > *one.bound)
    text += fmt::format(" (uncertain, to {:.2g})", one.row.band->most);
  return text;
}

/// The largest first, those beyond the most that are named as a count.
std::string largest_of(std::vector<LeftOutEffect> effects) {
  std::stable_sort(effects.begin(), effects.end(), [](const auto& a, const auto& b) { return *a.bound > *b.bound; });
  std::vector<std::string> named;
  for (std::size_t n = 0; n < std::min(effects.size(), most_named); ++n) named.push_back(with_bound(effects[n]));
  std::string text = fmt::format("{}", fmt::join(named, ", "));
  if (effects.size() > most_named) text += fmt::format(" and {} smaller", effects.size() - most_named);
  return text;
}

std::string sum_text(const LeftOut& left_out) {
  const std::map<std::string, std::string> names{{"tfm", "two-fluid model"}, {"dem", "particle model"}};
  std::string text =
      fmt::format("left out of the {}: forces of {:.2g} of the weight (promise {:.2g}{})", names.at(left_out.model),
                  left_out.sum, left_out.promise, left_out.sum > left_out.promise ? ": more than promised" : "");
  if (left_out.up_to > std::max(left_out.sum, left_out.promise))
    text += fmt::format(", in a run up to {:.2g}", left_out.up_to);
  return text;
}

}  // namespace

LeftOut left_out(const core::Scene& scene, const std::string& model) {
  const relevance::Choice choice = choose(scene);
  LeftOut all;
  all.model = model;
  all.purpose = core::name_of(scene.chooser.purpose);
  all.promise = choice.tolerance;
  all.sum = relevance::neglected_sum(choice.of_case, model);
  all.up_to = relevance::neglected_up_to(choice.of_case, model);
  for (const relevance::EffectRow& row : choice.of_case)
    if (const std::string why = why_left_out(row, model); !why.empty())
      all.effects.push_back({row, why, row.summed ? row.bound : row.share_off ? row.share_off : row.bound});
  for (const LeftOutEffect& one : all.effects) {
    const relevance::EffectRow* free = relevance::find_row(choice.rows, one.row.effect);
    const bool wanted = one.row.kind == Kind::role && free != nullptr && free->state == State::on;
    if (wanted && free->not_built.empty() && one.row.models.find(model) != std::string::npos)
      all.called_for.push_back(one);
  }
  std::stable_sort(all.called_for.begin(), all.called_for.end(),
                   [](const auto& a, const auto& b) { return a.bound.value_or(0) > b.bound.value_or(0); });
  return all;
}

void write_left_out(core::Json& json, const LeftOut& left_out) {
  core::Json rows = core::Json::array();
  for (const LeftOutEffect& one : left_out.effects) {
    core::Json& row = rows.emplace_back(core::Json{{"effect", one.row.effect},
                                                   {"kind", name_of(one.row.kind)},
                                                   {"why", one.why},
                                                   {"number", one.row.number},
                                                   {"bound", core::or_null(one.bound)},
                                                   {"summed", one.row.summed || one.row.share_off}});
    if (one.row.band) row["band"] = {one.row.band->least, one.row.band->most};
    if (one.row.up_to) row["up_to"] = *one.row.up_to;
    row["reason"] = one.row.reason;
  }
  core::Json called_for = core::Json::array();
  for (const LeftOutEffect& one : left_out.called_for) called_for.push_back(one.row.effect);
  json["neglected"] = {{"called_for", called_for}, {"sum", left_out.sum},         {"promise", left_out.promise},
                       {"up_to", left_out.up_to},  {"purpose", left_out.purpose}, {"rows", rows}};
}

std::string called_for_line(const LeftOut& left_out) {
  if (left_out.called_for.empty()) return "";
  std::vector<std::string> named;
  for (const LeftOutEffect& one : left_out.called_for) named.push_back(one.bound ? with_bound(one) : one.row.effect);
  return fmt::format("off in the case, but needed: {}; see polybed effects", fmt::join(named, ", "));
}

std::string chosen_line(const core::Scene& scene) {
  if (scene.chooser.chosen.empty()) return "";
  std::vector<std::string> on;
  for (const std::string& role : scene.chooser.chosen)
    if (core::acts(scene, role)) on.push_back(fmt::format("{} = {}", role, core::law_of(scene, role)));
  return fmt::format("effects that the case does not name: {}{} of {} off, chosen by polybed effects",
                     on.empty() ? "" : fmt::format("{}; ", fmt::join(on, ", ")),
                     scene.chooser.chosen.size() - on.size(), scene.chooser.chosen.size());
}

std::vector<std::string> left_out_lines(const LeftOut& left_out) {
  std::vector<LeftOutEffect> forces, others;
  std::vector<std::string> unknown;
  for (const LeftOutEffect& one : left_out.effects) {
    if (!one.bound)
      unknown.push_back(one.row.effect);
    else if (*one.bound > 0)
      (one.row.summed || one.row.share_off ? forces : others).push_back(one);
  }
  std::vector<std::string> lines{sum_text(left_out) + (forces.empty() ? "" : ": " + largest_of(forces))};
  if (!others.empty()) lines.push_back("beside them, each by its own number (polybed effects): " + largest_of(others));
  if (!unknown.empty()) lines.push_back(fmt::format("bounds unknown: {}", fmt::join(unknown, ", ")));
  return lines;
}

}  // namespace polybed::multiscale
