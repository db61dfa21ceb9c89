#include "dem/contacts/kept.hpp"

#include <algorithm>
#include <bit>

namespace polybed::dem {

void keep(const Contacts& contacts, const Particles& particles, bool walls, std::vector<KeptContact>& kept) {
  for (const std::int32_t p : contacts.touching) {
    const auto [low, high] = ids_of(contacts.pairs[std::size_t(p)], particles, walls);
    KeptContact& c = kept.emplace_back(KeptContact{low, high, {}});
    std::copy_n(contacts.memory_of(p), contacts.memory_size, c.memory.begin());
  }
}

KeptContacts::KeptContacts(const std::vector<KeptContact>& contacts, int memory_size) : KeptContacts(memory_size) {
  rows.reserve(contacts.size() * width);
  for (const KeptContact& c : contacts) {
    rows.insert(rows.end(), {double(c.low), double(c.high)});
    rows.insert(rows.end(), c.memory.begin(), c.memory.begin() + memory_size);
  }
}

void KeptContacts::add(const Contacts& contacts, const Particles& particles, bool walls) {
  rows.reserve(rows.size() + contacts.touching.size() * width);
  for (const std::int32_t p : contacts.touching) {
    const auto [low, high] = ids_of(contacts.pairs[std::size_t(p)], particles, walls);
    rows.insert(rows.end(), {double(low), double(high)});
    rows.insert(rows.end(), contacts.memory_of(p), contacts.memory_of(p) + contacts.memory_size);
  }
}

KeptById::KeptById(const KeptContacts& kept)
    : kept_(kept), slots_(std::bit_ceil(std::max<std::size_t>(2 * kept.size(), 2)), -1) {
  for (std::size_t n = 0; n < kept.size(); ++n) {
    std::size_t slot = slot_of(kept.low(n), kept.high(n));
    while (slots_[slot] >= 0) slot = next(slot);
    slots_[slot] = std::int32_t(n);
  }
}

std::size_t KeptById::slot_of(std::int64_t low, std::int64_t high) const {
  const std::uint64_t mixed =
      (std::uint64_t(low) * 0x9e3779b97f4a7c15ULL + std::uint64_t(high)) * 0xc2b2ae3d27d4eb4fULL;
  return std::size_t(mixed >> 32) & (slots_.size() - 1);
}

/// The first of several with the same ids, for example a pair sent by two ranks: they are equal.
std::int32_t KeptById::find(std::int64_t low, std::int64_t high) const {
  std::size_t slot = slot_of(low, high);
  while (slots_[slot] >= 0) {
    const auto n = std::size_t(slots_[slot]);
    if (kept_.low(n) == low && kept_.high(n) == high) break;
    slot = next(slot);
  }
  return slots_[slot];
}

void KeptById::recall(Contacts& contacts, const Particles& particles, bool walls) const {
  contacts.memory.assign(contacts.pairs.size() * std::size_t(contacts.memory_size), 0.0);
  contacts.touching.clear();
  for (auto* list : {&contacts.touching, &contacts.touched}) list->reserve(contacts.pairs.size());  // until the rebuild
  for (std::int32_t p = 0; p < std::int32_t(contacts.pairs.size()); ++p) {
    // If a pair is listed with several images, only the first can touch: no box is that narrow.
    const Contacts::Pair &pair = contacts.pairs[std::size_t(p)],
                         &before = contacts.pairs[std::size_t(p > 0 ? p - 1 : 0)];
    if (p > 0 && pair.first == before.first && pair.second == before.second) continue;
    const auto [low, high] = ids_of(pair, particles, walls);
    const std::int32_t kept = find(low, high);
    if (kept < 0) continue;
    std::copy_n(kept_.memory(std::size_t(kept)), contacts.memory_size, contacts.memory_of(p));
    contacts.touching.push_back(p);
  }
}

}  // namespace polybed::dem
