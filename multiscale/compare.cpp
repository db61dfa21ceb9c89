#include "multiscale/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "measures/bed.hpp"

namespace polybed::multiscale {

namespace {

constexpr double enough = 30;                            // autocorrelation times in a window: cost.md, section 6
constexpr double composition_goal_near_inversion = 0.1;  // calibration.md, section 8
constexpr double window_parts = 4;                       // windows in a run, likewise

double half_width(double variance, std::size_t degrees) {
  return measures::student_quantile(degrees) * std::sqrt(variance);
}

/// The interface of the mean profile, as the thesis defines it.
std::optional<measures::TimeMean> interface_of(const WindowProfiles& profiles) {
  if (profiles.count() == 0) return std::nullopt;
  const auto found = measures::interface_height(profiles.mean());
  if (!found) return std::nullopt;
  measures::TimeMean mean{*found, std::nullopt};
  if (const auto j = measures::jackknife(
          profiles.count(), [&](const auto& kept) { return measures::interface_height(profiles.mean(kept)); }))
    mean.error = half_width(j->variance, j->degrees);
  return mean;
}

/// A distance between the mean profiles, its interval from leaving out groups of either model's.
template <class Distance>
Score distance_score(const std::string& name, const WindowProfiles& tfm, const WindowProfiles& dem,
                     std::optional<double> goal, const Distance& distance) {
  Score score{name, std::nullopt, std::nullopt, goal};
  if (tfm.count() == 0 || dem.count() == 0) return score;
  const measures::Profile tfm_mean = tfm.mean(), dem_mean = dem.mean();
  score.value = distance(tfm_mean, dem_mean);
  const auto of_tfm =
      measures::jackknife(tfm.count(), [&](const auto& kept) { return distance(tfm.mean(kept), dem_mean); });
  const auto of_dem =
      measures::jackknife(dem.count(), [&](const auto& kept) { return distance(tfm_mean, dem.mean(kept)); });
  if (score.value && of_tfm && of_dem)
    score.error = half_width(of_tfm->variance + of_dem->variance, std::min(of_tfm->degrees, of_dem->degrees));
  return score;
}

/// Makes a comparison piece by piece.
class Comparer {
 public:
  Comparer(const Measured& tfm, const Measured& dem, std::vector<std::string> species)
      : tfm_(tfm),
        dem_(dem),
        species_(std::move(species)),
        window_(window_of(tfm, dem)),
        tfm_profiles_(tfm.profiles, species_, window_),
        dem_profiles_(dem.profiles, species_, window_) {
    result_.window = window_;
    result_.tfm_profiles = tfm_profiles_.count();
    result_.dem_profiles = dem_profiles_.count();
    result_.species = species_;
    result_.height = tfm.profiles.height;
    result_.tfm_means = tfm_profiles_.time_means();
    result_.dem_means = dem_profiles_.time_means();
  }

  Comparison make() && {
    measures();
    scores();
    if (species_.size() > 1) {
      result_.tfm_top = on_top([](const ComparedMeasure& m) { return m.tfm; });
      result_.dem_top = on_top([](const ComparedMeasure& m) { return m.dem; });
    }
    warn_of_run("tfm", tfm_.history, [](const ComparedMeasure& m) { return m.tfm; });
    warn_of_run("dem", dem_.history, [](const ComparedMeasure& m) { return m.dem; });
    if (result_.tfm_profiles == 0 || result_.dem_profiles == 0)
      result_.warnings.emplace_back("no stored profile of both runs in the window: a smaller output.every stores more");
    return std::move(result_);
  }

 private:
  template <class Values>
  void add(const std::string& name, const Values& values_of) {
    const auto mean = [&](const core::History& history) {
      return measures::time_mean(within(history.of("time_s"), values_of(history), window_));
    };
    result_.measures.push_back({name, mean(tfm_.history), mean(dem_.history)});
  }

  void add_column(const std::string& column) {
    add(column, [&](const core::History& history) { return history.of(column); });
  }

  void measures() {
    add_column("bed_height_m");
    add_column("pressure_drop_Pa");
    add("pressure_drop_over_weight",
        [](const core::History& h) { return ratio(h.of("pressure_drop_Pa"), h.of("buoyant_weight_Pa")); });
    for (const std::string& name : species_) add_column(centre_column(name));
    if (species_.size() < 2) return;
    add("centre_difference", [&](const core::History& h) { return centre_difference(h, species_); });
    add_column("mixing");
    result_.measures.push_back({"interface_m", interface_of(tfm_profiles_), interface_of(dem_profiles_)});
  }

  [[nodiscard]] const ComparedMeasure& measure(const std::string& name) const {
    return *std::find_if(result_.measures.begin(), result_.measures.end(),
                         [&](const auto& m) { return m.name == name; });
  }

