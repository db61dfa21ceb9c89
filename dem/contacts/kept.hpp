// Stores contact data while the list of pairs is rebuilt and particles change ranks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "dem/contacts/batch.hpp"
#include "dem/contacts/contacts.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

/// Stored data of a contact, by the ids of its particles; a wall's id is -1 - its number.
struct KeptContact {
  std::int64_t low, high;
  std::array<double, ContactBatch::most_memory> memory;
};

/// Ids of a pair; a wall's id is -1 - its number.
[[nodiscard]] inline std::pair<std::int64_t, std::int64_t> ids_of(const Contacts::Pair& pair,
                                                                  const Particles& particles, bool walls) {
  return {particles.id[std::size_t(pair.first)],
          walls ? -1 - std::int64_t(pair.second) : particles.id[std::size_t(pair.second)]};
}

/// Adds the stored data of touching contacts.
void keep(const Contacts& contacts, const Particles& particles, bool walls, std::vector<KeptContact>& kept);

/// The same for many contacts during a rebuild: rows of both ids and the numbers that the laws use. Ids are exact as
/// doubles below 2^53.
struct KeptContacts {
  static constexpr std::size_t head = 2;
  std::size_t width = head;
  std::vector<double> rows;

  explicit KeptContacts(int memory_size) : width(head + std::size_t(memory_size)) {}
  KeptContacts(const std::vector<KeptContact>& contacts, int memory_size);
  void add(const Contacts& contacts, const Particles& particles, bool walls);

  [[nodiscard]] std::size_t size() const { return rows.size() / width; }
  [[nodiscard]] const double* row(std::size_t n) const { return rows.data() + n * width; }
  [[nodiscard]] std::int64_t low(std::size_t n) const { return std::int64_t(row(n)[0]); }
  [[nodiscard]] std::int64_t high(std::size_t n) const { return std::int64_t(row(n)[1]); }
  [[nodiscard]] const double* memory(std::size_t n) const { return row(n) + head; }
};

/// Stored contacts, searchable by their ids.
class KeptById {
 public:
  /// \param kept  must outlive this
  explicit KeptById(const KeptContacts& kept);
  /// Restores the memory of the pairs in a new list; the pairs with a memory are the touching ones.
  void recall(Contacts& contacts, const Particles& particles, bool walls) const;

 private:
  /// Start of the search for a contact, and its continuation.
  [[nodiscard]] std::size_t slot_of(std::int64_t low, std::int64_t high) const;
  [[nodiscard]] std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  /// Index of a contact's row, or -1.
  [[nodiscard]] std::int32_t find(std::int64_t low, std::int64_t high) const;

  const KeptContacts& kept_;
  std::vector<std::int32_t> slots_;  ///< indices of rows, -1 if empty; at least twice as many as rows, a power of two
};

}  // namespace polybed::dem
