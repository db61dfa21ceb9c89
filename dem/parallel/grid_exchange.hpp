// Exchange between the fluid's blocks and the particles' parts: sums from the cells around a rank's particles go to the
// cells' owners, and values come from them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/numerics/field.hpp"
#include "core/numerics/messages.hpp"
#include "core/numerics/ranks.hpp"
#include "dem/particles.hpp"

namespace polybed::dem {

class GridExchange {
 public:
  /// \param column  whole  \param block  of this rank
  GridExchange(core::Grid column, core::Grid block, std::shared_ptr<const core::Ranks> ranks);

  // Collective from here on.

  /// Sets the cells that this rank's particles touch, with those they can reach meanwhile.
  void choose(const Particles& particles);
  /// Sets the whole column as touched by this rank.
  void choose_all();
  /// Sends sums over this rank's particles to the owners of the entries, which add them up.
  /// \param width  numbers per entry, contiguous  \param column  over the padded column
  /// \param block  likewise for the block, set to the sums
  void add(std::size_t width, std::span<const std::int64_t> column, std::span<std::int64_t> block) const;
  /// Fetches fields of the blocks: on entries that this rank touches, from their owners.
  void fetch(std::span<const std::pair<const core::Field*, core::Field*>> block_to_column) const;

 private:
  /// Entries low <= (i, j, k) < high of the column.
  struct Region {
    std::array<int, 3> low{}, high{};
  };
  [[nodiscard]] static Region common(const Region& a, const Region& b);
  [[nodiscard]] std::vector<Region> of_all(const Region& own) const;
  void choose(const Region& own);
  /// Calls body(column entry, block entry) for the entries of a region. The second is valid only if the region is in
  /// this rank's block.
  template <class Body>
  void for_each_entry(const Region& region, Body&& body) const;
  [[nodiscard]] static std::size_t size(const Region& region);

  core::Grid column_, block_;
  std::shared_ptr<const core::Ranks> ranks_;
  std::vector<Region> owned_, touched_;  ///< for each rank
};

}  // namespace polybed::dem
