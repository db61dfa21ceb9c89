// Files that are written block by block, by one rank or by several together: each its block of every dataset, none with
// memory for the whole.
//
// The first rank builds the file without these numbers, in memory, and claims room for them on the disk; then all open
// it through MPI-IO and write their blocks with collective calls. Room is claimed because HDF5's collective calls wait
// for ever for a rank that has left one with an error, and a full disk is the error to expect.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/output/file.hpp"

namespace polybed::core {

struct Grid;
class Ranks;

/// A part of a dataset, which this rank writes. A dataset that is written in pieces has an entry for each of them.
struct BlockData {
  std::string name;
  Slab slab;
  Packing packing = Packing::plain;
  std::function<std::vector<double>()> values;  ///< of the part, in C order; asked for when it is this dataset's turn
  std::vector<std::size_t> chunk;               ///< greatest piece that is packed as one; empty: the whole
};

/// A column on one rank: the datasets are written into the file in memory.
void write_blocks(OutputFile& file, std::span<const BlockData> data);

/// `path` is written and closed, without memory for its content. All ranks give the same names and shapes; the file is
/// the first rank's alone. Collective; throws FileError on all ranks, and then `path` is removed.
/// \param ranks  null: one
void write_blocks(const std::filesystem::path& path, OutputFile* file, std::span<const BlockData> data,
                  const Ranks* ranks);

/// Extents of a box of the grid's blocks, slowest axis first: at most this many cells along each axis are in a block.
[[nodiscard]] std::vector<std::size_t> greatest_block(const Grid& grid);

}  // namespace polybed::core
