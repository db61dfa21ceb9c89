// Rows of numbers from all ranks in the order of ids, produced piece by piece while a file is written: no rank needs
// memory for all, and each writes as many as the others.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/numerics/ranks.hpp"
#include "core/output/blocks.hpp"

namespace polybed::dem {

/// One of this rank's rows: its sorting ids, and its owner's index.
struct RowName {
  std::int64_t low, high;
  std::int32_t at;
};

class OrderedRows {
 public:
  using Fill = std::function<void(std::int32_t at, double* row)>;

  /// Collective. \param own  on this rank, in any order; no row is on two ranks, low is at least 0
  OrderedRows(std::vector<RowName> own, std::shared_ptr<const core::Ranks> ranks);

  /// On all ranks.
  [[nodiscard]] std::size_t count() const;
  /// A dataset with these rows: this rank's part, in the same number of pieces on every rank, whose values() are
  /// collective. `fill` must stay valid until the last of them.
  /// \param width  numbers per row   \param flat  one after the other; else the dataset has as many columns
  [[nodiscard]] std::vector<core::BlockData> blocks(const std::string& name, std::size_t width, bool flat,
                                                    const Fill& fill) const;

 private:
  struct Cut;
  std::shared_ptr<const Cut> cut_;
};

/// The numbers in one dataset's blocks, together on the first rank; empty on the others. Collective.
[[nodiscard]] std::vector<double> on_first(const std::vector<core::BlockData>& blocks,
                                           const std::shared_ptr<const core::Ranks>& ranks);

}  // namespace polybed::dem
