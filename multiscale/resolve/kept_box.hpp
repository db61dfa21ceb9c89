// A box of resolved flow that is not finished yet, kept in a file so that a run goes on from it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/output/checkpoint.hpp"
#include "multiscale/resolve/lattice/flow.hpp"

namespace polybed::multiscale {

struct KeptBox {
  std::filesystem::path path;
  std::string name;  ///< box_name: the file of another box is left alone
  double every = 0;  ///< s on the clock between two writings

  /// Writes the flow, to the bit, and what else belongs to the state. Throws core::FileError.
  template <class Real>
  void write(const lattice::Flow<Real>& flow, core::Checkpoint state) const;

  /// What was written but for the flow; nothing if there is no file of this box. Throws core::FileError for a damaged
  /// one.
  [[nodiscard]] std::optional<core::Checkpoint> read() const;
  /// Restores the flow from the file that the state was read from.
  template <class Real>
  void restore(lattice::Flow<Real>& flow, core::Checkpoint state) const;

  /// Removes the file and the one before it.
  void remove() const;
};

}  // namespace polybed::multiscale
