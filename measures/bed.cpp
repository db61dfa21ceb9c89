#include "measures/bed.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace polybed::measures {

namespace {

constexpr std::size_t slice_count = 50;

double volume_of(const Profile& profile, std::size_t species, std::size_t k) {
  return std::max(profile.fraction[species][k], 0.0) * profile.slab * profile.area(k);
}

double volume_of(const Profile& profile, std::size_t k) {
  return std::max(profile.solids_fraction(k), 0.0) * profile.slab * profile.area(k);
}

double total_volume(const Profile& profile) {
  double sum = 0;
  for (std::size_t k = 0; k < profile.slabs(); ++k) sum += volume_of(profile, k);
  return sum;
}

/// Slices of equal solids volume from the bottom up: species shares and top of each.
struct Slices {
  std::vector<std::vector<double>> share;  ///< [slice][species]
  std::vector<double> top;                 ///< m
};

/// Volume of a species below a height per area, m.
double volume_below(const Profile& profile, std::size_t species, double z) {
  double sum = 0;
  for (std::size_t k = 0; k < profile.slabs(); ++k) {
    const double part = std::clamp(z / profile.slab - double(k), 0.0, 1.0);
    sum += part * volume_of(profile, species, k);
  }
  return sum;
}

std::optional<Slices> slices_of(const Profile& profile) {
  Slices slices;
  const std::size_t species = profile.fraction.size();
  std::vector<double> last(species, 0.0);
  for (std::size_t n = 1; n <= slice_count; ++n) {
    const auto top = volume_quantile(profile, double(n) / slice_count);
    if (!top) return std::nullopt;
    std::vector<double> share(species);
    double sum = 0;
    for (std::size_t j = 0; j < species; ++j) {
      const double below = volume_below(profile, j, *top);
      share[j] = below - last[j];
      last[j] = below;
      sum += share[j];
    }
    if (!(sum > 0)) return std::nullopt;
    for (double& x : share) x /= sum;
    slices.share.push_back(share);
    slices.top.push_back(*top);
  }
  return slices;
}

/// A straight line through the pressure of slabs: value at 0, slope, and the root mean square of what it misses.
struct PressureLine {
  double first = 0, second = 0, error = 0;
};

/// The line of least squares through the slabs whose centres are in a range.
std::optional<PressureLine> pressure_line(const Profile& profile, double from, double to) {
  double n = 0, z = 0, p = 0, zz = 0, zp = 0, squares = 0;
  for (std::size_t k = 0; k < profile.pressure.size(); ++k) {
    const double here = profile.centre(k);
    if (here < from || here > to) continue;
    n += 1;
    z += here;
    p += profile.pressure[k];
    zz += here * here;
    zp += here * profile.pressure[k];
  }
  if (n < 2) return std::nullopt;
  const double slope = (n * zp - z * p) / (n * zz - z * z);
  const PressureLine line{(p - slope * z) / n, slope};
  for (std::size_t k = 0; k < profile.pressure.size(); ++k)
    if (const double here = profile.centre(k); here >= from && here <= to)
      squares += std::pow(profile.pressure[k] - line.first - slope * here, 2);
  return PressureLine{line.first, slope, std::sqrt(squares / n)};
}

/// Highest z, m, where phi, linear between slab centres, equals half of its volume-weighted mean between two quantiles.
std::optional<double> half_of_mean(const Profile& profile, double from, double to) {
  const auto low = volume_quantile(profile, from), high = volume_quantile(profile, to);
  if (!low || !high) return std::nullopt;
  double weighted = 0, volume = 0;
  for (std::size_t k = 0; k < profile.slabs(); ++k) {
    const double bottom = double(k) * profile.slab, top = bottom + profile.slab;
    const double part = std::max(0.0, std::min(top, *high) - std::max(bottom, *low)) * profile.area(k);
    const double phi = std::max(profile.solids_fraction(k), 0.0);
    weighted += part * phi * phi;
    volume += part * phi;
  }
  if (!(volume > 0)) return std::nullopt;
  const double half = 0.5 * weighted / volume;
  for (std::size_t k = profile.slabs(); k-- > 0;) {
    const double here = profile.solids_fraction(k);
    if (here < half) continue;
    if (k + 1 == profile.slabs()) return profile.slab * double(profile.slabs());
    const double above = profile.solids_fraction(k + 1);
    return profile.centre(k) + profile.slab * (here - half) / (here - above);
  }
  return std::nullopt;
}

/// A cut above a slab, and how far it separates a species from all others.
struct Cut {
  double apart = 0;
  std::size_t species = 0, slab = 0;
  double share = 0;  ///< of the species: the mean of the shares below and above
};

/// 0 without solids.
double share_in(const Profile& profile, std::size_t species, std::size_t k) {
  const double all = volume_of(profile, k);
  return all > 0 ? volume_of(profile, species, k) / all : 0;
}

/// 2 integral |F_i - F_j| dh: 0 for a mixed pair, 1 for two layers. Both F are linear in h within a slab.
std::optional<double> separation(const Profile& profile, std::size_t i, std::size_t j) {
  const double top = profile.slab * double(profile.slabs());
  const double all_i = volume_below(profile, i, top), all_j = volume_below(profile, j, top);
  if (!(all_i > 0 && all_j > 0)) return std::nullopt;
  double sum = 0, before = 0;  // F_i - F_j at the bottom of the slab
  for (std::size_t k = 0; k < profile.slabs(); ++k) {
    const double vi = volume_of(profile, i, k), vj = volume_of(profile, j, k);
    const double after = before + vi / all_i - vj / all_j, ends = std::abs(before) + std::abs(after);
    const double mean = before * after >= 0 ? ends / 2 : (before * before + after * after) / (2 * ends);
    sum += mean * (vi + vj) / (all_i + all_j);
    before = after;
  }
  return 2 * sum;
}

}  // namespace

