// Where the fluid is cut into blocks and the particles into other parts: what each rank's particles touch goes to the
// ranks that own the cells, and comes from them.
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

  /// From now on the particles of this rank touch the cells around them, and what they may reach meanwhile.
  void choose(const Particles& particles);
  /// From now on this rank touches the whole column.
  void choose_all();
  /// Sends sums over this rank's particles to the owners of the entries, who add them up.
  /// \param width  numbers of an entry, one beside the other  \param column  over the padded column
  /// \param block  likewise of the block, set to the sums
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
  /// Calls body(column entry, block entry) for the entries of a region. The second is one only where the region is in
  /// this rank's block.
  template <class Body>
  void for_each_entry(const Region& region, Body&& body) const;
  [[nodiscard]] static std::size_t size(const Region& region);

  core::Grid column_, block_;
  std::shared_ptr<const core::Ranks> ranks_;
  std::vector<Region> owned_, touched_;  ///< of each rank
};

}  // namespace polybed::dem
