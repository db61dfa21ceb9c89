#include "multiscale/cost/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "measures/bed.hpp"

namespace polybed::multiscale {

namespace {

constexpr double enough = 30;  ///< autocorrelation times in a window: cost.md, section 6

using OfProfile = std::function<std::optional<double>(const measures::Profile&)>;

/// Mean, over the profiles in the window, of what a quantity changes by from the run's slabs to those asked for.
double change_of_slabs(const WindowProfiles& profiles, const MeasureOn& on, const OfProfile& quantity) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < profiles.count(); ++n) {
    std::vector<bool> kept(profiles.count(), false);
    kept[n] = true;
    const measures::Profile own = profiles.mean(kept);
    const auto here = quantity(own), there = quantity(measures::on_slabs(own, on.slab, on.count));
    if (!here || !there) continue;
    sum += *there - *here;
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

/// Dominant frequency of a series in equal steps, 1/s: the greatest term of its Fourier sum. Empty for a constant one.
std::optional<double> frequency_of(const Series& values, double step) {
  const std::size_t n = values.size();
  if (n < 8 || !(step > 0)) return std::nullopt;
  double mean = 0, most = 0;
  for (const double v : values) mean += v / double(n);
  std::size_t best = 0;
  for (std::size_t k = 1; k <= n / 2; ++k) {
    double re = 0, im = 0;
    for (std::size_t m = 0; m < n; ++m) {
      const double angle = 2 * std::numbers::pi * double(k) * double(m) / double(n);
      re += (values[m] - mean) * std::cos(angle);
      im += (values[m] - mean) * std::sin(angle);
    }
    if (re * re + im * im > most) {
      most = re * re + im * im;
      best = k;
    }
  }
  return best > 0 ? std::optional(double(best) / (double(n) * step)) : std::nullopt;
}

class Measurer {
 public:
  Measurer(const Measured& run, const MeasureOn& on)
      : run_(run), on_(on), species_(species_of(run.history)), profiles_(run.profiles, species_, on.window) {}

  RunQuantities make() && {
    const core::History& h = run_.history;
    add("bed_height", h.of("bed_height_m"), [](const measures::Profile& p) { return measures::bed_height(p); });
    for (std::size_t j = 0; j < species_.size(); ++j)
      add("centre_" + species_[j], h.of(centre_column(species_[j])),
          [j](const measures::Profile& p) { return measures::centre(p, j); });
    const Series drop = ratio(h.of("pressure_drop_Pa"), h.of("buoyant_weight_Pa"));
    add("pressure_drop", drop, {});
    if (species_.size() > 1) {
      add("centre_difference", centre_difference(h, species_), {});
      add("mixing", h.of("mixing"), {});
    }
    add_fluctuations(within(h.of("time_s"), drop, on_.window));
    if (profiles_.count() > 0) add_of_mean_profile();
    return std::move(result_);
  }

 private:
  void add(const std::string& id, const Series& rows, const OfProfile& of_profile) {
    const Series in_window = within(run_.history.of("time_s"), rows, on_.window);
    auto mean = measures::time_mean(in_window);
    if (!mean) return;
    const bool same = std::abs(2 * run_.profiles.height.front() - on_.slab) < 1e-9 * on_.slab;
    if (of_profile && !same) mean->mean += change_of_slabs(profiles_, on_, of_profile);
    if (mean->error && *mean->error > 0 && double(in_window.size()) < enough * mean->correlation)
      result_.too_short = id;
    result_.values[id] = *mean;
  }

  void add_fluctuations(const Series& drop) {
    const auto mean = measures::time_mean(drop);
    if (!mean || drop.size() < 8) return;
    double square = 0;
    for (const double v : drop) square += std::pow(v - mean->mean, 2) / double(drop.size());
    result_.values["pressure_rms"] = {std::sqrt(square), std::nullopt, mean->correlation};
    const Series time = within(run_.history.of("time_s"), run_.history.of("time_s"), on_.window);
    const double step = (time.back() - time.front()) / double(time.size() - 1);
    if (const auto f = frequency_of(drop, step)) result_.values["pressure_frequency"] = {*f, std::nullopt, 1};
  }

  [[nodiscard]] measures::Profile mean(const std::vector<bool>& kept = {}) const {
    return measures::on_slabs(profiles_.mean(kept), on_.slab, on_.count);
  }

  void add_of_mean_profile() {
    result_.profile = mean();
    if (species_.size() < 2) return;
    const auto found = measures::interface_height(result_.profile);
    if (!found) return;
    measures::TimeMean value{*found, std::nullopt, 1};
    if (const auto j = measures::jackknife(profiles_.count(),
                                           [&](const auto& kept) { return measures::interface_height(mean(kept)); }))
      value.error = measures::student_quantile(j->degrees) * std::sqrt(j->variance);
    result_.values["interface"] = value;
  }

  const Measured& run_;
  const MeasureOn& on_;
  std::vector<std::string> species_;
  WindowProfiles profiles_;
  RunQuantities result_;
};

}  // namespace

std::vector<QuantityInfo> quantities_of(const std::vector<std::string>& species) {
  std::vector<QuantityInfo> all{
      {"bed_height", "m", "highest z where phi equals half of its mean between z_0.80 and z_0.95", Scale::length}};
  for (const std::string& name : species)
    all.push_back({"centre_" + name, "m", "mean height of the volume of the species", Scale::length});
  all.push_back({"pressure_drop", "1", "over the buoyant weight", Scale::share});
  if (species.size() > 1) {
    all.push_back(
        {"centre_difference", "1", "centre of species 2 less that of species 1, over bed_height", Scale::share});
    all.push_back({"mixing", "1", "1 mixed, 0 separated", Scale::share});
    all.push_back({"interface", "m", "top of the lower layer of the mean profile, x* = 0.05", Scale::length});
    all.push_back({"composition", "1", "distance in composition from the reference, over the volume", Scale::share});
  }
  all.push_back(
      {"profile", "1", "distance of the volume fractions from the reference, mean of the species", Scale::share});
  all.push_back({"pressure_rms", "1", "of the pressure drop over the buoyant weight", Scale::share});
  all.push_back({"pressure_frequency", "1/s", "of the greatest Fourier term of the pressure drop", Scale::itself});
  return all;
}

RunQuantities quantities_of_run(const Measured& run, const MeasureOn& on) { return Measurer(run, on).make(); }

std::map<std::string, double> distances(const measures::Profile& profile, const measures::Profile& reference) {
  std::map<std::string, double> found;
  if (const auto d = measures::composition_distance(profile, reference)) found["composition"] = *d;
  double sum = 0, count = 0;
  for (std::size_t j = 0; j < profile.fraction.size(); ++j)
    if (const auto d = measures::profile_distance(profile, reference, j)) {
      sum += *d;
      count += 1;
    }
  if (count > 0) found["profile"] = sum / count;
  return found;
}

}  // namespace polybed::multiscale
