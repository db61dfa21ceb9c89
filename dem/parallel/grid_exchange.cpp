#include "dem/parallel/grid_exchange.hpp"

#include <algorithm>
#include <cmath>

#include "dem/coupling/weights.hpp"

namespace polybed::dem {

GridExchange::GridExchange(core::Grid column, core::Grid block, std::shared_ptr<const core::Ranks> ranks)
    : column_(std::move(column)), block_(std::move(block)), ranks_(std::move(ranks)) {
  Region own;
  for (std::size_t a = 0; a < 3; ++a) {
    own.low[a] = block_.before[a];
    own.high[a] = block_.before[a] + block_.cells[a];
    // The faces at the column's high end belong to the last block.
    if (int(a) < block_.dimensions && block_.after[a] == 0) ++own.high[a];
  }
  owned_ = of_all(own);
  touched_.resize(owned_.size());
}

std::vector<GridExchange::Region> GridExchange::of_all(const Region& own) const {
  const auto ranks = std::size_t(ranks_->count());
  std::vector<std::int64_t> corners(6 * ranks, 0);
  for (std::size_t a = 0; a < 3; ++a) {
    corners[6 * std::size_t(ranks_->rank()) + a] = own.low[a];
    corners[6 * std::size_t(ranks_->rank()) + 3 + a] = own.high[a];
  }
  core::add_over_ranks(ranks_.get(), corners);
  std::vector<Region> all(ranks);
  for (std::size_t r = 0; r < ranks; ++r)
    for (std::size_t a = 0; a < 3; ++a) {
      all[r].low[a] = int(corners[6 * r + a]);
      all[r].high[a] = int(corners[6 * r + 3 + a]);
    }
  return all;
}

void GridExchange::choose(const Region& own) { touched_ = of_all(own); }

void GridExchange::choose_all() {
  Region all;
  for (std::size_t a = 0; a < 3; ++a) all.high[a] = column_.cells[a] + (int(a) < column_.dimensions ? 1 : 0);
  choose(all);
}

void GridExchange::choose(const Particles& particles) {
  constexpr int margin = 2;  // cells that particles can cross before the next choice
  Region own;
  for (std::size_t a = 0; a < 3; ++a) {
    if (particles.owned == 0) continue;
    const bool active = int(a) < column_.dimensions;
    const int end = column_.cells[a] + (active ? 1 : 0);
    double least = particles.place[0].x[a], most = least;
    for (std::size_t i = 0; i < particles.owned; ++i) {
      least = std::min(least, particles.place[i].x[a]);
      most = std::max(most, particles.place[i].x[a]);
    }
    const double per_spacing = 1 / column_.spacing[a];
    const auto in_cells = [&](double x) {
      return a == 1 && column_.layers ? in_layers(*column_.layers, x) : x * per_spacing;
    };
    const int low = int(std::floor(in_cells(least) - 0.5)) - margin;
    const int high = int(std::floor(in_cells(most))) + 2 + margin;
    const bool around = column_.periodic[a] && (low < 0 || high > column_.cells[a]);
    own.low[a] = around || !active ? 0 : std::clamp(low, 0, end - 1);
    own.high[a] = around || !active ? end : std::clamp(high, 1, end);
  }
  choose(own);
}

GridExchange::Region GridExchange::common(const Region& a, const Region& b) {
  Region both;
  for (std::size_t k = 0; k < 3; ++k) {
    both.low[k] = std::max(a.low[k], b.low[k]);
    both.high[k] = std::max(both.low[k], std::min(a.high[k], b.high[k]));
  }
  return both;
}

std::size_t GridExchange::size(const Region& region) {
  std::size_t entries = 1;
  for (std::size_t k = 0; k < 3; ++k) entries *= std::size_t(region.high[k] - region.low[k]);
  return entries;
}

template <class Body>
void GridExchange::for_each_entry(const Region& region, Body&& body) const {
  const std::array<int, 3>& before = block_.before;
  for (int k = region.low[2]; k < region.high[2]; ++k)
    for (int j = region.low[1]; j < region.high[1]; ++j)
      for (int i = region.low[0]; i < region.high[0]; ++i)
        body(std::size_t(column_.index(i, j, k)),
             std::size_t(block_.index(i - before[0], j - before[1], k - before[2])));
}

void GridExchange::add(std::size_t width, std::span<const std::int64_t> column, std::span<std::int64_t> block) const {
  const auto own = std::size_t(ranks_->rank());
  std::vector<int> counts;
  std::vector<std::int64_t> out;
  for (const Region& owner : owned_) {
    const Region region = common(touched_[own], owner);
    counts.push_back(int(size(region) * width));
    for_each_entry(region, [&](std::size_t at, std::size_t) {
      out.insert(out.end(), column.begin() + std::ptrdiff_t(at * width),
                 column.begin() + std::ptrdiff_t((at + 1) * width));
    });
  }
  core::Messages messages(ranks_, counts);
  std::vector<std::int64_t> in(messages.incoming());
  messages.start(std::span<const std::int64_t>(out), std::span<std::int64_t>(in));
  messages.finish();
  std::fill(block.begin(), block.end(), 0);
  const std::int64_t* from = in.data();
  for (const Region& sender : touched_)
    for_each_entry(common(sender, owned_[own]), [&](std::size_t, std::size_t at) {
      for (std::size_t q = 0; q < width; ++q) block[at * width + q] += *from++;
    });
}

void GridExchange::fetch(std::span<const std::pair<const core::Field*, core::Field*>> block_to_column) const {
  const auto own = std::size_t(ranks_->rank());
  std::vector<int> counts;
  std::vector<double> out;
  for (const Region& asking : touched_) {
    const Region region = common(asking, owned_[own]);
    counts.push_back(int(size(region) * block_to_column.size()));
    for_each_entry(region, [&](std::size_t, std::size_t at) {
      for (const auto& fields : block_to_column) out.push_back((*fields.first)[at]);
    });
  }
  core::Messages messages(ranks_, counts);
  std::vector<double> in(messages.incoming());
  messages.start(std::span<const double>(out), std::span<double>(in));
  messages.finish();
  const double* from = in.data();
  for (const Region& owner : owned_)
    for_each_entry(common(touched_[own], owner), [&](std::size_t at, std::size_t) {
      for (const auto& fields : block_to_column) (*fields.second)[at] = *from++;
    });
}

}  // namespace polybed::dem
