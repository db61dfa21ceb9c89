// polybed effects: the effects that a scene needs, with the deciding number of each, without a run.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "core/output/json.hpp"
#include "core/print.hpp"
#include "multiscale/effects/left_out.hpp"
#include "multiscale/particle_requirements.hpp"
#include "multiscale/roles.hpp"
#include "multiscale/scene_rules.hpp"
#include "relevance/choice.hpp"

namespace polybed::app {

namespace {

using State = relevance::EffectRow::State;
using Kind = relevance::EffectRow::Kind;

std::string number(const std::optional<double>& value) { return value ? relevance::two_digits(*value) : "-"; }

std::string value_text(const relevance::EffectRow& row) {
  if (!row.band || (row.band->most != row.value && row.state != State::undecided)) return number(row.value);
  return number(row.band->least) + ".." + number(row.band->most);
}

std::string state_text(const relevance::EffectRow& row) {
  if (row.state == State::undecided) return "undecided";
  if (row.state == State::off) return row.kind == Kind::unmodelled ? "no" : "off";
  return row.kind == Kind::unmodelled || !row.not_built.empty() ? "MISSING" : "on";
}

/// The case's own setting for a role; empty for other rows.
std::string case_text(const core::Scene& scene, const relevance::EffectRow& row) {
  if (row.kind != Kind::role || !row.not_built.empty()) return "";
  const std::string law = core::law_of(scene, row.effect);
  return core::is_off(law) ? "off" : law;
}

/// Place of the greatest value, "fine, freeboard", in plain words.
std::string place_text(const std::string& where) {
  using relevance::Zone;
  constexpr std::array<std::pair<Zone, const char*>, 4> places{{{Zone::packed, "in the settled bed"},
                                                                {Zone::bulk, "in the bed"},
                                                                {Zone::wall, "at the walls"},
                                                                {Zone::freeboard, "above the bed"}}};
  for (const auto& [zone, words] : places)
    if (const std::string name = ", " + relevance::name_of(zone); where.ends_with(name))
      return where.substr(0, where.size() - name.size()) + " " + words;
  return where;
}

std::string reason_text(const relevance::EffectRow& row) {
  std::string text = row.reason;
  if (!row.where.empty()) text += " (" + place_text(row.where) + ")";
  if (row.state == State::on && !row.not_built.empty()) text += "; called for, but not built: " + row.not_built;
  return text;
}

constexpr std::size_t width = 100;  // columns

/// Wraps a text at `width` columns; each line begins with `front`.
std::string wrapped(const std::string& text, const std::string& front) {
  std::string lines, line = front;
  std::size_t from = 0;
  while (from < text.size()) {
    std::size_t end = std::min(text.find(' ', from), text.size());
    if (text.compare(end, 2, " %") == 0) end = std::min(text.find(' ', end + 1), text.size());  // stays with its number
    const std::string word = text.substr(from, end - from);
    if (line.size() > front.size() && line.size() + 1 + word.size() > width) {
      lines += line + "\n";
      line = front;
    }
    line += (line.size() > front.size() ? " " : "") + word;
    from = end + 1;
  }
  return lines + line + "\n";
}

std::string indented(const std::string& text, std::size_t by) { return wrapped(text, std::string(by, ' ')); }

constexpr std::string_view off = "off";  // as in case_text()

using ModelNames = std::vector<std::string>;

/// Whether a row acts in one of the models.
bool acts_in(const relevance::EffectRow& row, const ModelNames& models) {
  return std::any_of(models.begin(), models.end(),
                     [&](const std::string& model) { return row.models.find(model) != std::string::npos; });
}

/// The table's advice for a row.
enum class Advice { none, add, replace, may_leave_out, try_it };

Advice advice_of(const core::Scene& scene, const relevance::EffectRow& row) {
  const std::string has = case_text(scene, row);
  if (row.kind != Kind::role || has.empty() || has == core::automatic || !acts_in(row, models_of(scene)))
    return Advice::none;
  if (row.state == State::undecided) return has == off ? Advice::try_it : Advice::none;
  if (row.state == State::on && has == off) return row.choice ? Advice::replace : Advice::add;
  if (row.state == State::on) return has != row.model ? Advice::replace : Advice::none;
  return has != off && row.neglected ? Advice::may_leave_out : Advice::none;
}

const char* mark_of(Advice advice) {
  const char* marks[] = {" ", "*", "~", "-", "?"};
  return marks[std::size_t(advice)];
}

std::string advised_law(const relevance::EffectRow& row) {
  if (row.state == State::undecided) return "undecided";
  return row.state == State::on ? row.model : row.has_number() ? "off" : "-";  // no number, no decision
}

std::string limit_text(const relevance::EffectRow& row) {
  return row.threshold ? (row.below ? "< " : "> ") + number(row.threshold) : "-";
}

std::string role_line(const core::Scene& scene, const relevance::EffectRow& row) {
  return fmt::format("{} {:20} {:15} {:15} {:>15} {:>11}  {}\n", mark_of(advice_of(scene, row)), row.effect,
                     case_text(scene, row).empty() ? "not built" : case_text(scene, row), advised_law(row),
                     value_text(row), limit_text(row), row.models);
}

std::string other_line(const relevance::EffectRow& row) {
  return fmt::format("  {:20} {:15} {:15} {:>15} {:>11}\n", row.effect, state_text(row),
                     row.kind == Kind::condition ? row.model : "", value_text(row), limit_text(row));
}

/// A sum of forces with its allowed value.
std::string share_text(const std::vector<relevance::EffectRow>& rows, const std::string& model, double allowed) {
  const double sum = relevance::neglected_sum(rows, model), least = relevance::neglected_certainly(rows, model);
  return (least < sum ? share_of_weight(least) + " to " : "") + share_of_weight(sum) +
         (least > allowed ? " (too much)"
          : sum > allowed ? " (may be too much)"
                          : "");
}

std::string sums_text(const core::Scene& scene, const relevance::Choice& choice) {
  const ModelNames models = models_of(scene);
  const auto by_model = [&](const std::vector<relevance::EffectRow>& rows) {
    std::vector<std::string> sums;
    for (const std::string& model : models) sums.push_back(model + " " + share_text(rows, model, choice.tolerance));
    return fmt::format("{}\n", fmt::join(sums, ", "));
  };
  std::string text = fmt::format("forces left out, of the weight; {} allowed (chooser.tolerance, {}):\n",
                                 relevance::percent(choice.tolerance), core::name_of(scene.chooser.purpose));
  text += "  as recommended: " + by_model(choice.rows);
  if (!relevance::has_auto(scene)) text += "  as the case is: " + by_model(choice.of_case);
  std::vector<std::pair<std::string, std::string>> told;  // a remedy, and the models that it applies to
  for (const std::string& model : models)
    for (const std::string& line : remedies(left_out(scene, model))) {
      const auto same = std::find_if(told.begin(), told.end(), [&](const auto& one) { return one.first == line; });
      same == told.end() ? void(told.emplace_back(line, model)) : void(same->second += ", " + model);
    }
  for (const auto& [line, of] : told) text += indented(of + ": " + line, 2);
  if (choice.sum_up_to > choice.tolerance)
    text += indented(fmt::format("in a run up to {}, where the fluid is sheared within a cell or impacts spin "
                                 "particles; chooser.monitor = \"warn\" measures it",
                                 share_of_weight(choice.sum_up_to)),
                     2);
  return text;
}

/// Cost of turning on an effect, if known: empty if it is negligible.
std::string cost_text(const core::Scene& scene, const relevance::Choice& choice, const relevance::EffectRow& row) {
  const relevance::MenuEntry* entry = find_entry(row.effect);
  if (entry == nullptr || !acts_in(row, {"dem"})) return "";
  core::Scene with = with_choice(scene);
  with.effects[row.effect] = row.model;
  if (entry->effect->set_keys) entry->effect->set_keys(with, choice.surfaces);
  const double times = steps_by(with, row.effect);
  return times > many_more_steps ? fmt::format("; polybed dem takes {:.2g} times as long with it", times) : "";
}

/// A line for the case with its reason on the same line if it fits. An optional change is commented out with #.
std::string line_for_case(Advice advice, const relevance::EffectRow& row, const std::string& cost) {
  const std::string law = row.state == State::on || advice == Advice::try_it ? row.model : "none";
  const std::string line = fmt::format("{}{} = \"{}\"", advice == Advice::add ? "" : "# ", row.effect, law);
  const std::string open = row.band ? fmt::format("undecided: {} to {} of the weight", share_of_weight(row.band->least),
                                                  share_of_weight(row.band->most))
                                    : "";
  const std::string reason = (advice == Advice::try_it ? open : reason_text(row)) + cost,
                    beside = fmt::format("{:36}  # {}\n", line, reason);
  return beside.size() <= width + 1 ? beside : wrapped(reason, "# ") + line + "\n";
}

/// Lines for the case, each with its reason.
std::string lines_for_case(const core::Scene& scene, const relevance::Choice& choice) {
  std::string lines;
  bool chosen = false;
  for (const relevance::EffectRow& row : choice.rows) {
    const Advice advice = advice_of(scene, row);
    if (advice == Advice::none) continue;
    chosen = chosen || advice != Advice::add;
    lines += line_for_case(advice, row, advice == Advice::add ? cost_text(scene, choice, row) : "");
  }
  if (lines.empty()) {
    const ModelNames models = models_of(scene);
    const bool whole = std::all_of(models.begin(), models.end(), [&](const std::string& model) {
      return relevance::neglected_sum(choice.of_case, model) <= choice.tolerance;
    });
    return whole ? "Nothing to change: the case has what is recommended.\n"
                 : "Nothing to add: what the case leaves out has no law in its model, see below.\n";
  }
  return fmt::format("lines for [effects] of the case, or effects = \"auto\" at its top{}:\n\n",
                     chosen ? " (a law behind # is a choice)" : "") +
         lines;
}

/// Names of rows in one sentence; empty without rows.
std::string names_line(const std::string& front, const std::vector<std::string>& names) {
  return names.empty() ? "" : wrapped(fmt::format("{}: {}", front, fmt::join(names, ", ")), "  ");
}

/// The rows that the case has or should have, and the names of the others.
std::string short_table(const core::Scene& scene, const relevance::Choice& choice) {
  std::string lines;
  const ModelNames models = models_of(scene);
  std::vector<std::string> unneeded, missing;
  for (const relevance::EffectRow& row : choice.rows) {
    const bool acts = row.state == State::on || core::is_law(core::law_of(scene, row.effect));
    if (row.kind == Kind::role && !acts_in(row, models)) continue;
    if (row.kind == Kind::role && (acts || row.state == State::undecided))
      lines += role_line(scene, row);
    else if (row.kind == Kind::role)
      unneeded.push_back(row.effect);
    else if (row.kind == Kind::unmodelled && row.state == State::on)
      missing.push_back(fmt::format("{} ({} {})", row.effect, value_text(row), limit_text(row)));
  }
  return lines + names_line("off, and not needed", unneeded) + names_line("not modelled, but it matters here", missing);
}

std::string whole_table(const core::Scene& scene, const relevance::Choice& choice) {
  std::string text;
  const Kind kinds[] = {Kind::role, Kind::condition, Kind::unmodelled};
  for (const Kind kind : kinds) {
    if (kind == Kind::condition) text += "\ndecided by other keys, or always on:\n";
    if (kind == Kind::unmodelled) text += "\nnot modelled, estimated:\n";
    for (const relevance::EffectRow& row : choice.rows) {
      if (row.kind != kind) continue;
      text += (kind == Kind::role ? role_line(scene, row) : other_line(row)) + indented(reason_text(row), 6);
      if (row.has_number()) text += indented("number: " + row.number, 6);
    }
  }
  return text;
}

/// The lines for the case with their reasons, the neglected effects, and the effects that the case has or should have,
/// with a mark for changes: at most 100 columns wide, one screen.
/// \param details  every effect with its reason instead
std::string effects_table(const core::Scene& scene, relevance::Choice choice, bool details) {
  for (const std::string& model : models_of(scene))
    for (const std::string& role : to_try(left_out(scene, model)))  // alone within the tolerance, but not in the sum
      for (relevance::EffectRow& row : choice.rows)
        if (row.effect == role && case_text(scene, row) == off) row.state = State::undecided;
  return lines_for_case(scene, choice) + "\n" + sums_text(scene, choice) + "\n" +
         fmt::format("  {:20} {:15} {:15} {:>15} {:>11}  {}\n", "effect", "this case", "recommended", "value",
                     "matters if", "acts in") +
         (details ? whole_table(scene, choice) : short_table(scene, choice)) +
         "* switch on, ~ a better law, - may be left out, ? undecided" +
         (details ? "\n" : "; more: --details, polybed explain\n");
}

core::Json finite_or_null(const std::optional<double>& value) {
  return core::or_null(value && std::isfinite(*value) ? value : std::nullopt);
}

const char* verdict_of(State state) {
  const char* verdicts[] = {"on", "off", "undecided"};
  return verdicts[std::size_t(state)];
}

core::Json json_of(const core::Scene& scene, const relevance::EffectRow& row) {
  core::Json json = {
      {"effect", row.effect},
      {"model", row.model},
      {"on", row.state == State::on || row.state == State::off ? core::Json(row.state == State::on) : core::Json()},
      {"verdict", verdict_of(row.state)},
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
  json["models"] = models_of(scene);
  json["tolerance"] = choice.tolerance;
  json["purpose"] = core::name_of(scene.chooser.purpose);
}

struct EffectsOptions {
  CaseOptions scene;
  bool details = false;
};

void run_effects(const CaseOptions& options, bool details) {
  const core::Scene scene = read_case(options.case_path, options.overrides, either_model());
  const relevance::Choice choice = choose(scene);
  if (!options.json) return core::print("{}", effects_table(scene, choice, details));
  core::Json json;
  write_effects(json, scene, choice);
  core::print("{}\n", core::json_text(json));
}

}  // namespace

void add_effects(CLI::App& app, Commands& commands) {
  const auto options = std::make_shared<EffectsOptions>();
  CLI::App& command =
      *app.add_subcommand("effects", "which effects the scene calls for, with the number that decides each");
  take_case(command, options->scene);
  command.add_flag("--details", options->details, "the reason of every row");
  commands.push_back({&command, [options] {
                        run_effects(options->scene, options->details);
                        return core::ExitCode::done;
                      }});
}

}  // namespace polybed::app
