#include "multiscale/card/card.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "closures/hopper_discharge.hpp"
#include "core/progress.hpp"
#include "multiscale/card/joined_box.hpp"
#include "multiscale/card/velocity_text.hpp"
#include "multiscale/program.hpp"

namespace polybed::multiscale {

namespace {

core::Json json_of(const std::optional<measures::TimeMean>& mean) {
  if (!mean) return nullptr;
  return {{"value", mean->mean}, {"interval", core::or_null(mean->interval)}};
}

core::Json json_or_null(const std::map<std::string, double>& values) {
  return values.empty() ? core::Json() : core::Json(values);
}

/// Predictions for the species from the case alone.
core::Json velocities_of(const core::Scene& scene, const BedOfCase& bed) {
  core::Json fluidisation = core::Json::object(), terminal = core::Json::object(), geldart = core::Json::object();
  for (const SpeciesInFluid& species : bed.species) {
    fluidisation[species.name] = core::or_null(species.minimum_fluidisation);
    terminal[species.name] = core::or_null(species.terminal);
    if (!species.geldart.empty()) geldart[species.name] = species.geldart;
  }
  const bool fluid = scene.fluid.present();
  fluidisation["mixture"] = core::or_null(bed.own.minimum_fluidisation);
  return {{"u_mf_m_s", fluid ? fluidisation : core::Json()},
          {"u_over_u_mf", core::or_null(bed.velocity_ratio())},
          {"terminal_m_s", fluid ? terminal : core::Json()},
          {"geldart", geldart.empty() ? core::Json() : geldart}};
}

/// One line for each height that still drifts.
std::vector<std::string> drift_lines(const BedOfRun& bed) {
  std::vector<std::string> lines;
  for (const measures::DriftOfMeasure& d : bed.drifts)
    if (!d.steady)
      lines.push_back(fmt::format("not steady: drift of {} {:.3g} ± {:.2g} mm/s over the last {:.3g} s", d.name,
                                  1e3 * d.drift.rate, 1e3 * d.drift.error, bed.window));
  return lines;
}

core::Json drift_of(const BedOfRun& bed) {
  core::Json measures = core::Json::array();
  for (const measures::DriftOfMeasure& d : bed.drifts)
    measures.push_back(
        {{"name", d.name}, {"rate_m_per_s", d.drift.rate}, {"error_m_per_s", d.drift.error}, {"steady", d.steady}});
  return {{"window_s", bed.window}, {"measures", measures}, {"lines", drift_lines(bed)}};
}

// ---- words

std::string one_digit(double value) {
  return value < 9.5 ? fmt::format("{:.1g}", value) : fmt::format("{:.0f}", value);
}

/// The state in words; empty if unknown.
std::string words_of(Fluidisation state) {
  std::string words = name_of(state);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

constexpr std::size_t most_species = 4;  // whose tops a line lists

/// Height of the bed by the law of the case, with what its layers change.
std::string expected_height(const core::Scene& scene, const BedOfCase& bed) {
  const double top = scene.column.size[1], height = *bed.own.height;
  std::string text = height < top ? fmt::format(", about {:.0f} mm high by {}", 1e3 * height, bed.own.law)
                                  : ", up to the top of the column by " + bed.own.law +
                                        (overflows(scene, bed) ? ", over which solids leave" : "");
  if (bed.own.mixed) text += " in layers";
  const bool lifted = !scene.walls.empty() && bed.settled > (1 + 1e-9) * scene.bed.static_height;
  text += fmt::format(" (settled {:.0f} mm{}, column {:.0f} mm", 1e3 * bed.settled,
                      lifted ? fmt::format(", {:.0f} mm without the walls inside", 1e3 * scene.bed.static_height) : "",
                      1e3 * top);
  if (bed.own.mixed && *bed.own.mixed < top) text += fmt::format("; {:.0f} mm if mixed", 1e3 * *bed.own.mixed);
  text += ")";
  if (bed.resting > 0) text += fmt::format("; layers still packed: {}", bed.resting);
  return text + (bed.turns_over ? "; an upper layer becomes denser than the one below: they mix or change places" : "");
}

std::string parted_text(const core::Scene& scene, const PartedBed& parted) {
  if (parted.leaving.empty())
    return fmt::format("about {:.0f} mm high if the species part into layers", 1e3 * parted.height);
  const std::string species = each(parted.leaving);
  const bool open = scene.column.outlet == core::Outlet::open;
  return "up to the top of the column if the species part into layers" +
         (open ? ", over which then leave: " + species : "");
}

std::string discharges_text(const std::vector<std::pair<std::size_t, double>>& discharges) {
  std::vector<std::string> parts;
  for (const auto& [number, low] : discharges)
    parts.push_back(fmt::format("discharge {} at {:.0f} mm", number, 1e3 * low));
  return "the bed reaches " + each(parts) + ": solids leave there";
}

/// Predictions for an opening in the bottom.
void add_discharge(const ExpectedDischarge& out, std::vector<std::string>& lines) {
  const std::string width = fmt::format("the opening is {:.2g} particle diameters wide", out.diameters);
  if (!(out.rate > 0)) return lines.push_back(card_line("expect", "no discharge: " + width));
  lines.push_back(card_line("expect", fmt::format("discharge of about {}/s; {} would be out after {:.2g} s",
                                                  mass_text(out.rate), mass_text(out.mass), out.mass / out.rate)));
  lines.push_back(card_line("", std::string("estimate by Beverloo's law, good to 30 %") +
                                    (out.cone   ? " for a flat bottom; a steep cone discharges more"
                                     : out.flat ? "; a flat bottom keeps what lies in its corners"
                                                : "")));
  if (out.diameters < closures::least_hopper_opening)
    lines.push_back(card_line("", fmt::format("{}: below {:g} it may block", width, closures::least_hopper_opening)));
}

bool is_class(const std::map<std::string, double>& all, const std::string& name) {
  return name.find('.') != std::string::npos && all.contains(name.substr(0, name.rfind('.')));
}

std::string exits_text(const BedOfRun& bed) {
  std::string text;
  for (const BedOfRun::Exit& exit : bed.exits) {
    std::vector<std::string> parts;
    if (exit.flow) parts.push_back(fmt::format("{:.3g} ml/s", 1e6 * exit.flow->mean));
    for (const auto& [name, mass] : exit.out)
      if (!is_class(exit.out, name)) parts.push_back(name + " " + mass_text(mass));
    text += (text.empty() ? "" : "; ") + exit.name + ": " + each(parts);
  }
  return text;
}

std::string out_text(const BedOfRun& bed) {
  constexpr double nothing = 1e-12;  // of what was supplied: the tail of a continuum, far less than a particle
  std::vector<std::string> parts;
  for (const auto& [name, mass] : bed.out) {
    if (is_class(bed.out, name)) continue;
    const auto share = bed.recovery.find(name);
    const bool none = share != bed.recovery.end() && std::abs(share->second) < nothing;
    parts.push_back(name + " " + mass_text(none ? 0 : mass) +
                    (share == bed.recovery.end() ? "" : fmt::format(" ({:.3g} %)", none ? 0 : 100 * share->second)));
  }
  return each(parts);
}

std::string depth_text(const BedOfCase& bed) {
  return bed.assumed_depth ? fmt::format(" (assumed depth {:.3g} mm)", 1e3 * *bed.assumed_depth) : "";
}

/// Height of the bed, and of each species if they separate or if one is suspended above the others.
std::string height_text(const BedOfRun& bed) {
  constexpr double above = 1.2;  // over the top of the dense bed
  const bool suspended = bed.state != Fluidisation::unknown && bed.dense &&
                         std::any_of(bed.tops.begin(), bed.tops.end(),
                                     [&](const auto& top) { return top.second.mean > above * bed.dense->mean; });
  std::string text =
      suspended ? "dense bed " + mean_text(*bed.dense, 1e3, " mm high") : mean_text(*bed.height, 1e3, " mm high");
  const bool part = bed.tops.size() > 1 && (bed.layers == Layers::layered || bed.layers == Layers::inverted);
  if (!(suspended || part) || bed.tops.size() > most_species) return text;
  auto tops = bed.tops;
  std::stable_sort(tops.begin(), tops.end(),
                   [](const auto& a, const auto& b) { return a.second.mean < b.second.mean; });
  std::vector<std::string> parts;
  for (const auto& [name, top] : tops) parts.push_back(name + " up to " + mean_text(top, 1e3, " mm"));
  return text + " (" + each(parts) + ")";
}

std::string bed_text(const BedOfRun& bed) {
  std::vector<std::string> parts;
  for (const std::string& word : {words_of(bed.state), name_of(bed.layers)})
    if (!word.empty()) parts.push_back(word);
  if (bed.hangs && !parts.empty()) parts.emplace_back("hanging from the top");
  if (bed.height && !is_carried(bed.state)) {
    parts.push_back(height_text(bed));
    if (bed.cell > 0) parts.push_back("on cells of " + with_prefix(bed.cell, "m"));
  }
  if (bed.drop && bed.state != Fluidisation::unknown)
    parts.push_back("pressure drop " + (bed.pressure ? mean_text(*bed.pressure, 1, " Pa, ") : "") +
                    mean_text(*bed.drop, 1, " of the weight"));
  return each(parts);
}

/// When the bed of a case can be steady, and whether its run is too short for that.
std::string first_steady_text(const core::Scene& scene, const FirstSteady& steady) {
  constexpr double window = 0.75;  // part of a run before the last quarter, which its card uses
  if (!steady.least) return "no time foreseen: " + steady.why + "; --until steady ends a run once its card says steady";
  if (*steady.least == 0) return "from the start: " + steady.why;
  std::string text = fmt::format("after {} at least: {}", short_time(*steady.least), steady.why);
  if (window * scene.run.until < *steady.least)
    text += fmt::format("; the run ends at {:.4g} s, too early: see --until steady", scene.run.until);
  return text;
}

std::string steady_text(const BedOfRun& bed) {
  if (!bed.steady) return "not known: too few rows in history.csv";
  if (*bed.steady) return fmt::format("yes, over the last {:.3g} s", bed.window);
  if (bed.discharge)
    return fmt::format("no: particles still left in the last {:.3g} s, or what remains still moves", bed.window);
  std::vector<std::string> drifting;
  for (const measures::DriftOfMeasure& drift : bed.drifts)
    if (!drift.steady) drifting.push_back(drift.name);
  return fmt::format("no: {} still drift{} over the last {:.3g} s; the numbers above are not final", each(drifting),
                     drifting.size() == 1 ? "s" : "", bed.window);
}

}  // namespace

std::string card_line(const std::string& heading, const std::string& text) {
  return fmt::format("{:13} {}", heading, text);
}

std::string mean_text(const measures::TimeMean& mean, double scale, const std::string& unit) {
  constexpr double shown = 1e-4;  // of the value: four digits
  const bool is_seen = mean.interval && *mean.interval > shown * std::abs(mean.mean);
  const std::string interval = is_seen ? " ± " + one_digit(scale * *mean.interval) : "";
  return plain(scale * mean.mean, 4) + interval + unit;
}

std::string short_time(double seconds) {
  constexpr double rounds_to_one_digit = 9.5;
  return seconds < rounds_to_one_digit ? fmt::format("{:.2g} s", seconds) : core::duration_text(seconds);
}

std::string computing_text(const TimeBand& time) {
  return fmt::format("about {} of computing, {} to {}", short_time(time.expected), short_time(time.least),
                     short_time(time.most));
}

void write_card(core::Json& json, const core::Scene& scene, const Card& card) {
  const BedOfRun& seen = card.seen;
  core::Json tops;
  for (const auto& [name, top] : seen.tops) tops[name] = json_of(top);
  json["card"] = velocities_of(scene, card.expected);
  json["card"].update({
      {"state", core::text_or_null(name_of(seen.state))},
      {"layers", core::text_or_null(name_of(seen.layers))},
      {"bed_height_m", json_of(seen.height)},
      {"dense_height_m", json_of(seen.dense)},
      {"tops_m", tops},
      {"pressure_drop_Pa", json_of(seen.pressure)},
      {"pressure_drop_over_weight", json_of(seen.drop)},
      {"mixing", core::or_null(seen.mixing)},
      {"mass_kg", json_or_null({seen.masses.begin(), seen.masses.end()})},
      {"out_kg", json_or_null(seen.out)},
      {"recovery", json_or_null(seen.recovery)},
      {"discharge_kg_s", core::or_null(seen.discharge)},
      {"steady", seen.steady ? core::Json(*seen.steady) : core::Json()},
      {"limited_by", core::text_or_null(card.limited_by)},
      {"left_out", left_out_text(card.left_out, card.met)},
      {"time_s", {{"taken", core::or_null(card.taken)}, {"predicted", card.predicted.expected}}},
      {"lines", result_lines(card)},
  });
  if (seen.joined) json["card"].update(json_of(*seen.joined));
  for (const BedOfRun::Exit& exit : seen.exits)
    json["card"]["exits"][exit.name] = {{"flow_m3_s", json_of(exit.flow)}, {"out_kg", json_or_null(exit.out)}};
  json["drift"] = drift_of(seen);
}

void write_expected(core::Json& json, const core::Scene& scene, const BedOfCase& bed) {
  json["expected"] = velocities_of(scene, bed);
  const auto by_laws = [](const std::vector<ByLaw>& all) {
    core::Json laws = core::Json::object();
    for (const ByLaw& one : all)
      laws[one.law] = {{"u_mf_m_s", core::or_null(one.minimum_fluidisation)},
                       {"bed_height_m", core::or_null(one.height)}};
    return laws;
  };
  core::Json packings = core::Json::array();
  for (const auto& [solids, velocity] : bed.by_packing)
    packings.push_back({{"solids_fraction", solids}, {"u_mf_m_s", velocity}});
  core::Json expansion = core::Json::array();
  for (const ExpansionAt& one : bed.expansion)
    expansion.push_back({{"share", one.share}, {"least_m_s", one.least}, {"most_m_s", one.most}});
  json["expected"].update({
      {"state", core::text_or_null(name_of(bed.state))},
      {"law", core::text_or_null(bed.own.law)},
      {"bed_height_m", core::or_null(bed.own.height)},
      {"reaches_top", bed.own.height ? core::Json(*bed.own.height >= scene.column.size[1]) : core::Json()},
      {"bed_height_mixed_m", core::or_null(bed.own.mixed)},
      {"bed_height_parted_m", bed.parted ? core::or_null(bed.parted->height) : core::Json()},
      {"settled_height_m", bed.settled},
      {"packed_pressure_drop_Pa", core::or_null(bed.packed_drop)},
      {"expansion", expansion},
      {"mass_kg", json_or_null({bed.masses.begin(), bed.masses.end()})},
      {"u_mf_by_packing", packings},
      {"by_shapes", by_laws(bed.shapes)},
      {"by_laws_of_beds", by_laws(bed.others)},
      {"leaving", bed.leaving},
      {"rising_time_s", core::or_null(bed.steady.least)},
      {"validity", core::text_or_null(bed.validity)},
      {"discharge_kg_s", bed.discharge ? core::Json(bed.discharge->rate) : core::Json()},
  });
  if (bed.joined) json["expected"].update(json_of(*bed.joined));
}

std::vector<std::string> expectation_lines(const core::Scene& scene, const BedOfCase& bed) {
  std::vector<std::string> lines;
  const double top = scene.column.size[1];
  if (bed.joined) add_joined_box(scene, *bed.joined, bed.own.law, lines);
  if (bed.state != Fluidisation::unknown) {
    std::string text = words_of(bed.state);
    if (bed.packed_drop && *bed.packed_drop > 0) text += fmt::format(", pressure drop {:.4g} Pa", *bed.packed_drop);
    if (bed.own.height) text += expected_height(scene, bed);
    if (bed.no_balance)
      text += fmt::format("; {} has no balance at {}: by it the fluid carries the solids up", bed.own.law,
                          velocity_text(*bed.velocity, bed.area));
    if (!bed.leaving.empty())
      text += fmt::format("; lifted {}: {}", scene.column.outlet == core::Outlet::open ? "out" : "to the top",
                          each(bed.leaving));
    lines.push_back(card_line("expect", text));
    if (bed.inlet)
      lines.push_back(card_line(
          "", "as if the jets flowed evenly through the whole bottom: a jet moves only the solids on its path"));
    if (bed.top_heavy)
      lines.push_back(card_line(
          "", "as if each level were even: wider above, the bed is denser there, turns over and stays lower"));
    const std::string others = (bed.own.height || bed.no_balance) && bed.state != Fluidisation::packed
                                   ? by_others(bed, &ByLaw::height, top)
                                   : std::string();
    if (!others.empty()) lines.push_back(card_line("", others));
    if (bed.parted) lines.push_back(card_line("", parted_text(scene, *bed.parted)));
    if (!bed.discharges.empty()) lines.push_back(card_line("", discharges_text(bed.discharges)));
  }
  if (!bed.expansion.empty()) {
    std::vector<std::string> all, own;
    for (const ExpansionAt& one : bed.expansion) {
      all.push_back(fmt::format("{:.0f} % at {}", 100 * one.share, velocities_text(one.least, one.most, bed.area)));
      if (one.own) own.push_back(velocity_text(*one.own, bed.area));
    }
    const std::string by_own = own.empty() ? "" : fmt::format("; {} by {}", each(own), bed.own.law);
    lines.push_back(card_line("expands by", each(all) + " by laws of such beds" + by_own));
  }
  const bool liquid = !bed.species.empty() && bed.species.front().geldart.empty();
  if (bed.expansion.empty() && liquid && bed.own.height && !bed.leaving.empty())
    lines.push_back(card_line("expands by", "not foreseen where a species leaves: leave out " + each(bed.leaving)));
  if (bed.discharge) add_discharge(*bed.discharge, lines);
  if (!bed.discharge && scene.dem.opening && !scene.walls.empty())
    lines.push_back(
        card_line("expect", "discharge not estimated: Beverloo's law knows no walls inside, apart from a cone"));
  add_velocities(bed, true, lines);
  if (!bed.masses.empty()) lines.push_back(card_line("solids", masses_text(bed.masses) + depth_text(bed)));
  if (!bed.steady.why.empty()) lines.push_back(card_line("steady", first_steady_text(scene, bed.steady)));
  if (!bed.validity.empty())
    lines.push_back(card_line("validity", fmt::format("{}; {} validate --list", bed.validity, typed_program())));
  return lines;
}

std::vector<std::string> result_lines(const Card& card) {
  const BedOfRun& seen = card.seen;
  std::vector<std::string> lines;
  if (const std::string text = bed_text(seen); !text.empty()) lines.push_back(card_line("bed", text));
  if (seen.joined) add_slips(*seen.joined, lines);
  add_velocities(card.expected, false, lines);
  if (!seen.masses.empty()) lines.push_back(card_line("solids", masses_text(seen.masses) + depth_text(card.expected)));
  if (seen.mixing)
    lines.push_back(card_line("mixing", fmt::format("{:.2f}  (1 mixed, 0 separated)", std::max(*seen.mixing, 0.0))));
  if (!seen.out.empty()) lines.push_back(card_line("has left", out_text(seen)));
  if (!seen.exits.empty()) lines.push_back(card_line("leaves by", exits_text(seen)));
  if (seen.discharge) lines.push_back(card_line("discharge", mass_text(*seen.discharge) + "/s"));
  if (seen.blocked) lines.push_back(card_line("discharge", "none: nothing leaves any more, and over half remains"));
  if (seen.height || seen.steady) lines.push_back(card_line("steady", steady_text(seen)));
  if (!card.limited_by.empty()) lines.push_back(card_line("step", "limited by " + card.limited_by));
  lines.push_back(card_line("left out", left_out_text(card.left_out, card.met)));
  if (card.taken)
    lines.push_back(card_line("time", fmt::format("{} of computing, predicted {} ({} to {})", short_time(*card.taken),
                                                  short_time(card.predicted.expected), short_time(card.predicted.least),
                                                  short_time(card.predicted.most))));
  return lines;
}

}  // namespace polybed::multiscale