  /// Goals of calibration.md, section 8.
  void scores() {
    Score height{"e_H", std::nullopt, std::nullopt, 0.05};
    if (const ComparedMeasure& h = measure("bed_height_m"); h.tfm && h.dem) {
      const double quotient = h.tfm->mean / h.dem->mean;
      height.value = quotient - 1;
      if (h.tfm->error && h.dem->error)
        height.error = std::hypot(*h.tfm->error / h.dem->mean, quotient * *h.dem->error / h.dem->mean);
    }
    result_.scores.push_back(height);
    if (species_.size() > 1) {
      const ComparedMeasure& b = measure("centre_difference");
      result_.scores.push_back({"e_b", b.difference(), b.difference_error(), 0.05});
      result_.scores.push_back(
          distance_score("D1", tfm_profiles_, dem_profiles_, 0.05, measures::composition_distance));
    }
    for (std::size_t j = 0; j < species_.size(); ++j)
      result_.scores.push_back(
          distance_score("profile_" + species_[j], tfm_profiles_, dem_profiles_, std::nullopt,
                         [&](const auto& a, const auto& b) { return measures::profile_distance(a, b, j); }));
  }

  template <class Side>
  [[nodiscard]] std::optional<OnTop> on_top(const Side& side) const {
    std::vector<std::pair<measures::TimeMean, std::string>> centres;
    for (const std::string& name : species_) {
      const std::optional<measures::TimeMean> mean = side(measure(centre_column(name)));
      if (!mean) return std::nullopt;
      centres.emplace_back(*mean, name);
    }
    std::sort(centres.begin(), centres.end(), [](const auto& a, const auto& b) { return a.first.mean > b.first.mean; });
    const measures::TimeMean &first = centres[0].first, &second = centres[1].first;
    const bool certain =
        first.error && second.error && first.mean - second.mean > std::hypot(*first.error, *second.error);
    return OnTop{centres[0].second, certain};
  }

  /// What makes a mean of a run less than it seems: a window too short, a run that still drifts.
  template <class Side>
  void warn_of_run(const std::string& model, const core::History& history, const Side& side) {
    const Series time = within(history.of("time_s"), history.of("time_s"), window_);
    if (time.size() < 20)
      result_.warnings.push_back(fmt::format(
          "{}: {} rows of its history in the window: intervals need 20; a smaller output.history_every gives more",
          model, time.size()));
    const double step = time.size() > 1 ? (time.back() - time.front()) / double(time.size() - 1) : 0;
    double longest = 0;
    std::string slowest;
    for (const ComparedMeasure& m : result_.measures)
      if (const std::optional<measures::TimeMean> mean = side(m); mean && mean->error && mean->correlation > longest) {
        longest = mean->correlation;
        slowest = m.name;
      }
    if (double(time.size()) < enough * longest)
      result_.warnings.push_back(fmt::format("{}: window too short for {}: run at least {:.3g} s", model, slowest,
                                             window_parts * enough * longest * step));
    warn_of_drift(model, history);
  }

  void warn_of_drift(const std::string& model, const core::History& history) {
    for (const std::string& line : drifts_in(history, species_, window_))
      result_.warnings.push_back(model + ": " + line);
  }

  const Measured &tfm_, &dem_;
  std::vector<std::string> species_;
  Window window_;
  WindowProfiles tfm_profiles_, dem_profiles_;
  Comparison result_;
};

}  // namespace

std::optional<double> ComparedMeasure::difference() const {
  return tfm && dem ? std::optional(tfm->mean - dem->mean) : std::nullopt;
}

std::optional<double> ComparedMeasure::difference_error() const {
  return tfm && dem && tfm->error && dem->error ? std::optional(std::hypot(*tfm->error, *dem->error)) : std::nullopt;
}

std::optional<bool> Score::reached() const {
  return value && goal ? std::optional(std::abs(*value) <= *goal) : std::nullopt;
}

void take_up(Comparison& comparison, const FoundInversion& found, double velocity) {
  for (Score& score : comparison.scores)
    if (score.name == "D1" && found.near(velocity)) score.goal = composition_goal_near_inversion;
  comparison.scores.push_back({"u_inv", found.agreement.difference, found.agreement.error, found.agreement.goal});
  comparison.inversion_file = found.file.string();
}

Comparison compare(const Measured& tfm, const Measured& dem) {
  const std::vector<std::string> species = species_of(tfm.history);
  if (species != species_of(dem.history) || species.empty()) throw core::FileError("the runs are of other species");
  const std::vector<double>&y = tfm.profiles.height, &y_ref = dem.profiles.height;
  const bool same = y.size() == y_ref.size() && !y.empty() && std::abs(y.back() - y_ref.back()) < 1e-9 * y.back();
  if (!same) throw core::FileError("the runs' profiles.h5 have other slabs");
  return Comparer(tfm, dem, species).make();
}

}  // namespace polybed::multiscale
