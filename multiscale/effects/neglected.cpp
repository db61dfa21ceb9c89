#include "multiscale/effects/neglected.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "closures/relevance.hpp"
#include "core/case/scene.hpp"
#include "multiscale/roles.hpp"
#include "relevance/fluid_properties.hpp"

namespace polybed::multiscale {

namespace {

constexpr int bins = 240, bins_per_decade = 20;
constexpr double least_share = 1e-10;

std::size_t bin_of(double share) {
  const double place = std::log10(std::max(share, least_share) / least_share) * bins_per_decade;
  return std::size_t(std::clamp(place, 0.0, double(bins - 1)));
}

std::string per_cent(std::uint64_t part, std::uint64_t whole) {
  return relevance::two_digits(100.0 * double(part) / double(std::max<std::uint64_t>(whole, 1)));
}

}  // namespace

void Observed::add(double share, const Encounter& met, double tolerance) {
  if (bins.empty()) bins.assign(multiscale::bins, 0);
  const bool first = count == 0;
  count += met.weight;
  bins[bin_of(share)] += met.weight;
  if (share > tolerance) above += met.weight;
  if (!first && share <= greatest) return;
  greatest = share;
  time = met.time;
  place = met.place;
}

double Observed::percentile() const {
  std::uint64_t beyond = 0;
  for (std::size_t n = bins.size(); n-- > 0;) {
    beyond += bins[n];
    if (100 * beyond > count) return std::min(least_share * std::pow(10, double(n + 1) / bins_per_decade), greatest);
  }
  return greatest;
}

Neglected::Neglected(const core::Scene& scene, const std::string& model)
    : scene_(scene), tolerance_(scene.chooser.tolerance) {
  const relevance::FluidConstants fluid = relevance::fluid_constants(scene.fluid);
  fluid_density_ = fluid.density;
  viscosity_ = fluid.viscosity;
  const relevance::Choice choice = choose(scene);
  surfaces_ = choice.surfaces;
  for (const relevance::EffectRow& row : choice.rows) {
    if (!row.summed) continue;
    const bool has_law = row.models.find(model) != std::string::npos && row.not_built.empty();
    if (has_law && core::acts(scene, row.effect)) continue;
    const relevance::MenuEntry* entry = find_entry(row.effect);
    if (entry == nullptr || !entry->effect->share) {
      if (row.value.value_or(0) > 1e-3 * tolerance_) not_evaluated_.push_back(row.effect);
      continue;
    }
    effects_.push_back(entry->effect);
    Observed one;
    one.effect = row.effect;
    one.bound = row.up_to.value_or(row.value.value_or(0));  // encounters outside the law's range are counted separately
    observed_.push_back(one);
  }
  Observed sum;
  sum.effect = "sum";
  sum.of_all = true;
  for (const Observed& one : observed_) sum.bound += one.bound;
  observed_.push_back(sum);
}

void Neglected::see(const Encounter& met) {
  const core::Species& s = scene_.species[met.species];
  const double weight = closures::buoyant_weight(s.diameter, s.density, fluid_density_, scene_.column.gravity);
  const relevance::Encountered particle{s.diameter, weight,   fluid_density_, viscosity_,
                                        surfaces_,  met.slip, met.vorticity,  met.spin};
  double sum = 0;
  bool whole = true;
  for (std::size_t n = 0; n < effects_.size(); ++n) {
    if (const auto share = weight > 0 ? effects_[n]->share(particle) : std::nullopt) {
      observed_[n].add(*share, met, tolerance_);
      sum += *share;
    } else {
      observed_[n].outside += met.weight;
      whole = false;
    }
  }
  whole ? observed_.back().add(sum, met, tolerance_) : void(observed_.back().outside += met.weight);
}

std::optional<ForcesMet> Neglected::met() const {
  if (!kept()) return std::nullopt;
  ForcesMet met{{}, sum().percentile()};
  for (const Observed& one : observed_)
    if (!one.of_all) met.effects.push_back(one.effect);
  return met;
}

void Neglected::gather(const core::Ranks* ranks) {
  if (ranks == nullptr) return;
  for (Observed& one : observed_) {
    one.bins.resize(bins);
    std::vector<std::int64_t> counts(one.bins.begin(), one.bins.end());
    counts.insert(counts.end(), {std::int64_t(one.count), std::int64_t(one.outside), std::int64_t(one.above)});
    core::add_over_ranks(ranks, counts);
    std::copy_n(counts.begin(), bins, one.bins.begin());
    one.count = std::uint64_t(counts[bins]);
    one.outside = std::uint64_t(counts[bins + 1]);
    one.above = std::uint64_t(counts[bins + 2]);
    const bool mine = ranks->rank() == core::rank_of_greatest(ranks, one.greatest);
    std::array<double, 5> where{};
    if (mine) where = {one.greatest, one.time, one.place[0], one.place[1], one.place[2]};
    core::add_over_ranks(ranks, where);
    one.greatest = where[0];
    one.time = where[1];
    one.place = {where[2], where[3], where[4]};
  }
}

core::Json Neglected::past() const {
  core::Json past = core::Json::array();
  for (const Observed& o : observed_)
    past.push_back({{"effect", o.effect},
                    {"counts", {o.count, o.outside, o.above}},
                    {"greatest", {o.greatest, o.time, o.place[0], o.place[1], o.place[2]}},
                    {"bins", o.bins}});
  return past;
}

bool Neglected::recall(const core::Json& past) {
  const std::vector<core::Json>& seen = core::array_of(past);
  const auto same = [](const Observed& o, const core::Json& before) {
    return core::text_of(core::member_of(before, "effect")) == o.effect;
  };
  if (!std::equal(observed_.begin(), observed_.end(), seen.begin(), seen.end(), same)) return false;
  for (std::size_t n = 0; n < observed_.size(); ++n) {
    Observed& o = observed_[n];
    std::vector<std::uint64_t> counts;
    std::vector<double> greatest;
    for (const core::Json& count : core::array_of(core::member_of(seen[n], "counts")))
      counts.push_back(core::count_of(count));
    for (const core::Json& number : core::array_of(core::member_of(seen[n], "greatest")))
      greatest.push_back(core::number_of(number));
    counts.resize(3);
    greatest.resize(5);
    o.count = counts[0];
    o.outside = counts[1];
    o.above = counts[2];
    o.greatest = greatest[0];
    o.time = greatest[1];
    o.place = {greatest[2], greatest[3], greatest[4]};
    o.bins.clear();
    for (const core::Json& count : core::array_of(core::member_of(seen[n], "bins")))
      o.bins.push_back(core::count_of(count));
    if (!o.bins.empty()) o.bins.resize(bins);
  }
  return true;
}

std::string neglected_table(const Neglected& neglected) {
  using relevance::two_digits;
  std::string text = fmt::format("{:12} {:>9} {:>9} {:>9} {:>10} {:>12}  {}\n", "left out", "bound", "greatest",
                                 "99 % below", "above tol.", "out of range", "greatest at");
  for (const Observed& o : neglected.observed())
    text += fmt::format("{:12} {:>9} {:>9} {:>9} {:>9}% {:>11}%  ({:.4g}, {:.4g}, {:.4g}) m, t = {:.4g} s\n", o.effect,
                        two_digits(o.bound), two_digits(o.greatest), two_digits(o.count > 0 ? o.percentile() : 0.0),
                        per_cent(o.above, o.count), per_cent(o.outside, o.count + o.outside), o.place[0], o.place[1],
                        o.place[2], o.time);
  if (!neglected.not_evaluated().empty())
    text += fmt::format("not evaluated: {}\n", fmt::join(neglected.not_evaluated(), ", "));
  return text;
}

void write_neglected(core::Json& json, const Neglected& neglected) {
  core::Json observed = core::Json::array();
  for (const Observed& o : neglected.observed())
    observed.push_back({{"effect", o.effect},
                        {"bound", o.bound},
                        {"greatest", o.greatest},
                        {"percentile_99", o.count > 0 ? o.percentile() : 0.0},
                        {"encounters", o.count},
                        {"above_tolerance", o.above},
                        {"out_of_range", o.outside},
                        {"time_s", o.time},
                        {"place_m", {o.place[0], o.place[1], o.place[2]}}});
  const std::optional<bool> kept = neglected.kept();
  json["promise"] = {{"tolerance", neglected.tolerance()},
                     {"kept", kept ? core::Json(*kept) : core::Json()},
                     {"observed", observed},
                     {"not_evaluated", neglected.not_evaluated()}};
}

}  // namespace polybed::multiscale
