#include "measures/window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace polybed::measures {

namespace {

using Series = std::vector<double>;

// ---- rows of a history

double ratio(double above, double below) {
  return below != 0 ? above / below : std::numeric_limits<double>::quiet_NaN();
}

/// Centre of species 2 minus centre of species 1, over the bed height.
Series centre_difference(const StoredRun& run) {
  const std::vector<Kind> species = named_species(run.species);
  if (species.size() < 2) return {};
  const Series *low = run.history.find("centre_" + species[0].name + "_m"),
               *high = run.history.find("centre_" + species[1].name + "_m"), *height = run.history.find("bed_height_m");
  Series found;
  for (std::size_t n = 0; low != nullptr && high != nullptr && height != nullptr && n < height->size(); ++n)
    found.push_back(ratio((*high)[n] - (*low)[n], (*height)[n]));
  return found;
}

/// Start of the window for a series by the marginal standard error rule, s.
double begin_by_rule(const Series& time, const Series& values, const Window& window) {
  if (values.empty()) return window.begin;
  const Rows rows = window.rows(time);
  const std::size_t drop = rows_to_drop(rows.of(values));
  return drop > 0 ? time[rows.begin + drop] : window.begin;
}

// ---- profiles

/// The mean profile over stored beds, and the means without each group of them.
struct MeanProfile {
  Profile all;
  std::vector<Profile> without;
};

MeanProfile mean_profile(const StoredRun& run, const Rows& rows) {
  const Profile& first = run.beds[rows.begin].profile;
  const std::vector<Rows> groups = groups_of(rows.count());
  MeanProfile found{{first.slab, first.fraction, {}, first.areas}, {}};
  found.without.assign(groups.size(), found.all);
  for (std::size_t j = 0; j < first.fraction.size(); ++j)
    for (std::size_t k = 0; k < first.slabs(); ++k) {
      Series values;
      for (std::size_t n = rows.begin; n < rows.end; ++n) values.push_back(run.beds[n].profile.fraction[j][k]);
      found.all.fraction[j][k] = mean_of(values);
      for (std::size_t g = 0; g < groups.size(); ++g)
        found.without[g].fraction[j][k] = mean_of(without(values, groups[g]));
    }
  return found;
}

template <class Function>
std::vector<Value> of_each(const std::vector<Profile>& profiles, const Function& function) {
  std::vector<Value> found;
  for (const Profile& profile : profiles) found.push_back(function(profile));
  return found;
}

/// Values of a function for a mean profile.
template <class Function>
std::optional<TimeMean> measured(const MeanProfile& profile, const Function& function) {
  const Value value = function(profile.all);
  if (!value) return {};
  return TimeMean{*value, jackknife_interval(of_each(profile.without, function))};
}

/// The run with its profiles on a given number of slabs.
StoredRun laid_on(std::size_t slabs, StoredRun run) {
  for (Bed& bed : run.beds)
    if (const Profile& own = bed.profile; slabs > 0 && own.slabs() != slabs)
      bed.profile = on_slabs(own, own.slab * double(own.slabs()) / double(slabs), slabs);
  return run;
}

/// Mean change of a measure over the beds, from one run to the other.
double change(const Single<Bed>& measure, const StoredRun& run, const StoredRun& laid, const Rows& rows) {
  Series changes;
  for (std::size_t n = rows.begin; n < rows.end; ++n) {
    const Value here = measure.of(run.beds[n]), there = measure.of(laid.beds[n]);
    if (here && there) changes.push_back(*there - *here);
  }
  return changes.empty() ? 0 : mean_of(changes);
}

void add_profiles(const StoredRun& run, const StoredRun& laid, const Rows& rows, InWindow& found) {
  const MeanProfile profile = mean_profile(laid, rows);
  for (std::size_t j = 0; j < profile.all.fraction.size(); ++j) {
    std::vector<TimeMean>& of_species = found.mean.emplace_back();
    for (std::size_t k = 0; k < profile.all.slabs(); ++k)
      of_species.push_back(*measured(profile, [j, k](const Profile& one) { return Value(one.fraction[j][k]); }));
  }
  for (const Single<Bed>& measure : singles(read_by(&Readers::profile, bed_table(run.around())), run.species)) {
    if (const auto mean = measured(profile, [&](const Profile& one) { return measure.of({one}); }))
      found.of_mean[measure.column()] = *mean;
    const auto moved = found.means.find(measure.column());
    if (measure.readers.drift && moved != found.means.end()) moved->second.mean += change(measure, run, laid, rows);
  }
}

/// Half-width of the interval from the variation of both runs' groups.
Value joint_interval(const std::vector<Value>& one, const std::vector<Value>& other) {
  const std::optional<Jackknife> a = jackknife(one), b = jackknife(other);
  if (!a || !b) return {};
  return Jackknife{std::hypot(a->deviation, b->deviation), std::min(a->degrees, b->degrees)}.interval();
}

}  // namespace

