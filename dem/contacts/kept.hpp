// What is kept of contacts while the list of pairs is made anew and particles change ranks.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// What is kept of a contact, by the ids of its particles; of a wall: -1 - its number.
struct KeptContact {
  std::int64_t low, high;
  std::array<double, ContactBatch::most_memory> memory;
};

/// Ids of a pair; of a wall: -1 - its number.
[[nodiscard]] inline std::pair<std::int64_t, std::int64_t> ids_of(const Contacts::Pair& pair,
                                                                  const Particles& particles, bool walls) {
  return {particles.id[std::size_t(pair.first)],
          walls ? -1 - std::int64_t(pair.second) : particles.id[std::size_t(pair.second)]};
}

/// Adds what is kept of the contacts that touch.
void keep(const Contacts& contacts, const Particles& particles, bool walls, std::vector<KeptContact>& kept);

/// Kept contacts, found by their ids.
class KeptById {
 public:
  /// \param kept  must stay
  explicit KeptById(const std::vector<KeptContact>& kept);
  /// Gives the pairs of a new list the memory they had; those that have one are the ones that touch.
  void recall(Contacts& contacts, const Particles& particles, bool walls) const;

 private:
  using Ids = std::pair<std::int64_t, std::int64_t>;
  struct Hash {
    std::size_t operator()(const Ids& ids) const;
  };
  std::unordered_map<Ids, const KeptContact*, Hash> found_;
};

}  // namespace polybed::dem
