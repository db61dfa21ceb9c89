#include "dem/contacts/kept.hpp"

#include <algorithm>

namespace polybed::dem {

void keep(const Contacts& contacts, const Particles& particles, bool walls, std::vector<KeptContact>& kept) {
  for (const std::int32_t p : contacts.touching) {
    const auto [low, high] = ids_of(contacts.pairs[std::size_t(p)], particles, walls);
    KeptContact& c = kept.emplace_back(KeptContact{low, high, {}});
    std::copy_n(contacts.memory_of(p), contacts.memory_size, c.memory.begin());
  }
}

std::size_t KeptById::Hash::operator()(const Ids& ids) const {
  return std::size_t(std::uint64_t(ids.first) * 0x9e3779b97f4a7c15ULL ^
                     std::uint64_t(ids.second) * 0xc2b2ae3d27d4eb4fULL);
}

KeptById::KeptById(const std::vector<KeptContact>& kept) {
  found_.reserve(kept.size());
  for (const KeptContact& c : kept) found_.emplace(Ids(c.low, c.high), &c);
}

void KeptById::recall(Contacts& contacts, const Particles& particles, bool walls) const {
  contacts.memory.assign(contacts.pairs.size() * std::size_t(contacts.memory_size), 0.0);
  contacts.touching.clear();
  for (auto* list : {&contacts.touching, &contacts.touched}) list->reserve(contacts.pairs.size());  // until the next
  for (std::int32_t p = 0; p < std::int32_t(contacts.pairs.size()); ++p) {
    // Of a pair that is listed with several images only the first can touch: no box is so narrow.
    const Contacts::Pair &pair = contacts.pairs[std::size_t(p)],
                         &before = contacts.pairs[std::size_t(p > 0 ? p - 1 : 0)];
    if (p > 0 && pair.first == before.first && pair.second == before.second) continue;
    const auto kept = found_.find(ids_of(pair, particles, walls));
    if (kept == found_.end()) continue;
    std::copy_n(kept->second->memory.begin(), contacts.memory_size, contacts.memory_of(p));
    contacts.touching.push_back(p);
  }
}

}  // namespace polybed::dem
