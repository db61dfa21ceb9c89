// An unfinished box of resolved flow, stored in a file so that a run can continue it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/output/checkpoint.hpp"
#include "multiscale/resolve/lattice/flow.hpp"

namespace polybed::multiscale {

struct KeptBox {
  std::filesystem::path path;
  std::string name;  ///< box_name: the file of another box is ignored
  double every = 0;  ///< s on the clock between two writings

  /// Writes the flow, to the bit, and the rest of the state. Throws core::FileError.
  template <class Real>
  void write(const lattice::Flow<Real>& flow, core::Checkpoint state) const;

  /// The written state without the flow; nothing if there is no file for this box. Throws core::FileError for a damaged
  /// one.
  [[nodiscard]] std::optional<core::Checkpoint> read() const;
  /// Restores the flow from the state's file.
  template <class Real>
  void restore(lattice::Flow<Real>& flow, core::Checkpoint state) const;

  /// Removes the file and the previous one.
  void remove() const;
};

/// Impulses on obstacles, as restore_impulses() takes them.
void keep_impulses(const std::vector<lattice::Impulse>& impulses, core::Checkpoint& state);
[[nodiscard]] std::vector<lattice::Impulse> kept_impulses(const core::Checkpoint& state);

}  // namespace polybed::multiscale
