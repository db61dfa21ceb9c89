#include "dem/parallel/gathered.hpp"

#include <algorithm>
#include <utility>

#include "core/numerics/messages.hpp"
#include "dem/parallel/ordered_rows.hpp"

namespace polybed::dem {

namespace {

template <class Item>
std::vector<Item> all_on_first(const std::vector<Item>& own, const std::shared_ptr<const core::Ranks>& ranks) {
  if (!ranks) return own;
  std::vector<int> to(std::size_t(ranks->count()), 0);
  to[0] = int(own.size());
  core::Messages messages(ranks, to);
  std::vector<Item> all(messages.incoming());
  messages.start(std::span<const Item>(own), std::span<Item>(all));
  messages.finish();
  return all;
}

/// Data of a particle in the files.
struct Shown {
  std::int64_t id;
  std::int32_t species;
  double radius;
  Vector x, v, w;
};

Shown shown(const Particles& particles, std::size_t i) {
  const Place& place = particles.place[i];
  const Motion& m = particles.motion[i];
  return {particles.id[i], particles.species[i], place.radius, place.x, m.v, m.w};
}

/// \param of  Shown of a number
template <class Of>
Snapshot snapshot_of(std::size_t count, Of&& of) {
  std::vector<std::pair<std::int64_t, std::size_t>> order(count);
  for (std::size_t n = 0; n < count; ++n) order[n] = {of(n).id, n};
  std::sort(order.begin(), order.end());
  Snapshot all;
  all.id.reserve(count);
  all.species.reserve(count);
  all.radius.reserve(count);
  for (auto* vectors : {&all.position, &all.velocity, &all.spin}) vectors->reserve(count);
  for (const auto& [id, n] : order) {
    const Shown& p = of(n);
    all.id.push_back(id);
    all.species.push_back(p.species);
    all.radius.push_back(p.radius);
    all.position.push_back(p.x);
    all.velocity.push_back(p.v);
    all.spin.push_back(p.w);
  }
  return all;
}

/// A row, identified by its ids.
struct Row {
  double low, high;
  std::size_t at;  ///< index in the vector

  [[nodiscard]] bool same(const Row& other) const { return low == other.low && high == other.high; }
};

/// Moves rows to the order in `from`, in place: memory may not suffice for a second vector.
void permute(std::vector<double>& rows, std::size_t width, std::vector<Row>& from) {
  std::vector<double> first(width);
  for (std::size_t n = 0; n < from.size(); ++n) {
    if (from[n].at == n) continue;
    std::copy_n(&rows[n * width], width, first.begin());
    std::size_t to = n;
    while (from[to].at != n) {
      const std::size_t next = std::exchange(from[to].at, to);
      std::copy_n(&rows[next * width], width, &rows[to * width]);
      to = next;
    }
    std::copy_n(first.begin(), width, &rows[to * width]);
    from[to].at = to;
  }
}

/// Sorts by the ids at the start of rows; removes duplicates.
void put_in_order(std::vector<double>& rows, std::size_t width, std::size_t ids) {
  std::vector<Row> order(rows.size() / width);
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = {rows[n * width], ids > 1 ? rows[n * width + 1] : 0, n};
  std::sort(order.begin(), order.end(),
            [](const Row& a, const Row& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  permute(rows, width, order);
  std::size_t kept = 0;
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n > 0 && order[n].same(order[n - 1])) continue;
    if (kept != n) std::copy_n(&rows[n * width], width, &rows[kept * width]);
    ++kept;
  }
  rows.resize(kept * width);
}

}  // namespace

Snapshot gathered_snapshot(const Particles& particles, const std::shared_ptr<const core::Ranks>& ranks) {
  if (!ranks) return snapshot_of(particles.owned, [&](std::size_t i) { return shown(particles, i); });
  std::vector<Shown> own;
  own.reserve(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) own.push_back(shown(particles, i));
  const std::vector<Shown> all = all_on_first(own, ranks);
  return snapshot_of(all.size(), [&](std::size_t i) -> const Shown& { return all[i]; });
}

ShownRows shown_rows(const Particles& particles, const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<RowName> own;
  own.reserve(particles.owned);
  for (std::size_t i = 0; i < particles.owned; ++i) own.push_back({particles.id[i], 0, std::int32_t(i)});
  const OrderedRows rows(std::move(own), ranks);
  ShownRows shown;
  const auto number = [&](auto&& of) {
    return on_first(rows.blocks("", 1, true, [&](std::int32_t i, double* row) { *row = double(of(std::size_t(i))); }),
                    ranks);
  };
  for (const double id : number([&](std::size_t i) { return particles.id[i]; }))
    shown.head.id.push_back(std::int64_t(id));
  for (const double species : number([&](std::size_t i) { return particles.species[i]; }))
    shown.head.species.push_back(std::int32_t(species));
  shown.head.radius = number([&](std::size_t i) { return particles.place[i].radius; });
  const auto add = [&](const char* name, auto&& of) {
    const auto fill = [of](std::int32_t i, double* row) {
      const Vector& v = of(std::size_t(i));
      std::copy(v.begin(), v.end(), row);
    };
    for (core::BlockData& block : rows.blocks(name, 3, false, fill)) shown.vectors.push_back(std::move(block));
  };
  add("position", [&particles](std::size_t i) -> const Vector& { return particles.place[i].x; });
  add("velocity", [&particles](std::size_t i) -> const Vector& { return particles.motion[i].v; });
  add("spin", [&particles](std::size_t i) -> const Vector& { return particles.motion[i].w; });
  return shown;
}

std::vector<KeptLoad> gathered_loads(const std::vector<KeptLoad>& loads,
                                     const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<KeptLoad> all = all_on_first(loads, ranks);
  std::sort(all.begin(), all.end(), [](const KeptLoad& a, const KeptLoad& b) { return a.id < b.id; });
  return all;
}

std::vector<double> gathered_rows(std::vector<double> own, std::size_t width, std::size_t ids,
                                  const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<double> rows = ranks ? all_on_first(own, ranks) : std::move(own);
  std::vector<double>().swap(own);
  put_in_order(rows, width, ids);
  return rows;
}

}  // namespace polybed::dem
