#include "multiscale/cost/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace polybed::multiscale {

namespace {

constexpr double least_ratio = 1.3;
constexpr double safety_in_range = 1.25, safety_elsewhere = 3;

Refined scattered(const GridSequence& g, std::string note) {
  const auto [least, most] = std::minmax({g.coarse, g.medium, g.fine});
  Refined found;
  found.limit = g.fine;
  found.band = 3 * 0.5 * (most - least);
  found.note = std::move(note);
  return found;
}

std::optional<double> index_of(double safety, double step, double value, double growth) {
  return value != 0 ? std::optional(safety * std::abs(step) / (std::abs(value) * (growth - 1))) : std::nullopt;
}

}  // namespace

Refined refine(const GridSequence& g) {
  if (!(g.ratio >= least_ratio)) throw std::invalid_argument("grids of a ratio below 1.3");
  const double first = g.medium - g.fine, second = g.coarse - g.medium;
  if (first == 0 && second == 0) return scattered(g, "the same on all grids");
  if (!(first * second > 0)) return scattered(g, "not in the asymptotic range: the sequence is not monotone");
  const double observed = std::log(second / first) / std::log(g.ratio);
  if (!(observed > 0)) return scattered(g, "not in the asymptotic range: the differences do not shrink");
  Refined found;
  const bool in_range = observed >= g.formal_order / 2 && observed <= g.formal_order + 0.5;
  const double used = in_range ? observed : std::min(observed, g.formal_order);
  const double growth = std::pow(g.ratio, used);
  found.order = observed;
  found.safety = in_range ? safety_in_range : safety_elsewhere;
  if (!in_range) found.note = "the observed order is not that of the scheme";
  found.limit = g.fine - first / (growth - 1);
  found.band = found.safety * std::abs(first) / (growth - 1);
  found.fine_index = index_of(found.safety, first, g.fine, growth);
  found.coarse_index = index_of(found.safety, second, g.medium, growth);
  if (found.fine_index && found.coarse_index) found.asymptotic = *found.fine_index * growth / *found.coarse_index;
  return found;
}

}  // namespace polybed::multiscale
