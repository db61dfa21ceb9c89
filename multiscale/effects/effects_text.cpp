#include "multiscale/effects/effects_text.hpp"
#include "core/case/laws.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace polybed::multiscale {

namespace {

using State = relevance::EffectRow::State;
using Kind = relevance::EffectRow::Kind;

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.2g}", *value) : "-"; }

std::string value_text(const relevance::EffectRow& row) {
  if (row.band && row.band->most == row.value) return fmt::format("{:.2g}..{:.2g}", row.band->least, row.band->most);
  return number(row.value);
}

std::string state_text(const relevance::EffectRow& row) {
  if (row.state == State::unknown) return "unknown";
  if (row.state == State::off) return row.kind == Kind::unmodelled ? "no" : "off";
  return row.kind == Kind::unmodelled || !row.not_built.empty() ? "MISSING" : "on";
}

/// What the case itself says of a role; empty for what is none.
std::string case_text(const core::Scene& scene, const relevance::EffectRow& row) {
  if (row.kind != Kind::role || !row.not_built.empty()) return "";
  const std::string law = core::law_of(scene, row.effect);
  return core::is_off(law) ? "off" : law;
}

std::string reason_text(const relevance::EffectRow& row) {
  std::string text = row.reason;
  if (!row.where.empty()) text += " (" + row.where + ")";
  if (row.state == State::on && !row.not_built.empty()) text += "; called for, but not built: " + row.not_built;
  return text;
}

std::string line_of(const core::Scene& scene, const relevance::EffectRow& row) {
  return fmt::format("{:20} {:15} {:8} {:>14} {:>8} {:>8}  {:7} {:14} {}\n", row.effect, row.model, row.models,
                     value_text(row), row.threshold ? (row.below ? "<" : ">") + number(row.threshold) : "-",
                     number(row.neglected), state_text(row), case_text(scene, row),
                     (row.has_number() ? row.number + ": " : "") + reason_text(row));
}

}  // namespace

std::string effects_table(const core::Scene& scene, const relevance::Choice& choice) {
  std::string text = fmt::format("{:20} {:15} {:8} {:>14} {:>8} {:>8}  {:7} {:14} {}\n", "effect", "model", "acts in",
                                 "value", "on if", "left out", "choice", "this case", "number: reason");
  const Kind kinds[] = {Kind::role, Kind::condition, Kind::unmodelled};
  for (const Kind kind : kinds) {
    if (kind == Kind::condition) text += "\nno roles:\n";
    if (kind == Kind::unmodelled) text += "\nnot modelled, estimated:\n";
    for (const relevance::EffectRow& row : choice.rows)
      if (row.kind == kind) text += line_of(scene, row);
  }
  text += fmt::format(
      "\nforces on particles left out by this choice sum to {:.2g} of the buoyant weight (promise {:.2g}, {}){}\n",
      choice.neglected_sum, choice.tolerance, core::name_of(scene.chooser.purpose),
      choice.neglected_sum > choice.tolerance ? ": more than promised, since what would be needed is not to be had"
                                              : "");
  const double two_fluid = relevance::neglected_sum(choice.rows, "tfm"),
               of_case = relevance::neglected_sum(choice.of_case, "tfm");
  text += fmt::format("by the two-fluid model, which has no law of any of them: {:.2g}{}\n", two_fluid,
                      two_fluid > choice.tolerance ? ": more than promised" : "");
  if (choice.sum_up_to > choice.tolerance)
    text += fmt::format(
        "in a run up to {:.2g}, where the fluid is sheared within a cell or impacts spin particles: a scale that "
        "switches nothing; polybed effects audit tells what a run met\n",
        choice.sum_up_to);
  if (!relevance::has_auto(scene))
    text += fmt::format("left out by the case as it stands: {:.2g}, by the two-fluid model {:.2g}\n", choice.case_sum,
                        of_case);
  return text;
}

namespace {

core::Json finite_or_null(const std::optional<double>& value) {
  return core::or_null(value && std::isfinite(*value) ? value : std::nullopt);
}

core::Json json_of(const core::Scene& scene, const relevance::EffectRow& row) {
  core::Json json = {{"effect", row.effect},
                     {"model", row.model},
                     {"on", row.state == State::unknown ? core::Json() : core::Json(row.state == State::on)},
                     {"number", row.number},
                     {"value", finite_or_null(row.value)},
                     {"threshold", finite_or_null(row.threshold)},
                     {"neglected_bound", finite_or_null(row.neglected)},
                     {"reason", reason_text(row)},
                     {"models", row.models},
                     {"below", row.below},
                     {"kind", row.kind == Kind::role        ? "role"
                              : row.kind == Kind::condition ? "condition"
                                                            : "unmodelled"}};
  if (row.up_to) json["up_to"] = *row.up_to;
  json["built"] = row.not_built.empty() && row.kind != Kind::unmodelled;
  json["in_case"] = case_text(scene, row);
  if (row.band) json["band"] = {row.band->least, row.band->most};
  core::Json& zones = json["zones"] = core::Json::object();
  for (const auto& [zone, value] : row.zones) zones[zone] = finite_or_null(value);
  return json;
}

}  // namespace

void write_effects(core::Json& json, const core::Scene& scene, const relevance::Choice& choice) {
  core::Json& rows = json["effects"] = core::Json::array();
  for (const relevance::EffectRow& row : choice.rows) rows.push_back(json_of(scene, row));
  json["neglected_sum"] = choice.neglected_sum;
  json["neglected_up_to"] = choice.sum_up_to;
  json["neglected_sum_of_case"] = choice.case_sum;
  const auto by_model = [](const std::vector<relevance::EffectRow>& of) -> core::Json {
    return {{"tfm", relevance::neglected_sum(of, "tfm")}, {"dem", relevance::neglected_sum(of, "dem")}};
  };
  json["neglected_sum_by_model"] = by_model(choice.rows);
  json["neglected_sum_of_case_by_model"] = by_model(choice.of_case);
  json["tolerance"] = choice.tolerance;
  json["purpose"] = core::name_of(scene.chooser.purpose);
}

}  // namespace polybed::multiscale