std::optional<double> volume_quantile(const Profile& profile, double q) {
  const double total = total_volume(profile);
  if (!(total > 0)) return std::nullopt;
  double below = 0;
  for (std::size_t k = 0; k < profile.slabs(); ++k) {
    const double here = volume_of(profile, k);
    if (here > 0 && below + here >= q * total * (1 - 1e-14))
      return profile.slab * (double(k) + std::clamp((q * total - below) / here, 0.0, 1.0));
    below += here;
  }
  return profile.slab * double(profile.slabs());
}

std::optional<double> bed_height(const Profile& profile) { return half_of_mean(profile, 0.80, 0.95); }

std::optional<double> dense_height(const Profile& profile) { return half_of_mean(profile, 0.0, 0.50); }

Profile merged(const Profile& profile, std::span<const std::size_t> species) {
  Profile one{profile.slab, {std::vector<double>(profile.slabs(), 0.0)}, {}, profile.areas};
  for (const std::size_t j : species)
    for (std::size_t k = 0; k < one.slabs(); ++k) one.fraction[0][k] += profile.fraction[j][k];
  return one;
}

std::optional<double> bed_height_by_pressure(const Profile& profile) {
  const auto low = volume_quantile(profile, 0.10), high = volume_quantile(profile, 0.80), surface = bed_height(profile);
  if (!low || !high || !surface) return std::nullopt;
  const double top = profile.slab * double(profile.slabs());
  const auto bed = pressure_line(profile, *low, *high), freeboard = pressure_line(profile, 1.1 * *surface, top);
  if (!bed || !freeboard || bed->second == freeboard->second) return std::nullopt;
  // Two layers have two gradients: a line over both misses 0.072 of their difference, in units of the mean gradient, if
  // they meet in its middle. Where it misses 2 % of the drop, the height is 6 % off.
  // Bubbles of one species make as large an error, but not always the same one.
  constexpr double most_missed = 0.02, apart = 0.5;
  const bool layered = mixing(profile).value_or(1) < apart;
  if (layered && bed->error > most_missed * std::abs(bed->second) * (*high - *low)) return std::nullopt;
  const double crossing = (freeboard->first - bed->first) / (bed->second - freeboard->second);
  return crossing > 0 && crossing < top ? std::optional(crossing) : std::nullopt;
}

