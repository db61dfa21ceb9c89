#include "dem/parallel/ordered_rows.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "core/numerics/messages.hpp"

namespace polybed::dem {

namespace {

constexpr std::size_t rows_of_piece = 1 << 14;  ///< per rank, about
constexpr std::size_t ids = 2;                  ///< sent before a row

/// The rows sorted by the ids that precede them.
std::vector<double> sorted_rows(const std::vector<double>& come, std::size_t width) {
  const std::size_t stride = ids + width;
  std::vector<const double*> order(come.size() / stride);
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = come.data() + n * stride;
  std::sort(order.begin(), order.end(),
            [](const double* a, const double* b) { return std::tie(a[0], a[1]) < std::tie(b[0], b[1]); });
  std::vector<double> rows;
  rows.reserve(order.size() * width);
  for (const double* row : order) rows.insert(rows.end(), row + ids, row + stride);
  return rows;
}

}  // namespace

/// The rows divided by their low ids into pieces, and each piece into parts, one for each rank to write.
struct OrderedRows::Cut {
  std::shared_ptr<const core::Ranks> ranks;
  std::size_t rank = 0, count = 1;  ///< this rank, and the number of ranks
  std::vector<std::int32_t> order;  ///< of this rank's rows
  std::vector<std::size_t> begin;   ///< of each part in `order`, and the end
  std::vector<std::int64_t> first;  ///< of each part in the dataset, and the end
  [[nodiscard]] std::size_t pieces() const { return (begin.size() - 1) / count; }
  [[nodiscard]] std::size_t part(std::size_t piece, std::size_t of_rank) const { return piece * count + of_rank; }

  [[nodiscard]] std::vector<double> values(std::size_t piece, std::size_t width, const Fill& fill) const {
    if (!ranks) {
      std::vector<double> rows((begin[piece + 1] - begin[piece]) * width);
      double* row = rows.data();
      for (std::size_t n = begin[piece]; n < begin[piece + 1]; ++n, row += width) fill(order[n], row);
      return rows;
    }
    return exchanged(piece, width, fill);
  }
  [[nodiscard]] std::vector<double> exchanged(std::size_t piece, std::size_t width, const Fill& fill) const;
  std::vector<std::array<double, ids>> names;  ///< ids of this rank's rows, in their order; only with several ranks
};

std::vector<double> OrderedRows::Cut::exchanged(std::size_t piece, std::size_t width, const Fill& fill) const {
  const std::size_t stride = ids + width;
  std::vector<int> to(count);
  for (std::size_t r = 0; r < count; ++r) to[r] = int((begin[part(piece, r) + 1] - begin[part(piece, r)]) * stride);
  const std::size_t from = begin[part(piece, 0)], end = begin[part(piece + 1, 0)];
  std::vector<double> out((end - from) * stride);
  double* row = out.data();
  for (std::size_t n = from; n < end; ++n, row += stride) {
    std::copy(names[n].begin(), names[n].end(), row);
    fill(order[n], row + ids);
  }
  core::Messages messages(ranks, to);
  std::vector<double> in(messages.incoming());
  messages.start(std::span<const double>(out), std::span<double>(in));
  messages.finish();
  return sorted_rows(in, width);
}

OrderedRows::OrderedRows(std::vector<RowName> own, std::shared_ptr<const core::Ranks> ranks) {
  auto cut = std::make_shared<Cut>();
  cut->ranks = std::move(ranks);
  if (cut->ranks) {
    cut->rank = std::size_t(cut->ranks->rank());
    cut->count = std::size_t(cut->ranks->count());
  }
  const core::Ranks* all = cut->ranks.get();
  std::sort(own.begin(), own.end(),
            [](const RowName& a, const RowName& b) { return std::tie(a.low, a.high) < std::tie(b.low, b.high); });
  std::array<std::int64_t, 1> rows{std::int64_t(own.size())};
  core::add_over_ranks(all, rows);
  const auto span = 1 + std::int64_t(core::greatest_of_ranks(all, own.empty() ? 0.0 : double(own.back().low)));
  const std::size_t pieces = std::size_t(rows[0]) / (rows_of_piece * cut->count) + 1;
  const auto parts = std::int64_t(pieces * cut->count);
  cut->first.assign(std::size_t(parts) + 1, 0);
  for (std::int64_t p = 0; p <= parts; ++p) {
    const std::int64_t low = span / parts * p + std::min(p, span % parts);
    const auto at =
        std::lower_bound(own.begin(), own.end(), low, [](const RowName& row, std::int64_t id) { return row.low < id; });
    cut->begin.push_back(std::size_t(at - own.begin()));
    cut->first[std::size_t(p)] = std::int64_t(cut->begin.back());
  }
  core::add_over_ranks(all, cut->first);  // rows on all ranks before a part
  cut->order.reserve(own.size());
  for (const RowName& row : own) cut->order.push_back(row.at);
  if (cut->ranks)
    for (const RowName& row : own) cut->names.push_back({double(row.low), double(row.high)});
  cut_ = std::move(cut);
}

std::size_t OrderedRows::count() const { return std::size_t(cut_->first.back()); }

std::vector<core::BlockData> OrderedRows::blocks(const std::string& name, std::size_t width, bool flat,
                                                 const Fill& fill) const {
  std::vector<core::BlockData> blocks;
  for (std::size_t piece = 0; piece < cut_->pieces(); ++piece) {
    const std::size_t part = cut_->part(piece, cut_->rank), start = std::size_t(cut_->first[part]),
                      rows = std::size_t(cut_->first[part + 1]) - start;
    core::BlockData& block = blocks.emplace_back();
    block.name = name;
    block.slab = flat ? core::Slab{{count() * width}, {start * width}, {rows * width}}
                      : core::Slab{{count(), width}, {start, 0}, {rows, width}};
    block.chunk = block.slab.shape;
    if (count() > 0) block.chunk[0] = std::min(block.chunk[0], rows_of_piece);
    block.values = [cut = cut_, piece, width, fill] { return cut->values(piece, width, fill); };
  }
  return blocks;
}

std::vector<double> on_first(const std::vector<core::BlockData>& blocks,
                             const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<double> all;
  for (const core::BlockData& block : blocks) {
    std::vector<double> own = block.values();
    if (ranks) {
      std::vector<int> to(std::size_t(ranks->count()), 0);
      to[0] = int(own.size());
      core::Messages messages(ranks, to);
      std::vector<double> in(messages.incoming());
      messages.start(std::span<const double>(own), std::span<double>(in));
      messages.finish();
      own = std::move(in);
    }
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace polybed::dem
