#include "app/measure_means.hpp"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/error.hpp"

namespace polybed::app {

namespace {

using Numbers = std::vector<double>;

core::Json json_of(const measures::Means& means, bool in_time) {
  core::Json json = core::Json::object();
  for (const auto& [name, mean] : means) {
    json[name] = {{"mean", mean.mean}, {"interval", core::or_null(mean.interval)}};
    if (in_time) json[name]["correlation_rows"] = mean.correlation;
  }
  return json;
}

core::Json json_of(const measures::StoredRun& run, const measures::InWindow& found) {
  core::Json fraction = core::Json::object();
  for (std::size_t j = 0; j < run.species.size(); ++j) {
    core::Json mean = core::Json::array(), interval = core::Json::array();
    for (std::size_t k = 0; found.profiles > 0 && k < found.height.size(); ++k) {
      mean.push_back(found.mean[j][k].mean);
      interval.push_back(core::or_null(found.mean[j][k].interval));
    }
    fraction[run.species[j]] = {{"mean", mean}, {"interval", interval}};
  }
  return {
      {"rows", found.rows},
      {"step_s", found.step},
      {"means", json_of(found.means, true)},
      {"profiles", found.profiles},
      {"mean_profile", {{"y_m", found.height}, {"fraction", fraction}, {"measures", json_of(found.of_mean, false)}}}};
}

/// Numbers; NaN for null.
Numbers numbers_of(const core::Json& value) {
  Numbers found;
  for (const core::Json& number : core::array_of(value))
    found.push_back(number.is_null() ? std::numeric_limits<double>::quiet_NaN() : core::number_of(number));
  return found;
}

/// By its values without each of the groups of rows.
template <class Function>
core::Json interval_of(std::size_t rows, const Function& function) {
  std::vector<measures::Value> values;
  for (const measures::Rows& group : measures::groups_of(rows)) values.push_back(function(group));
  return core::or_null(measures::jackknife_interval(values));
}

core::Json means_of(const Numbers& values) {
  const std::optional<measures::TimeMean> mean = measures::time_mean(values);
  if (!mean) return nullptr;
  return {{"mean", mean->mean},
          {"interval", core::or_null(mean->interval)},
          {"interval_of_repeats", core::or_null(measures::interval_of_repeats(values))},
          {"deviation", measures::deviation_of(values)},
          {"deviation_interval", interval_of(values.size(), [&](const measures::Rows& group) {
             return measures::deviation_of(measures::without(values, group));
           })}};
}

core::Json ratio_of(const Numbers& above, const Numbers& below) {
  if (above.empty() || above.size() != below.size()) throw core::FileError("a ratio of rows that are not pairs");
  const auto ratio = [](const Numbers& a, const Numbers& b) {
    return std::accumulate(a.begin(), a.end(), 0.0) / std::accumulate(b.begin(), b.end(), 0.0);
  };
  return {{"value", ratio(above, below)}, {"interval", interval_of(above.size(), [&](const measures::Rows& group) {
                                             return ratio(measures::without(above, group),
                                                          measures::without(below, group));
                                           })}};
}

}  // namespace

void add_means(core::Json& json, const MeasureOptions& options, const measures::StoredRun& run,
               const measures::StoredRun* beside) {
  std::vector<const measures::StoredRun*> runs{&run};
  if (beside != nullptr) runs.push_back(beside);
  measures::Window window{options.begin.value_or(0), std::numeric_limits<double>::infinity()};
  try {
    if (!options.begin) window = measures::common_window(runs);
  } catch (const core::FileError&) {
    if (beside != nullptr) throw;
    json["in_window"] = nullptr;
    return;
  }
  window.end = options.end.value_or(window.end);
  for (const measures::StoredRun* one : runs)
    window.end = std::min(window.end, one->history.of("time_s").empty() ? 0 : one->history.of("time_s").back());
  json["window"] = {{"begin_s", window.begin}, {"end_s", window.end}, {"shortened", window.shortened}};
  json["in_window"] = json_of(run, measures::in_window(run, window, options.slabs));
  if (beside == nullptr) return;
  json["beside"] = json_of(*beside, measures::in_window(*beside, window, options.slabs));
  json["distances"] = json_of(measures::distances(run, *beside, window), false);
}

core::Json means_of_series(const core::Json& asked) {
  core::Json found = {{"series", core::Json::array()}, {"ratios", core::Json::array()}};
  if (asked.contains("series"))
    for (const core::Json& values : core::array_of(asked["series"]))
      found["series"].push_back(means_of(numbers_of(values)));
  if (asked.contains("ratios"))
    for (const core::Json& pair : core::array_of(asked["ratios"]))
      found["ratios"].push_back(
          ratio_of(numbers_of(core::member_of(pair, "above")), numbers_of(core::member_of(pair, "below"))));
  return found;
}

}  // namespace polybed::app