std::vector<double> drop_over_weight(const core::History& history) {
  const Series *drop = history.find("pressure_drop_Pa"), *weight = history.find("buoyant_weight_Pa");
  Series found;
  for (std::size_t n = 0; drop != nullptr && weight != nullptr && n < drop->size(); ++n)
    found.push_back(ratio((*drop)[n], (*weight)[n]));
  return found;
}

std::map<std::string, std::vector<double>> series_of(const StoredRun& run) {
  std::map<std::string, Series> found{{"pressure_drop_over_weight", drop_over_weight(run.history)},
                                      {"centre_difference", centre_difference(run)}};
  for (std::size_t c = 1; c < run.history.columns.size(); ++c) found[run.history.columns[c]] = run.history.values[c];
  return found;
}

Rows Window::rows(std::span<const double> time) const {
  if (time.empty()) return {};
  const double slack = 1e-9 * std::min(end, time.back());
  const auto first = std::lower_bound(time.begin(), time.end(), begin - slack);
  const auto last = std::upper_bound(first, time.end(), end + slack);
  return {std::size_t(first - time.begin()), std::size_t(last - time.begin())};
}

Window last_quarter(std::span<const double> time) {
  return {time.back() - window_share * (time.back() - time.front()), time.back()};
}

Window common_window(const std::vector<const StoredRun*>& runs) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  std::string spans;
  for (const StoredRun* run : runs) {
    const Series& time = run->history.of("time_s");
    if (time.empty()) throw core::FileError("a history without a row: nothing to compare");
    first = std::max(first, time.front());
    last = std::min(last, time.back());
    spans += fmt::format("{}{:.4g} to {:.4g} s", spans.empty() ? "" : " and ", time.front(), time.back());
  }
  if (!(last > first)) throw core::FileError("the runs have no time in common: " + spans);
  const Window quarter = last_quarter(std::vector{first, last});
  Window window = quarter;
  for (const StoredRun* run : runs)
    for (const Series& values : {run->history.of("bed_height_m"), centre_difference(*run)})
      window.begin = std::max(window.begin, begin_by_rule(run->history.of("time_s"), values, quarter));
  window.shortened = window.begin > quarter.begin;
  return window;
}

InWindow in_window(const StoredRun& run, const Window& window, std::size_t slabs) {
  const Series& time = run.history.of("time_s");
  const Rows rows = window.rows(time);
  InWindow found{.rows = rows.count()};
  if (found.rows > 1) found.step = (time[rows.end - 1] - time[rows.begin]) / double(found.rows - 1);
  for (const auto& [name, values] : series_of(run))
    if (!values.empty())
      if (const auto mean = time_mean(rows.of(values))) found.means[name] = *mean;
  const Rows profiles = window.rows(run.time);
  found.profiles = profiles.count();
  if (run.beds.empty()) return found;
  const StoredRun laid = laid_on(slabs, run);
  const Profile& slab = laid.beds.front().profile;
  for (std::size_t k = 0; k < slab.slabs(); ++k) found.height.push_back(slab.centre(k));
  if (found.profiles > 0) add_profiles(run, laid, profiles, found);
  return found;
}

Means distances(const StoredRun& run, const StoredRun& reference, const Window& window, std::size_t slabs) {
  if (run.species != reference.species) throw core::FileError("the runs are of other species");
  const Rows rows = window.rows(run.time), of_reference = window.rows(reference.time);
  if (rows.count() == 0 || of_reference.count() == 0) return {};
  const MeanProfile one = mean_profile(laid_on(slabs, run), rows),
                    other = mean_profile(laid_on(slabs, reference), of_reference);
  if (one.all.slabs() != other.all.slabs() || std::abs(one.all.slab - other.all.slab) > 1e-9 * other.all.slab)
    throw core::FileError("the runs' profiles.h5 have other slabs");
  Means found;
  for (const Single<Beside>& distance : singles(distance_table(), run.species)) {
    const Value value = distance.of({one.all, other.all});
    if (!value) continue;
    found[distance.name] = {*value, joint_interval(of_each(one.without,
                                                           [&](const Profile& p) {
                                                             return distance.of({p, other.all});
                                                           }),
                                                   of_each(other.without, [&](const Profile& p) {
                                                     return distance.of({one.all, p});
                                                   }))};
  }
  return found;
}

}  // namespace polybed::measures
