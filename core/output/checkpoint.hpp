// Stores the complete state of a run, to the bit, in one file.
//
// The file is HDF5, then 32 bytes: "polybed complete", the length of the HDF5 part and its CRC-64, both 64 bits, low
// byte first. HDF5 readers do not look beyond their part. A file that was cut short or changed anywhere is thus
// detected before HDF5 interprets it. Data shared by ranks are one dataset for each field of the column; each rank
// writes and reads its block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/numerics/grid.hpp"
#include "core/output/blocks.hpp"
#include "core/output/file.hpp"

namespace polybed::core {

class Ranks;

/// One dataset of an array that the ranks of a column share, and this rank's part of it.
struct CheckpointPart {
  std::string name;
  Slab slab;

  bool operator==(const CheckpointPart&) const = default;
};

/// The parts of such an array. This rank's numbers are stored one part after the other, each in C order.
using CheckpointParts = std::map<std::string, std::vector<CheckpointPart>>;

struct Checkpoint {
  std::map<std::string, std::vector<double>>
      arrays;  ///< those named in `parts`: this rank's part; others are the same on all
  CheckpointParts parts;
  std::map<std::string, double> numbers;
  std::map<std::string, std::int64_t> integers;
  std::map<std::string, std::string> texts;

  bool operator==(const Checkpoint&) const = default;

  /// The entry with a name; each throws FileError if there is none.
  [[nodiscard]] const std::vector<double>& array(const std::string& name) const;
  [[nodiscard]] double number(const std::string& name) const;
  [[nodiscard]] std::int64_t integer(const std::string& name) const;
  /// The same for a time or a duration, s: also throws for a value that no run can have.
  [[nodiscard]] double time(const std::string& name) const;
  /// The same for a count: also throws if it is negative.
  [[nodiscard]] std::int64_t count(const std::string& name) const;
};

/// Throws FileError with the reason why the content of an intact checkpoint is impossible.
[[noreturn]] void refuse_checkpoint(const std::string& reason);

/// Records the graded layers of a column, and throws FileError if a checkpoint is of other ones: the first rank's.
void put_layers(const Grid& grid, Checkpoint& checkpoint);
void require_layers(const Grid& grid, const Checkpoint& checkpoint);

/// Runs code that reads the contents of a checkpoint, and adds the file name to a FileError that lacks it.
void name_checkpoint(const std::filesystem::path& path, const std::function<void()>& take_up);

/// Throws FileError for numbers that no run can have: not finite, or beyond 1e30 in SI units.
void require_numbers(const Checkpoint& checkpoint);

/// Path of the checkpoint before `path`: checkpoint.h5 -> checkpoint.previous.h5.
[[nodiscard]] std::filesystem::path previous_checkpoint(const std::filesystem::path& path);

/// Writes a checkpoint: temporary name, flushed, renamed; the previous one stays as previous_checkpoint(path). A
/// complete checkpoint exists at every moment. Throws FileError (disk full, no permission; a name with '/').
/// \param ranks  that share the column; the first one writes arrays that are in no part. Collective.
/// \param more  further arrays by name, computed while they are written; read_parts finds them by "array/part"
void write_checkpoint(const std::filesystem::path& path, Checkpoint checkpoint, const Ranks* ranks = nullptr,
                      std::vector<BlockData> more = {});

/// Reads a checkpoint without its parts, to the bit. Throws FileError if the file is missing, cut short, damaged or of
/// another version; the message names the previous checkpoint if that one is complete.
[[nodiscard]] Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Name of the array with the number of particles of each species in a checkpoint.
inline constexpr const char* particle_numbers = "particle_numbers";

/// One array outside parts; empty if it does not exist. Throws FileError as read_checkpoint().
[[nodiscard]] std::vector<double> read_array(const std::filesystem::path& path, const std::string& name);

/// Reads this rank's parts of arrays, however many ranks wrote them. An array without parts in the file is left out.
/// Throws FileError if a part is missing or has another shape. Not collective.
void read_parts(const std::filesystem::path& path, const CheckpointParts& parts, Checkpoint& checkpoint);

}  // namespace polybed::core
