#include "dem/parallel/decomposition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/error.hpp"

namespace polybed::dem {

namespace {

/// The longest direction of a part.
std::size_t longest(const Part& part) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (part.high[k] - part.low[k] > (part.high[axis] - part.low[axis]) * (1 + 1e-9)) axis = k;
  return axis;
}

std::pair<Part, Part> halves(const Part& part, std::size_t axis, double at) {
  std::pair<Part, Part> halves{part, part};
  halves.first.high[axis] = halves.second.low[axis] = at;
  return halves;
}

double even_place(const Part& part, std::size_t axis, int below, int count) {
  return part.low[axis] + (part.high[axis] - part.low[axis]) * below / count;
}

/// Thickness of the thinnest part after equal cuts, m; infinite without a cut.
double thinnest(const Part& part, int count) {
  if (count == 1) return std::numeric_limits<double>::infinity();
  const std::size_t axis = longest(part);
  const int below = count / 2;
  const auto [one, other] = halves(part, axis, even_place(part, axis, below, count));
  return std::min({one.high[axis] - one.low[axis], other.high[axis] - other.low[axis], thinnest(one, below),
                   thinnest(other, count - below)});
}

}  // namespace

Decomposition::Decomposition(const Box& box, std::shared_ptr<const core::Ranks> ranks, double least)
    : box_(box), ranks_(std::move(ranks)), least_(least * (1 - 1e-9)) {
  if (ranks_) {
    rank_ = ranks_->rank();
    count_ = ranks_->count();
  }
  if (box.shear_rate != 0 && count_ > 1)
    throw core::StartError("dem.shear_rate: a sheared box runs on one rank; run several boxes at once instead");
  parts_.resize(std::size_t(count_));
  const double thickness = thinnest({{0, 0, 0}, box.size}, count_);
  if (thickness < least_)
    throw core::StartError(
        fmt::format("{} ranks would own parts of {:.3g} m, thinner than the largest particle, {:.3g} m: use fewer",
                    count_, thickness, least));
  balance({}, {});
}

int Decomposition::owner(const Vector& x) const {
  int node = cuts_.empty() ? -1 : 0;
  while (node >= 0) {
    const Cut& cut = cuts_[std::size_t(node)];
    node = x[cut.axis] < cut.at ? cut.low : cut.high;
  }
  return -1 - node;
}

std::array<bool, 3> Decomposition::whole(double reach) const {
  std::array<bool, 3> whole;
  for (std::size_t k = 0; k < 3; ++k) whole[k] = own().high[k] - own().low[k] > box_.size[k] - 2 * reach;
  return whole;
}

/// Whether a place is in a part; the outer parts extend beyond the box.
bool Decomposition::holds(const Part& part, const Vector& x) const {
  for (std::size_t k = 0; k < 3; ++k)
    if ((x[k] < part.low[k] && part.low[k] > 0) || (x[k] >= part.high[k] && part.high[k] < box_.size[k])) return false;
  return true;
}

/// The place nearest to the wanted one (to a 64th of the way) that leaves room for the ranks on both sides.
double Decomposition::cut_near(double wanted, const Part& part, std::size_t axis, int below, int count) const {
  const double even = even_place(part, axis, below, count);
  constexpr int tries = 64;
  for (int n = 0; n < tries; ++n) {
    const double at = wanted + (even - wanted) * n / tries;
    const auto [one, other] = halves(part, axis, at);
    if (at - part.low[axis] >= least_ && part.high[axis] - at >= least_ && thinnest(one, below) >= least_ &&
        thinnest(other, count - below) >= least_)
      return at;
  }
  return even;  // every divided part has room for equal cuts
}

Vector Decomposition::centre() const {
  Vector centre;
  for (std::size_t k = 0; k < 3; ++k) centre[k] = 0.5 * (own().low[k] + own().high[k]);
  return centre;
}

double Decomposition::imbalance(std::span<const std::int32_t> work) const {
  std::vector<double> all(std::size_t(count_), 0.0);
  for (const std::int32_t w : work) all[std::size_t(rank_)] += w;
  core::add_over_ranks(ranks_.get(), all);
  double sum = 0, most = 0;
  for (const double w : all) {
    sum += w;
    most = std::max(most, w);
  }
  return sum > 0 ? most * count_ / sum : 1;
}

/// Place along an axis with a share of the work in a part below it, to a 4096th of its length; the middle without work.
/// Sums of whole numbers: every rank gets the same result.
double Decomposition::quantile(std::span<const Place> place, std::span<const std::int32_t> work,
                               std::span<const char> inside, const Part& part, std::size_t axis, double share) const {
  constexpr std::size_t bins = 4096;
  const double low = part.low[axis], length = part.high[axis] - low;
  std::vector<double> histogram(bins, 0.0);
  for (std::size_t i = 0; i < place.size(); ++i)
    if (inside[i] != 0)
      histogram[std::size_t(std::clamp((place[i].x[axis] - low) / length * bins, 0.0, bins - 1.0))] += work[i];
  core::add_over_ranks(ranks_.get(), histogram);
  double sum = 0, below = 0;
  for (const double w : histogram) sum += w;
  if (sum == 0) return low + share * length;
  std::size_t bin = 0;
  while (bin < bins && below + 0.5 * histogram[bin] < share * sum) below += histogram[bin++];
  return low + length * double(bin) / bins;
}

void Decomposition::balance(std::span<const Place> place, std::span<const std::int32_t> work) {
  struct Open {
    Part part;
    int first, count, parent;
    bool high;
  };
  cuts_.clear();
  const Part all{{0, 0, 0}, box_.size};
  std::vector<Open> open{{all, 0, count_, -1, false}};
  std::vector<char> inside(place.size());
  while (!open.empty()) {
    const Open now = open.back();
    open.pop_back();
    const int node = now.count == 1 ? -1 - now.first : int(cuts_.size());
    if (now.parent >= 0) (now.high ? cuts_[std::size_t(now.parent)].high : cuts_[std::size_t(now.parent)].low) = node;
    if (now.count == 1) {
      parts_[std::size_t(now.first)] = now.part;
      continue;
    }
    const std::size_t axis = longest(now.part);
    const int below = now.count / 2;
    for (std::size_t i = 0; i < place.size(); ++i) inside[i] = holds(now.part, place[i].x) ? 1 : 0;
    const double wanted = quantile(place, work, inside, now.part, axis, double(below) / now.count);
    const double at = cut_near(wanted, now.part, axis, below, now.count);
    const auto [one, other] = halves(now.part, axis, at);
    cuts_.push_back({axis, at, 0, 0});
    open.push_back({other, now.first + below, now.count - below, node, true});
    open.push_back({one, now.first, below, node, false});
  }
}

}  // namespace polybed::dem
