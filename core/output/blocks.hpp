// Writes files block by block, from one rank or several together. Each writes its block of every dataset; none needs
// memory for the whole.
//
// The first rank builds the file without these numbers, in memory, and claims room for them on the disk. Then all open
// it through MPI-IO and write their blocks with collective calls. Room is claimed because HDF5's collective calls wait
// forever for a rank that left with an error, and a full disk is the most likely error.
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

/// A part of a dataset, which this rank writes. A dataset written in pieces has one entry per piece.
struct BlockData {
  std::string name;
  Slab slab;
  Packing packing = Packing::plain;
  std::function<std::vector<double>()> values;  ///< of the part, in C order; called when it is this dataset's turn
  std::vector<std::size_t> chunk;               ///< greatest piece that is packed as one; empty: the whole
};

/// For a column on one rank: writes the datasets into the file in memory.
void write_blocks(OutputFile& file, std::span<const BlockData> data);

/// Writes and closes `path`, without memory for its content. All ranks pass the same names and shapes; only the first
/// rank owns the file. Collective; throws FileError on all ranks and removes `path` on failure.
/// \param ranks  null: one rank
void write_blocks(const std::filesystem::path& path, OutputFile* file, std::span<const BlockData> data,
                  const Ranks* ranks);

/// Greatest number of cells per block along each axis, slowest axis first.
[[nodiscard]] std::vector<std::size_t> greatest_block(const Grid& grid);

}  // namespace polybed::core