std::optional<double> centre(const Profile& profile, std::size_t species) {
  double moment = 0, volume = 0;
  for (std::size_t k = 0; k < profile.slabs(); ++k) {
    moment += profile.centre(k) * profile.fraction[species][k] * profile.area(k);
    volume += profile.fraction[species][k] * profile.area(k);
  }
  return volume > 0 ? std::optional(moment / volume) : std::nullopt;
}

std::optional<double> centre_difference(const Profile& profile) {
  if (profile.fraction.size() < 2) return std::nullopt;
  const auto first = centre(profile, 0), second = centre(profile, 1), height = bed_height(profile);
  return first && second && height && *height > 0 ? std::optional((*second - *first) / *height) : std::nullopt;
}

std::optional<double> interface_height(const Profile& profile) {
  constexpr double least = 0.05;  // difference of two layers
  const std::size_t species = profile.fraction.size();
  const auto surface = bed_height(profile);
  if (species < 2 || !surface) return std::nullopt;
  const double all = total_volume(profile);
  Cut most;
  for (std::size_t j = 0; j < species; ++j) {
    const double whole = volume_below(profile, j, profile.slab * double(profile.slabs()));
    if (!(whole > 0 && whole < all)) continue;
    double one = 0, both = 0;
    for (std::size_t k = 0; k + 1 < profile.slabs(); ++k) {
      one += volume_of(profile, j, k);
      both += volume_of(profile, k);
      const double apart = std::abs(one / whole - (both - one) / (all - whole));
      if (apart > most.apart + 1e-12) most = {apart, j, k, (one / both + (whole - one) / (all - both)) / 2};
    }
  }
  if (most.apart < least) return surface;
  const double lower = share_in(profile, most.species, most.slab),
               upper = share_in(profile, most.species, most.slab + 1);
  const double part = lower != upper ? std::clamp((lower - most.share) / (lower - upper), 0.0, 1.0) : 0.5;
  return std::min(profile.centre(most.slab) + part * profile.slab, *surface);
}

std::optional<double> mixing(const Profile& profile) {
  double sum = 0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < profile.fraction.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (const auto apart = separation(profile, i, j)) {
        sum += 1 - *apart;
        ++pairs;
      }
  return pairs > 0 ? std::optional(sum / double(pairs)) : std::nullopt;
}

std::optional<double> profile_distance(const Profile& profile, const Profile& reference, std::size_t species) {
  const std::vector<double>&phi = profile.fraction.at(species), &phi_ref = reference.fraction.at(species);
  if (phi.size() != phi_ref.size() || std::abs(profile.slab - reference.slab) > 1e-9 * reference.slab)
    throw std::invalid_argument("profiles of other slabs");
  double difference = 0, sum = 0;
  for (std::size_t k = 0; k < phi.size(); ++k) {
    difference += std::abs(phi[k] - phi_ref[k]) * profile.area(k);
    sum += phi_ref[k] * profile.area(k);
  }
  return sum > 0 ? std::optional(difference / sum) : std::nullopt;
}

std::optional<double> profile_distance(const Profile& profile, const Profile& reference) {
  double sum = 0, count = 0;
  for (std::size_t j = 0; j < profile.fraction.size(); ++j)
    if (const auto distance = profile_distance(profile, reference, j)) {
      sum += *distance;
      count += 1;
    }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

std::optional<double> composition_distance(const Profile& profile, const Profile& reference) {
  if (profile.fraction.size() < 2 || profile.fraction.size() != reference.fraction.size()) return std::nullopt;
  const auto slices = slices_of(profile), slices_ref = slices_of(reference);
  if (!slices || !slices_ref) return std::nullopt;
  double sum = 0;
  for (std::size_t n = 0; n < slice_count; ++n)
    for (std::size_t j = 0; j < profile.fraction.size(); ++j)
      sum += 0.5 * std::abs(slices->share[n][j] - slices_ref->share[n][j]);
  return sum / slice_count;
}

double pressure_drop(const Profile& profile) {
  const auto& p = profile.pressure;
  if (p.empty()) return 0;
  if (p.size() == 1) return 2 * p[0];
  const std::size_t n = p.size();
  return (1.5 * p[0] - 0.5 * p[1]) - (1.5 * p[n - 1] - 0.5 * p[n - 2]);
}

}  // namespace polybed::measures
