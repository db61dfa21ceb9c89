#include "multiscale/effects/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <variant>

#include "core/case/file.hpp"
#include "core/case/scene.hpp"
#include "core/timers.hpp"
#include "dem/effects/maker.hpp"
#include "dem/model.hpp"
#include "multiscale/roles.hpp"
#include "tfm/effects/maker.hpp"
#include "tfm/model.hpp"

namespace polybed::multiscale {

namespace {

const char* const bench_case = R"(
title = "what effects cost"
column = { size = ["24 mm", "60 mm"], cells = [12, 30], depth = "4 mm" }
fluid = { name = "water", temperature = "20 degC" }
bed = { volume_share = [0.5, 0.5], static_height = "6 mm", solids_fraction = 0.6 }
inlet = { superficial_velocity = "25 mm/s" }
effects = { drag = "cello", contact = "hertz_mindlin", solids_stress = "frictional" }
run = { until = "10 s" }
tfm = { integrator = "explicit" }
dem = { rolling_friction = 0.1, hamaker_constant = 1e-20, cohesion_gap = "0.4 nm", asperity_radius = "50 nm" }
[[species]]
name = "fine"
diameter = "0.8 mm"
density = 2500
[[species]]
name = "coarse"
diameter = "1.1 mm"
density = 2000
)";

/// An effect that is added to that case, or with "none" taken from it.
struct Benched {
  std::string effect, law;
  CostUnit unit;
};

std::vector<Benched> benched_effects() {
  std::vector<Benched> all;
  for (const dem::Maker* one : dem::effects())
    for (const std::string& law : one->benched)
      all.push_back({one->effect->role, law,
                     std::holds_alternative<dem::MakePair>(one->make) ? CostUnit::contact : CostUnit::particle});
  for (const tfm::Maker* one : tfm::effects())
    for (const std::string& law : one->benched) all.push_back({one->effect->role, law, CostUnit::cell});
  return all;
}

struct UnitCost {
  double per_unit = 0;  ///< s
  std::size_t bytes = 0;
  double units = 1;
};

core::Scene scene_with(const Benched* effect) {
  core::Scene scene = core::parse_case(bench_case, "bench", {}, all_roles());
  if (effect == nullptr) return scene;
  core::is_off(effect->law) ? void(scene.effects.erase(effect->effect))
                            : void(scene.effects[effect->effect] = effect->law);
  return scene;
}

/// Time of the terms that effects are in, s: not of the pressure, whose iterations go up and down, nor of the solver.
double seconds_of(const core::Timers& timers) {
  const std::set<std::string> others{"pressure", "fluid", "neighbours"};
  double seconds = 0;
  for (const core::Timers::Term& term : timers.terms())
    if (!others.contains(term.name)) seconds += term.seconds;
  return seconds;
}

/// What `steps` steps of a warm model take, s, and how much of `count` they do.
template <class Model>
std::pair<double, double> time_steps(Model& model, const core::Timers& timers, int warm, int steps, const auto& count) {
  for (int n = 0; n < warm; ++n) model.step(1e300);
  const double done = count(), begin = seconds_of(timers);
  for (int n = 0; n < steps; ++n) model.step(1e300);
  return {seconds_of(timers) - begin, std::max(count() - done, 1.0)};
}

UnitCost time_particles(const Benched* effect, CostUnit per) {
  core::Timers timers;
  dem::Model model(scene_with(effect), timers);
  const bool contacts = per == CostUnit::contact;
  const auto [seconds, units] = time_steps(model, timers, 32, 256, [&] {
    return double(contacts ? model.work().contact_steps : model.work().particle_steps);
  });
  const std::size_t numbers =
      contacts ? std::size_t(model.laws().memory_size()) : model.coupling()->sides().rows().width;
  return {seconds / units, numbers * sizeof(double), units};
}

UnitCost time_cells(const Benched* effect) {
  core::Timers timers;
  tfm::Model model(scene_with(effect), timers);
  const auto [seconds, units] = time_steps(model, timers, 4, 24, [&] {
    return double(model.work().right_hand_sides) * double(model.constants().grid.cell_count());
  });
  return {seconds / units, 0};
}

UnitCost time_of(const Benched* effect, CostUnit per) {
  return per == CostUnit::cell ? time_cells(effect) : time_particles(effect, per);
}

/// The least time, which nothing else has disturbed, and how far the next is from it.
struct Least {
  std::vector<double> times;
  std::size_t bytes = 0;
  double units = 1;
  void add(const UnitCost& t) {
    times.push_back(t.per_unit);
    units = t.units;
    std::sort(times.begin(), times.end());
    bytes = t.bytes;
  }
  [[nodiscard]] double spread() const { return times.size() > 1 ? times[1] - times[0] : times[0]; }
};

}  // namespace

std::string EffectCost::model() const { return unit == CostUnit::cell ? "tfm" : "dem"; }

std::string EffectCost::per() const {
  constexpr std::array names{"particle", "contact", "cell"};
  return names.at(std::size_t(unit));
}

std::vector<EffectCost> bench_effects(int rounds) {
  const std::vector<Benched> effects = benched_effects();
  const core::Scene bare = scene_with(nullptr);
  std::map<CostUnit, Least> plain;
  std::vector<Least> with(effects.size());
  for (int round = 0; round < rounds; ++round) {
    for (const CostUnit per : {CostUnit::particle, CostUnit::contact, CostUnit::cell})
      plain[per].add(time_of(nullptr, per));
    for (std::size_t n = 0; n < effects.size(); ++n) {
      UnitCost t = time_of(&effects[n], effects[n].unit);
      // Per contact of the plain run: what reaches further has more pairs, and all of them are its cost.
      if (effects[n].unit == CostUnit::contact) t.per_unit *= t.units / plain[CostUnit::contact].units;
      with[n].add(t);
    }
  }
  std::vector<EffectCost> costs;
  for (std::size_t n = 0; n < effects.size(); ++n) {
    const Benched& e = effects[n];
    const Least& without = plain.at(e.unit);
    const bool taken = core::is_off(e.law);
    const double sign = taken ? -1e9 : 1e9;
    costs.push_back({e.effect, taken ? core::law_of(bare, e.effect) : e.law, e.unit,
                     sign * (with[n].times[0] - without.times[0]), 1e9 * (with[n].spread() + without.spread()),
                     with[n].bytes > without.bytes ? with[n].bytes - without.bytes : 0});
  }
  return costs;
}

std::string bench_table(const std::vector<EffectCost>& costs) {
  std::string text =
      fmt::format("{:18} {:16} {:6} {:>10} {:>10} {:>8}  {}\n", "effect", "law", "model", "ns", "+-", "bytes", "per");
  for (const EffectCost& c : costs)
    text +=
        fmt::format("{:18} {:16} {:6} {:10.1f} {:10.1f} {:8}  {} and {}\n", c.effect, c.law, c.model(), c.nanoseconds,
                    c.spread, c.bytes, c.per(), c.unit == CostUnit::cell ? "right-hand side" : "step");
  return text;
}

void write_bench(core::Json& json, const std::vector<EffectCost>& costs) {
  core::Json& all = json["costs"] = core::Json::array();
  for (const EffectCost& c : costs)
    all.push_back({{"effect", c.effect},
                   {"law", c.law},
                   {"model", c.model()},
                   {"per", c.per()},
                   {"ns", c.nanoseconds},
                   {"spread_ns", c.spread},
                   {"bytes", c.bytes}});
}

}  // namespace polybed::multiscale
