#include "multiscale/compare_window.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "measures/drift.hpp"
#include "measures/time_mean.hpp"
#include "multiscale/run_record.hpp"

namespace polybed::multiscale {

namespace {

constexpr double window_share = 0.25;  // cost.md, section 6
constexpr double rounding = 1e-9;      // of times at the ends of the window

/// Where the marginal standard error rule would have the window begin, for one series.
double begin_by_rule(const core::History& history, const Series& values, const Window& window) {
  const Series time = within(history.of("time_s"), history.of("time_s"), window);
  const std::size_t drop = measures::rows_to_drop(within(history.of("time_s"), values, window));
  return drop > 0 && drop < time.size() ? time[drop] : window.begin;
}

Window common_window(const std::vector<const core::History*>& histories) {
  double first = 0, last = std::numeric_limits<double>::infinity();
  std::string spans;
  for (const core::History* history : histories) {
    const Series& time = history->of("time_s");
    if (time.empty()) throw core::FileError("a history without a row: nothing to compare");
    first = std::max(first, time.front());
    last = std::min(last, time.back());
    spans += fmt::format("{}{:.4g} to {:.4g} s", spans.empty() ? "" : " and ", time.front(), time.back());
  }
  if (!(last > first)) throw core::FileError("the runs have no time in common: " + spans);
  const Window quarter{last - window_share * (last - first), last, false};
  double begin = quarter.begin;
  for (const core::History* history : histories)
    for (const Series& values : {history->of("bed_height_m"), centre_difference(*history, species_of(*history))})
      begin = std::max(begin, begin_by_rule(*history, values, quarter));
  return {begin, last, begin > quarter.begin};
}

}  // namespace

Series ratio(const Series& above, const Series& below) {
  Series found;
  for (std::size_t n = 0; n < above.size(); ++n)
    found.push_back(below[n] > 0 ? above[n] / below[n] : std::numeric_limits<double>::quiet_NaN());
  return found;
}

std::string centre_column(const std::string& species) { return "centre_" + species + "_m"; }

/// Centre of species 2 less that of species 1, over the bed height; empty for one species.
Series centre_difference(const core::History& history, const std::vector<std::string>& species) {
  if (species.size() < 2) return {};
  Series found = history.of(centre_column(species[1]));
  const Series& first = history.of(centre_column(species[0]));
  for (std::size_t n = 0; n < found.size(); ++n) found[n] -= first[n];
  return ratio(found, history.of("bed_height_m"));
}

/// The part of a series in the window, of a history with these times.
Series within(const Series& time, const Series& values, const Window& window) {
  const double slack = rounding * window.end;
  Series found;
  for (std::size_t n = 0; n < values.size(); ++n)
    if (time[n] >= window.begin - slack && time[n] <= window.end + slack) found.push_back(values[n]);
  return found;
}

WindowProfiles::WindowProfiles(const core::Profiles& profiles, const std::vector<std::string>& species,
                               const Window& window)
    : slab_(2 * profiles.height.at(0)), slabs_(profiles.height.size()) {
  const double slack = rounding * window.end;
  for (const std::string& name : species) values_.push_back(&profiles.of("phi_" + name).values);
  for (std::size_t n = 0; n < profiles.time.size(); ++n)
    if (profiles.time[n] >= window.begin - slack && profiles.time[n] <= window.end + slack) rows_.push_back(n);
}

measures::Profile WindowProfiles::mean(const std::vector<bool>& kept) const {
  measures::Profile found;
  found.slab = slab_;
  found.fraction.assign(values_.size(), Series(slabs_, 0.0));
  const double all = kept.empty() ? double(count()) : double(std::count(kept.begin(), kept.end(), true));
  for (std::size_t j = 0; j < values_.size(); ++j)
    for (std::size_t n = 0; n < rows_.size(); ++n)
      if (kept.empty() || kept[n])
        for (std::size_t k = 0; k < slabs_; ++k) found.fraction[j][k] += (*values_[j])[rows_[n] * slabs_ + k] / all;
  return found;
}

MeanProfiles WindowProfiles::time_means() const {
  MeanProfiles found(values_.size());
  if (rows_.empty()) return found;
  for (std::size_t j = 0; j < values_.size(); ++j)
    for (std::size_t k = 0; k < slabs_; ++k) {
      const auto mean_of = [&](const std::vector<bool>& kept) {
        double sum = 0, count = 0;
        for (std::size_t n = 0; n < rows_.size(); ++n)
          if (kept[n]) {
            sum += (*values_[j])[rows_[n] * slabs_ + k];
            ++count;
          }
        return sum / count;
      };
      measures::TimeMean mean{mean_of(std::vector<bool>(rows_.size(), true)), std::nullopt};
      if (const auto left_out = measures::jackknife(rows_.size(), mean_of))
        mean.error = measures::student_quantile(left_out->degrees) * std::sqrt(left_out->variance);
      found[j].push_back(mean);
    }
  return found;
}

std::vector<std::string> species_of(const core::History& history) {
  const std::string front = "centre_", back = "_m";
  std::vector<std::string> names;
  for (const std::string& column : history.columns)
    if (column.starts_with(front) && column.ends_with(back))
      names.push_back(column.substr(front.size(), column.size() - front.size() - back.size()));
  return names;
}

std::vector<std::string> drifts_in(const core::History& history, const std::vector<std::string>& species,
                                   const Window& window) {
  std::vector<std::string> names{"bed_height"};
  for (const std::string& name : species) names.push_back("centre_" + name);
  measures::Drifts drifts(names);
  const Series& time = history.of("time_s");
  for (std::size_t n = 0; n < time.size() && time[n] <= window.end; ++n) {
    std::vector<std::optional<double>> row;
    for (const std::string& name : names) row.emplace_back(history.of(name + "_m")[n]);
    drifts.see(time[n], row);
  }
  return drift_lines(drifts);
}

Window window_of(const Measured& tfm, const Measured& dem) { return common_window({&tfm.history, &dem.history}); }

Window window_of(const core::History& history) { return common_window({&history}); }

}  // namespace polybed::multiscale
