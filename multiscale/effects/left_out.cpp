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

constexpr std::size_t most_named = 4;  // on the screen; the record lists all

/// Why a run neglects a row; empty if it does not, or if the scene does not contain it.
std::string why_left_out(const relevance::EffectRow& row, const std::string& model) {
  if (row.kind == Kind::condition) return row.state == State::off && row.bound ? "off in the case" : "";
  if (row.kind == Kind::unmodelled) {
    const bool below = row.threshold && row.state == State::off && row.value;
    return row.bound == 0.0 || below ? "" : "not modelled";
  }
  if (!relevance::is_left_out(row, model)) return "";
  if (row.models.find(model) == std::string::npos) return "no law of it in this model";
  return row.state == State::off ? "off in the case" : row.state == State::undecided ? "undecided" : row.not_built;
}

const char* name_of(Kind kind) {
  return kind == Kind::role ? "role" : kind == Kind::condition ? "condition" : "unmodelled";
}

using relevance::two_digits;

std::string with_bound(const LeftOutEffect& one) {
  const bool by_band = one.row.band && one.row.band->most == *one.bound;
  return fmt::format("{} {}{}", one.row.effect, by_band ? two_digits(one.row.band->least) + " to " : "",
                     two_digits(*one.bound));
}

/// The effect with its share of the weight; for uncertain effects a range.
std::string with_share(const LeftOutEffect& one) {
  const bool by_band = one.row.band && one.row.band->most == *one.bound;
  return fmt::format("{} {}{}", one.row.effect, by_band ? share_of_weight(one.row.band->least) + " to " : "",
                     share_of_weight(*one.bound));
}

bool is_among(const std::vector<LeftOutEffect>& effects, const std::string& effect) {
  return std::any_of(effects.begin(), effects.end(), [&](const auto& one) { return one.row.effect == effect; });
}

/// The error of a law in any model: it ignores neighbours in a bed.
std::string wrong_drag_of(const core::Scene& scene, const relevance::Choice& choice) {
  const std::string law = scene.drag().name;
  const relevance::EffectRow* drag = relevance::find_row(choice.rows, "drag");
  return drag != nullptr && drag->model != law && relevance::ignores_neighbours(law) ? drag->reason : "";
}

/// The largest first; those beyond the number listed as a count.
std::string largest_of(std::vector<LeftOutEffect> effects) {
  std::stable_sort(effects.begin(), effects.end(), [](const auto& a, const auto& b) { return *a.bound > *b.bound; });
  std::vector<std::string> named;
  for (std::size_t n = 0; n < std::min(effects.size(), most_named); ++n) named.push_back(with_bound(effects[n]));
  std::string text = fmt::format("{}", fmt::join(named, ", "));
  if (effects.size() > most_named) text += fmt::format(" and {} smaller", effects.size() - most_named);
  return text;
}

enum class Remedy { none, add, no_law, not_built, try_it };

/// The remedy for a neglected effect that is significant in a sum beyond the tolerance.
Remedy remedy_of(const LeftOut& left_out, const LeftOutEffect& one) {
  constexpr double little = 0.1;  // of the tolerance: negligible in the sum
  const bool counts = one.row.summed || one.row.share_off;
  if (!(left_out.sum > left_out.promise) || !counts || !(one.bound.value_or(0) > little * left_out.promise))
    return Remedy::none;
  const bool open = one.row.band && one.row.band->most == *one.bound && one.row.band->least <= left_out.promise;
  if (is_among(left_out.called_for, one.row.effect)) return Remedy::add;
  if (one.row.models.find(left_out.model) == std::string::npos) return Remedy::no_law;
  if (!one.row.not_built.empty()) return Remedy::not_built;
  return open ? Remedy::try_it : Remedy::none;
}

std::string sum_text(const LeftOut& left_out) {
  const std::map<std::string, std::string> names{{"tfm", "two-fluid model"}, {"dem", "particle model"}};
  std::string text = fmt::format("left out of the {}: forces of {} of the weight (promise {:.2g}{})",
                                 names.at(left_out.model), two_digits(left_out.sum), left_out.promise,
                                 left_out.sum > left_out.promise ? ": more than promised" : "");
  if (left_out.up_to > std::max(left_out.sum, left_out.promise))
    text += fmt::format(", in a run up to {}", two_digits(left_out.up_to));
  return text;
}

bool matters(const LeftOut& left_out) { return left_out.least > left_out.promise; }
bool may_matter(const LeftOut& left_out) { return left_out.sum > left_out.promise; }

/// "4.2 %", or "0.4 % to 4.2 %"; a sum that rounds to what is allowed has a third digit.
std::string share_text(const LeftOut& left_out) {
  const std::string least = share_of_weight(left_out.least), most = share_of_weight(left_out.sum);
  const bool alike = most == share_of_weight(left_out.promise) && may_matter(left_out);
  const std::string end = alike ? fmt::format("{:.3g} %", 100 * left_out.sum) : most;
  return least == most ? end : least + " to " + end;
}

/// What a run met of it, and with the bounds of what its monitor cannot evaluate.
std::string met_text(const ForcesMet& met, const LeftOut& left_out) {
  double all = met.share;
  for (const LeftOutEffect& one : left_out.effects)
    if ((one.row.summed || one.row.share_off) && !std::count(met.effects.begin(), met.effects.end(), one.row.effect))
      all += one.bound.value_or(0);
  return fmt::format("; in the run {} of {}, with the rest {}: {}", fmt::join(met.effects, ", "),
                     share_of_weight(met.share), share_of_weight(all),
                     all > left_out.promise ? "matters" : "does not matter");
}

}  // namespace

