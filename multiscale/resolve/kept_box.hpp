// A box of resolved flow that is not steady yet, kept in a file so that a run goes on from it.
#pragma once

#include <filesystem>
#include <string>

#include "multiscale/resolve/lattice/steady.hpp"

namespace polybed::multiscale {

struct KeptBox {
  std::filesystem::path path;
  std::string name;  ///< box_name: the file of another box is left alone
  double every = 0;  ///< s on the clock between two writings

  /// How far the flow in the file has come.
  struct Stand {
    lattice::SteadyProgress progress;
    double seconds = 0;  ///< that it took
  };

  /// Writes the flow, to the bit. Throws core::FileError.
  template <class Real>
  void write(const lattice::Flow<Real>& flow, const Stand& stand) const;

  /// Restores what was written; false if there is no file of this box. Throws core::FileError for a damaged one.
  template <class Real>
  bool restore(lattice::Flow<Real>& flow, Stand& stand) const;

  /// Removes the file and the one before it.
  void remove() const;
};

}  // namespace polybed::multiscale
