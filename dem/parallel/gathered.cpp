#include "dem/parallel/gathered.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "core/numerics/messages.hpp"

namespace polybed::dem {

namespace {

template <class Item>
std::vector<Item> on_first(const std::vector<Item>& own, const std::shared_ptr<const core::Ranks>& ranks) {
  if (!ranks) return own;
  std::vector<int> to(std::size_t(ranks->count()), 0);
  to[0] = int(own.size());
  core::Messages messages(ranks, to);
  std::vector<Item> all(messages.incoming());
  messages.start(std::span<const Item>(own), std::span<Item>(all));
  messages.finish();
  return all;
}

}  // namespace

std::vector<Particle> gathered_particles(const Particles& particles, const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<Particle> own;
  for (std::size_t i = 0; i < particles.owned; ++i) own.push_back(particles.at(i));
  std::vector<Particle> all = on_first(own, ranks);
  std::sort(all.begin(), all.end(), [](const Particle& a, const Particle& b) { return a.id < b.id; });
  return all;
}

std::vector<KeptLoad> gathered_loads(const std::vector<KeptLoad>& loads,
                                     const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<KeptLoad> all = on_first(loads, ranks);
  std::sort(all.begin(), all.end(), [](const KeptLoad& a, const KeptLoad& b) { return a.id < b.id; });
  return all;
}

KeptRows gathered_rows(const KeptRows& rows, const std::shared_ptr<const core::Ranks>& ranks) {
  KeptRows all{rows.width, on_first(rows.numbers, ranks)}, sorted{rows.width, {}};
  std::vector<std::size_t> order(all.count());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all.of(a)[0] < all.of(b)[0]; });
  for (const std::size_t n : order) sorted.numbers.insert(sorted.numbers.end(), all.of(n), all.of(n) + all.width);
  return sorted;
}

std::vector<KeptContact> gathered_contacts(const std::vector<KeptContact>& contacts,
                                           const std::shared_ptr<const core::Ranks>& ranks) {
  std::vector<KeptContact> all = on_first(contacts, ranks);
  const auto key = [](const KeptContact& c) { return std::tuple(c.low, c.high); };
  std::sort(all.begin(), all.end(), [&](const KeptContact& a, const KeptContact& b) { return key(a) < key(b); });
  all.erase(std::unique(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
            all.end());
  return all;
}

}  // namespace polybed::dem