std::string share_of_weight(double bound) { return bound > 1 ? "over 100 %" : relevance::percent(bound); }

LeftOut left_out(const core::Scene& scene, const std::string& model) {
  const relevance::Choice choice = choose(scene);
  LeftOut all;
  all.model = model;
  all.purpose = core::name_of(scene.chooser.purpose);
  all.promise = choice.tolerance;
  all.sum = relevance::neglected_sum(choice.of_case, model);
  all.least = relevance::neglected_certainly(choice.of_case, model);
  all.up_to = relevance::neglected_up_to(choice.of_case, model);
  for (const relevance::EffectRow& row : choice.of_case)
    if (const std::string why = why_left_out(row, model); !why.empty())
      all.effects.push_back({row, why, row.summed ? row.bound : row.share_off ? row.share_off : row.bound});
  for (const LeftOutEffect& one : all.effects) {
    const relevance::EffectRow* free = relevance::find_row(choice.rows, one.row.effect);
    const bool wanted = one.row.kind == Kind::role && free != nullptr && free->state == State::on && !free->choice;
    if (wanted && free->not_built.empty() && one.row.models.find(model) != std::string::npos)
      all.called_for.push_back(one);
  }
  std::stable_sort(all.called_for.begin(), all.called_for.end(),
                   [](const auto& a, const auto& b) { return a.bound.value_or(0) > b.bound.value_or(0); });
  all.wrong_drag = wrong_drag_of(scene, choice);
  return all;
}

std::vector<std::string> remedies(const LeftOut& left_out) {
  if (!(left_out.sum > left_out.promise)) return {};
  std::vector<LeftOutEffect> effects = left_out.effects;
  std::stable_sort(effects.begin(), effects.end(),
                   [](const auto& a, const auto& b) { return a.bound.value_or(0) > b.bound.value_or(0); });
  std::map<Remedy, std::vector<std::string>> by_remedy;
  for (const LeftOutEffect& one : effects) {
    const Remedy remedy = remedy_of(left_out, one);
    by_remedy[remedy].push_back(with_share(one) + (remedy == Remedy::not_built ? " (" + one.row.not_built + ")" : ""));
  }
  std::vector<std::string> lines;
  const auto tell = [&](const std::string& front, Remedy remedy) {
    if (const auto& named = by_remedy[remedy]; !named.empty())
      lines.push_back(front + fmt::format("{}", fmt::join(named, ", ")));
  };
  tell("switch on ", Remedy::add);
  const std::map<std::string, std::string> without{{"tfm", "no law in the two-fluid model, but in polybed dem: "},
                                                   {"dem", "no law in the particle model: "}};
  tell(without.at(left_out.model), Remedy::no_law);
  tell("a run cannot have ", Remedy::not_built);
  tell("undecided, try with and without: ", Remedy::try_it);
  return lines;
}

std::string left_out_text(const LeftOut& left_out, const std::optional<ForcesMet>& met) {
  const std::string allowed = relevance::percent(left_out.promise) + " allowed: ";
  std::string text = "forces of " + share_text(left_out) + " of the weight, ";
  text += matters(left_out)      ? "above the " + allowed + "matters"
          : may_matter(left_out) ? allowed + "may matter"
                                 : "within the " + allowed + "does not matter";
  for (const std::string& line : remedies(left_out)) text += "; " + line;
  return met ? text + met_text(*met, left_out) : text;
}

std::vector<std::string> to_try(const LeftOut& left_out) {
  std::vector<std::string> roles;
  for (const LeftOutEffect& one : left_out.effects)
    if (remedy_of(left_out, one) == Remedy::try_it) roles.push_back(one.row.effect);
  return roles;
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
  json["neglected"] = {{"called_for", called_for},
                       {"sum", left_out.sum},
                       {"least", left_out.least},
                       {"promise", left_out.promise},
                       {"up_to", left_out.up_to},
                       {"purpose", left_out.purpose},
                       {"rows", rows}};
}

std::string called_for_line(const LeftOut& left_out) {
  const std::string drag = left_out.wrong_drag.empty() ? "" : "drag: " + left_out.wrong_drag;
  if (left_out.called_for.empty()) return drag;
  std::vector<std::string> named;
  for (const LeftOutEffect& one : left_out.called_for) {
    const bool is_share = one.row.summed || one.row.share_off;
    named.push_back(!(one.bound.value_or(0) > 0) ? one.row.effect : is_share ? with_share(one) : with_bound(one));
  }
  return fmt::format("{}{}off in the case, but needed: {}; see polybed effects", drag, drag.empty() ? "" : "; ",
                     fmt::join(named, ", "));
}

std::string unsuited_line(const core::Scene& scene) {
  const std::string law = scene.drag().name;
  if (core::is_off(law) || relevance::ignores_neighbours(law)) return "";  // called_for_line covers the latter
  const relevance::Survey survey = relevance::survey(scene);
  const std::string why = relevance::unsuited(law, survey.drag_scene);
  if (why.empty() || !survey.has_fluid) return "";
  const relevance::AdvisedDrag better = relevance::advised_drag(scene, survey.drag_scene);
  return fmt::format("drag: {}; take {}{}", why, better.law,
                     core::is_law(better.partition) ? " with partition = \"" + better.partition + "\"" : "");
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
